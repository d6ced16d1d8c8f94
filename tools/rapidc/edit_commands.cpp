// rapidc rename, rapidc set-value: small changes of modules that leave every other byte alone.

#include "runtime/host/command_line.h"
#include "tools/program/module_store.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/text_diff.h"
#include "tools/rapidc/usage.h"

#include "config/atomic_file.h"
#include "config/read_file.h"
#include "config/temporary.h"
#include "frontend/edit/apply_edits.h"
#include "frontend/edit/initial_value.h"
#include "frontend/edit/rename.h"
#include "frontend/syntax/parser.h"
#include "runtime/host/run_options.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace rapidc {

namespace {

namespace diag = rapid::diag;
namespace edit = rapid::edit;
namespace sema = rapid::sema;

struct EditSettings {
    std::string change; ///< set-value: NAME=VALUE
    std::string oldName;
    std::string newName;
    std::string values; ///< set-value: file with lines MODULE.DATA=VALUE
    std::string output;
    Inputs inputs;
    bool diff = false;
};

int fail(const char* command, const std::string& problem, int status = 1) {
    fmt::print(stderr, "rapidc {}: {}\n", command, problem);
    return status;
}

/// Writes the changed files, or shows the changes; all files are made in memory before the first one is written.
int writeFiles(const char* command, const edit::EditSet& set, bool diffOnly) {
    std::vector<std::pair<std::string, std::string>> files;
    for (const edit::FileEdits& file : set.files) {
        if (diffOnly) {
            fmt::print("{}", unifiedDiff(*file.file, file.edits));
            continue;
        }
        auto result = edit::applyEdits(*file.file, file.edits);
        if (!result.ok()) return fail(command, file.file->path() + ": " + result.problem);
        files.emplace_back(file.file->path(), std::move(result.bytes));
    }
    std::vector<std::string> paths;
    for (const auto& [path, bytes] : files)
        paths.push_back(path);
    rapid::config::removeLeftoversBeside(paths);
    for (const auto& [path, bytes] : files) {
        const std::string problem = rapid::config::replaceFile(path, bytes);
        if (!problem.empty()) return fail(command, problem);
    }
    for (const std::string& note : set.notes)
        fmt::print(stderr, "note: {}\n", note);
    return 0;
}

/// Loads what the inputs name; null with the status when that is not possible.
std::unique_ptr<Compilation> load(const char* command, const Inputs& inputs, int& status) {
    auto compilation = checkInputs(inputs);
    for (const std::string& problem : compilation->usageErrors)
        status = fail(command, problem, kBadUsage);
    if (compilation->usageErrors.empty()) return compilation;
    return nullptr;
}

int renameName(const EditSettings& settings) {
    int status = 0;
    const auto compilation = load("rename", settings.inputs, status);
    if (!compilation) return status;
    if (compilation->sink.hasErrors()) {
        printDiagnostics(*compilation);
        return fail("rename", "the program has errors: correct them before renaming");
    }
    const auto set = edit::rename(std::move(compilation->program), compilation->tasks, compilation->options,
                                  settings.oldName, settings.newName);
    return set.ok() ? writeFiles("rename", set, settings.diff) : fail("rename", set.problem);
}

/// The files of all tasks, each once.
std::vector<std::shared_ptr<const rapid::SourceFile>> filesOf(const Compilation& compilation) {
    std::vector<std::shared_ptr<const rapid::SourceFile>> files;
    std::set<std::string_view> seen;
    for (const sema::TaskInput& task : compilation.tasks)
        for (const auto& file : task.files)
            if (seen.insert(file->path()).second) files.push_back(file);
    return files;
}

/// Whether the checker accepts the value; what it says about it is shown.
bool checkValue(const Compilation& compilation, const edit::FileEdits& change) {
    const auto result = edit::applyEdits(*change.file, change.edits);
    if (!result.ok()) return true; // said when it is written
    const auto changed = std::make_shared<const rapid::SourceFile>(change.file->path(), result.bytes);
    std::vector<sema::TaskInput> tasks = compilation.tasks;
    for (sema::TaskInput& task : tasks)
        for (auto& file : task.files)
            if (file->path() == changed->path()) file = changed;
    diag::Sink sink;
    const auto program = sema::check(tasks, compilation.options, sink);
    const rapid::TextEdit& value = change.edits.front();
    const rapid::SourceRange range{value.range.begin,
                                   value.range.begin + static_cast<uint32_t>(value.replacement.size())};
    bool good = true;
    for (const diag::Diagnostic& diagnostic : sink.sorted()) {
        const bool here = diagnostic.file == changed && diagnostic.severity == diag::Severity::Error &&
                          diagnostic.range.begin <= range.end && diagnostic.range.end >= range.begin;
        if (here) fmt::print(stderr, "{}", diag::renderText(diagnostic, false));
        good = good && !here;
    }
    return good;
}

/// MODULE.DATA=VALUE; false when the line is something else.
bool readValue(const std::string& line, rt::SavedValue& value) {
    const size_t equals = line.find('='), dot = line.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
        return false;
    value = {line.substr(0, dot), line.substr(dot + 1, equals - dot - 1), line.substr(equals + 1)};
    return true;
}

/// The module may be written in its own place, the values may not be overwritten.
std::string destinationConflict(const EditSettings& settings, const rt::ModuleText& text) {
    std::error_code ignored;
    return settings.values != "-" && std::filesystem::equivalent(settings.values, text.destination, ignored)
               ? fmt::format("--output '{}' would overwrite the values", text.destination)
               : std::string();
}

/// Many values in one step: persistents whose declarations still have initial values of that form. What built
/// executables call.
int setValues(const EditSettings& settings) {
    if (settings.inputs.paths.size() != 1 || !settings.inputs.tasks.empty())
        return fail("set-value", "--values changes one file: name one module file, without --task",
                    kBadUsage);
    rt::ModuleText text;
    text.source = settings.inputs.paths.front();
    text.destination = settings.output.empty() ? text.source : settings.output;
    std::string values;
    if (const std::string problem = rapid::config::readStream(settings.values, values); !problem.empty())
        return fail("set-value", fmt::format("cannot read '{}': {}", settings.values, problem), kBadUsage);
    if (const std::string conflict = destinationConflict(settings, text); !conflict.empty())
        return fail("set-value", conflict, kBadUsage);
    std::istringstream lines(values);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty()) continue;
        if (!readValue(line, text.values.emplace_back()))
            return fail("set-value", fmt::format("cannot read '{}': expected MODULE.DATA=VALUE", line),
                        kBadUsage);
    }
    const rt::StoreResult result = SourceStore().store(text);
    if (!result.problem.empty()) return fail("set-value", result.problem);
    for (const std::string& note : result.notes)
        fmt::print(stderr, "{}\n", note);
    return 0;
}

int setValue(const EditSettings& settings) {
    const size_t equals = settings.change.find('=');
    if (equals == std::string::npos || equals == 0)
        return fail("set-value", fmt::format("cannot read '{}': expected MODULE.DATA=VALUE", settings.change),
                    kBadUsage);
    if (settings.inputs.paths.empty()) return fail("set-value", "input is required", kBadUsage);
    const std::string path = settings.change.substr(0, equals), value = settings.change.substr(equals + 1);
    int status = 0;
    const auto compilation = load("set-value", settings.inputs, status);
    if (!compilation) return status;
    const auto files = filesOf(*compilation);
    if (files.empty()) { // nothing could be read, which was reported
        printDiagnostics(*compilation);
        return 1;
    }
    edit::EditSet found;
    bool declared = false;
    for (const auto& file : files) {
        diag::Sink ignored;
        const auto tree = rapid::syntax::parse(file, ignored);
        if (!edit::declaresData(*tree, path)) continue;
        if (declared)
            return fail("set-value", fmt::format("several modules declare '{}': name the module too", path));
        declared = true;
        found = edit::setInitialValue(*tree, path, value);
        if (!found.ok()) return fail("set-value", found.problem);
    }
    if (!declared) return fail("set-value", fmt::format("no module declares data '{}'", path));
    if (found.files.empty()) return 0; // the value is there already
    if (!checkValue(*compilation, found.files.front()))
        return fail("set-value", "the value does not fit; the file is left as it is");
    return writeFiles("set-value", found, settings.diff);
}

rt::Option addInputs(const rt::Command& command, EditSettings& settings) {
    const rt::Option input =
        command.add("input", settings.inputs.paths, "Modules, folders, .pgf programs, backups");
    addTaskOption(command, settings.inputs);
    command.addFlag("--diff", settings.diff, "Change nothing; show what would change");
    return input;
}

} // namespace

void addRenameCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<EditSettings>();
    const rt::Command command =
        line.addCommand("rename", "Rename data, a routine, a type or a label everywhere",
                        [settings] { return renameName(*settings); });
    command.add("old", settings->oldName, "NAME, MODULE.NAME or MODULE.ROUTINE.NAME").required();
    command.add("new", settings->newName, "The new name").required();
    addInputs(command, *settings).required();
}

void addSetValueCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<EditSettings>();
    const auto body = [settings] {
        if (settings->values.empty()) {
            return settings->output.empty() ? setValue(*settings)
                                            : fail("set-value", "--output needs --values", kBadUsage);
        }
        // There is no change to name: the first word is the input.
        settings->inputs.paths.insert(settings->inputs.paths.begin(), settings->change);
        return setValues(*settings);
    };
    const rt::Command command =
        line.addCommand("set-value", "Write an initial value into the declaration of data", body);
    command.add("--values", settings->values,
                "Lines MODULE.DATA=VALUE for persistents of one module file; - is the standard input");
    command.add("--output", settings->output, "With --values: the file to write instead of the input");
    command.add("change", settings->change, "MODULE.DATA=VALUE; not with --values");
    addInputs(command, *settings);
}

} // namespace rapidc
