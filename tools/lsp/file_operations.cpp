// Renaming, making and deleting files in the editor.

#include "config/json_text.h"
#include "config/text_util.h"
#include "frontend/project/files.h"
#include "frontend/syntax/parser.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace lsp {

namespace fs = std::filesystem;
using rapid::SourceFile;
using rapid::TextEdit;
using rapid::config::sameName;
using FileEdits = std::vector<std::pair<std::shared_ptr<const SourceFile>, std::vector<TextEdit>>>;

namespace {

/// Whether the parser takes it for the name of a module.
bool isModuleName(const std::string& name) {
    rapid::diag::Sink sink;
    const auto file =
        std::make_shared<const SourceFile>("m.modx", fmt::format("MODULE {}\nENDMODULE\n", name));
    const auto tree = rapid::syntax::parse(file, sink);
    return !sink.hasErrors() && tree->modules.size() == 1;
}

/// The name in the declaration of the module that is called as its file is.
void renameModule(State& state, const fs::path& from, const fs::path& to, FileEdits& out) {
    const Target target = state.targetOfPath(from.string());
    if (!target.tree || sameName(from.stem().string(), to.stem().string())) return;
    for (const rapid::syntax::ModuleDecl* module : target.tree->modules) {
        if (module->name == rapid::syntax::kNoToken) continue;
        if (!sameName(target.tree->text(module->name), from.stem().string())) continue;
        if (!isModuleName(to.stem().string())) return;
        out.push_back({target.positions->source(), {{target.tree->range(module->name), to.stem().string()}}});
    }
}

/// Places where the name of a file occurs by itself: in program files and in the lists of modules of a configuration.
std::vector<TextEdit> renamedIn(const SourceFile& file, const std::string& from, const std::string& to) {
    std::vector<TextEdit> edits;
    const std::string text = rapid::config::upperCase(file.text()), name = rapid::config::upperCase(from);
    const auto isBorder = [&](size_t at) {
        return at >= text.size() ||
               std::string_view("<>\"/\\: \t\r\n").find(text[at]) != std::string_view::npos;
    };
    for (size_t i = text.find(name); i != std::string::npos; i = text.find(name, i + name.size()))
        if (i > 0 && isBorder(i - 1) && isBorder(i + name.size()))
            edits.push_back({{static_cast<uint32_t>(i), static_cast<uint32_t>(i + name.size())}, to});
    return edits;
}

void renameMentions(State& state, const fs::path& from, const fs::path& to, FileEdits& out) {
    std::vector<std::string> texts;
    for (const fs::path& path : rapid::project::entries(from.parent_path()))
        if (rapid::project::extensionOf(path) == ".pgf") texts.push_back(path.string());
    if (const auto* program = state.workspace.programOf(from.string()))
        for (const std::string& name : program->loaded().configNames)
            if (name.starts_with('/')) texts.push_back(name);
    for (const std::string& path : texts) {
        const auto file = state.workspace.read(path);
        if (!file) continue;
        auto edits = renamedIn(*file, from.filename().string(), to.filename().string());
        if (!edits.empty()) out.push_back({file, std::move(edits)});
    }
}

/// The line of the module's task in the list of a backup: `PROGMOD/main.mod @ main.mod` below `>>TASK1: (T_ROB1,,)`.
void renameListed(State& state, const fs::path& from, const fs::path& to, FileEdits& out) {
    const fs::path folder = from.parent_path(), task = folder.parent_path();
    const fs::path list = rapid::project::findPath(task.parent_path().parent_path(), "BACKINFO/backinfo.txt");
    const auto file = list.empty() ? nullptr : state.workspace.read(list.string());
    if (!file) return;
    const std::string section = rapid::config::upperCase(">>" + task.filename().string() + ":");
    const std::string module = rapid::config::upperCase((folder.filename() / from.filename()).string());
    std::vector<TextEdit> edits;
    bool inSection = false;
    for (size_t begin = 0; begin < file->text().size();) {
        const size_t end = std::min(file->text().find_first_of("\r\n", begin), file->text().size());
        std::string line = rapid::config::upperCase(file->text().substr(begin, end - begin));
        std::replace(line.begin(), line.end(), '\\', '/');
        line = rapid::config::trimmed(line);
        if (line.starts_with(">>")) inSection = line.starts_with(section);
        if (inSection && rapid::config::trimmed(line.substr(0, line.find('@'))) == module)
            for (TextEdit edit : renamedIn(*file, from.filename().string(), to.filename().string()))
                if (edit.range.begin >= begin && edit.range.end <= end) edits.push_back(std::move(edit));
        begin = end + 1;
    }
    if (!edits.empty()) out.push_back({file, std::move(edits)});
}

} // namespace

Json willRenameFiles(State& state, const Json& params) {
    FileEdits edits;
    for (const Json& each : arrayField(params, "files")) {
        const auto from = pathOf(textField(each, "oldUri")), to = pathOf(textField(each, "newUri"));
        if (!from || !to || !rapid::project::isModule(*from) || !rapid::project::isModule(*to)) continue;
        renameModule(state, *from, *to, edits);
        renameMentions(state, *from, *to, edits);
        renameListed(state, *from, *to, edits);
    }
    if (edits.empty()) return nullptr;
    return state.workspaceEdit(edits);
}

void filesRenamed(State& state, const Json& params) {
    for (const Json& each : arrayField(params, "files"))
        for (const char* name : {"oldUri", "newUri"})
            if (const auto path = pathOf(textField(each, name))) state.workspace.fileChanged(*path);
}

void filesCreatedOrDeleted(State& state, const Json& params) {
    for (const Json& each : arrayField(params, "files"))
        if (const auto path = pathOf(textField(each, "uri"))) state.workspace.fileChanged(*path);
}

} // namespace lsp
