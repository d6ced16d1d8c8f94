#include "frontend/query/renaming.h"

#include "frontend/edit/rename.h"
#include "frontend/query/recheck_edits.h"
#include "frontend/query/shared_types.h"
#include "frontend/sema/names.h"

#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace rapid::query {

using namespace sema;
using namespace syntax;

RenameTarget renameTargetAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    RenameTarget target;
    if (isInComment(file, offset)) {
        target.problem = "a comment cannot be renamed";
        return target;
    }
    const TokenIndex word = wordAt(file, offset);
    if (word == kNoToken) {
        target.problem = "there is no name here";
        return target;
    }
    target.range = file.tree->range(word);
    target.name = std::string(file.tree->text(word));
    const Meaning meaning = meaningOf(snapshot, file, word);
    const DataSymbol* data = dataOf(meaning.symbol);
    if (!meaning.found())
        target.problem = file.tree->tokens[word].kind == TokenKind::Identifier
                             ? fmt::format("nothing declares '{}'", target.name)
                             : fmt::format("'{}' is a word of the language", target.name);
    else if (data && data->storage == Storage::Signal)
        target.problem =
            fmt::format("'{}' is a name of the configuration: it cannot be renamed here", target.name);
    else if (const Location place = declarationOf(snapshot, meaning); place.isLibrary || !place.file)
        target.problem = fmt::format("'{}' is predefined: it cannot be renamed", target.name);
    else
        for (const auto& task : snapshot.program().tasks)
            if (meaning.symbol && task->entryRoutine &&
                locationOf(snapshot, *task->entryRoutine) == locationOf(snapshot, *meaning.symbol))
                target.problem =
                    fmt::format("task {} starts with '{}': it cannot be renamed", task->name, target.name);
    return target;
}

namespace {

/// Two components of a record, or a component and nothing else: the checker says it, and more than that is not needed.
std::vector<edit::FileEdits> editsOf(const std::vector<Use>& uses, std::string_view newName) {
    std::map<std::string, edit::FileEdits> byFile;
    for (const Use& use : uses) {
        edit::FileEdits& file = byFile[use.place.file->path()];
        file.file = use.place.file;
        file.edits.push_back({use.place.range, std::string(newName)});
    }
    std::vector<edit::FileEdits> files;
    for (auto& [path, file] : byFile)
        files.push_back(std::move(file));
    return files;
}

} // namespace

RenameResult renameAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                      std::string_view newName, const std::vector<TaskInput>& tasks,
                      const CheckOptions& options, const Cancel* cancel) {
    RenameResult result;
    const RenameTarget target = renameTargetAt(snapshot, file, offset);
    result.problem = target.problem;
    if (!result.problem.empty()) return result;
    const Meaning meaning = meaningAt(snapshot, file, offset);
    result.problem = edit::newNameProblem(newName, snapshot.program(), meaning.record != nullptr);
    if (!result.problem.empty() || target.name == newName) return result;
    std::vector<Use> uses;
    std::set<std::pair<std::string, uint32_t>> known; // places
    for (const Meaning& alike : alikeInAllTasks(snapshot, meaning))
        for (Use& use : usesOf(snapshot, alike, true, cancel))
            if (known.emplace(use.place.file->path(), use.place.range.begin).second)
                uses.push_back(std::move(use));
    result.files = editsOf(uses, newName);
    if (isCancelled(cancel)) return {};
    result.problem = meaningProblem(snapshot, tasks, options, result.files);
    if (!result.problem.empty()) {
        result.files.clear();
        return result;
    }
    if (meaning.record) return result;
    for (Location& place : stringsSpelling(snapshot, target.name, cancel)) {
        std::string text =
            fmt::format("the string {} spells the old name and stays as it is",
                        place.file->text().substr(place.range.begin, place.range.end - place.range.begin));
        result.notes.push_back({std::move(place), std::move(text)});
    }
    return result;
}

} // namespace rapid::query
