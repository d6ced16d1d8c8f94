#include "frontend/project/neighbours.h"

#include "config/read_file.h"
#include "config/text_util.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/names.h"
#include "frontend/project/files.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/ast.h"
#include "frontend/syntax/parser.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace rapid::project {

namespace fs = std::filesystem;
using diag::Code;
namespace say = diag::say;
using diag::Diagnostic;

namespace {

/// More modules in one folder are a collection rather than a program.
constexpr size_t kMostNeighbours = 64;
constexpr uintmax_t kMostBytes = uintmax_t{4} << 20;

bool isUnknown(const Diagnostic& d) {
    constexpr Code kCodes[] = {say::UnknownName.code,     say::UnknownType.code, say::UnknownProcedure.code,
                               say::UnknownFunction.code, say::UnknownTrap.code, say::SignalUnknown.code};
    return d.file && std::find(std::begin(kCodes), std::end(kCodes), d.code) != std::end(kCodes);
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The other folder of a task's modules in a backup: SYSMOD of PROGMOD and the other way round; else empty.
fs::path partnerOf(const fs::path& folder) {
    const std::string name = folder.filename().string();
    const fs::path task = folderOf(folder);
    if (config::sameName(name, "PROGMOD")) return findEntry(task, "SYSMOD");
    if (config::sameName(name, "SYSMOD")) return findEntry(task, "PROGMOD");
    return {};
}

/// The declarations for all modules in the modules beside some inputs, by name.
class Neighbours {
  public:
    explicit Neighbours(const std::vector<std::string>& inputs) {
        std::error_code error;
        for (const std::string& input : inputs) {
            if (!fs::is_regular_file(input, error) || !isModule(input)) continue;
            given_.insert(fs::weakly_canonical(input, error));
            folders_.insert(folderOf(input));
            if (const fs::path partner = partnerOf(folderOf(input)); !partner.empty())
                folders_.insert(partner);
        }
        for (const fs::path& folder : folders_)
            readFolder(folder);
    }

    const Diagnostic::Note* find(const Diagnostic& unknown) const {
        const SourceRange range = unknown.range;
        const auto found =
            names_.find(sema::foldName(unknown.file->text().substr(range.begin, range.end - range.begin)));
        if (found == names_.end()) return nullptr;
        const Diagnostic::Note& note = found->second;
        const fs::path here = folderOf(unknown.file->path()), there = folderOf(note.file->path());
        return here == there || partnerOf(here) == there ? &note : nullptr;
    }

  private:
    void readFolder(const fs::path& folder) {
        std::vector<fs::path> beside;
        uintmax_t bytes = 0;
        std::error_code error;
        for (const fs::path& path : entries(folder)) {
            if (!isModule(path) || given_.contains(fs::weakly_canonical(path, error))) continue;
            bytes += fs::file_size(path, error);
            beside.push_back(path);
            if (beside.size() > kMostNeighbours || bytes > kMostBytes) return;
        }
        for (const fs::path& path : beside)
            readFile(path);
    }

    void readFile(const fs::path& path) {
        diag::Sink ignored;
        std::string bytes;
        if (!config::readFile(path.string(), bytes).empty()) return;
        const auto source = std::make_shared<const SourceFile>(path.string(), std::move(bytes));
        if (source->isEncrypted()) return;
        const auto tree = syntax::parse(source, ignored);
        for (const syntax::ModuleDecl* module : tree->modules)
            for (const syntax::Decl* decl : module->decls)
                if (const syntax::TokenIndex name = globalName(*decl); name != syntax::kNoToken)
                    add(*tree, name);
    }

    /// The name that a declaration gives to all modules.
    static syntax::TokenIndex globalName(const syntax::Decl& decl) {
        using syntax::NodeKind;
        switch (decl.kind) {
        case NodeKind::Data: {
            const auto& data = syntax::as<syntax::DataDecl>(decl);
            return data.scope == syntax::ScopeWord::Local ? syntax::kNoToken : data.name;
        }
        case NodeKind::Routine: {
            const auto& routine = syntax::as<syntax::RoutineDecl>(decl);
            return routine.local ? syntax::kNoToken : routine.name;
        }
        case NodeKind::Record: {
            const auto& record = syntax::as<syntax::RecordDecl>(decl);
            return record.local ? syntax::kNoToken : record.name;
        }
        default: return syntax::kNoToken;
        }
    }

    void add(const syntax::SyntaxTree& tree, syntax::TokenIndex name) {
        const std::string text(tree.text(name));
        names_.try_emplace(
            sema::foldName(text),
            Diagnostic::Note{tree.source, tree.range(name),
                             fmt::format("'{}' is declared here: check both files together, or the "
                                         "folder",
                                         text)});
    }

    std::set<fs::path> given_, folders_;
    std::map<std::string, Diagnostic::Note> names_;
};

} // namespace

void noteNeighbours(diag::Sink& sink, const std::vector<std::string>& inputs) {
    const std::vector<Diagnostic>& all = sink.all();
    if (std::none_of(all.begin(), all.end(), isUnknown)) return;
    const Neighbours neighbours(inputs);
    sink.revise([&](Diagnostic& d) {
        const Diagnostic::Note* note = isUnknown(d) ? neighbours.find(d) : nullptr;
        if (note) {
            d.notes.push_back(*note);
            d.fixes.clear(); // the name is right
            if (const size_t guess = d.message.find("; did you mean"); guess != std::string::npos)
                d.message.erase(guess);
        }
        return true;
    });
}

} // namespace rapid::project
