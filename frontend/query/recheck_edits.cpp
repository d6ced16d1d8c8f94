#include "frontend/query/recheck_edits.h"

#include "frontend/edit/apply_edits.h"
#include "frontend/sema/names.h"
#include "frontend/sema/references.h"

#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace rapid::query {

using namespace sema;

std::vector<TaskInput> withEdits(const std::vector<TaskInput>& tasks,
                                 const std::vector<edit::FileEdits>& files, std::string& problem) {
    std::unordered_map<std::string, std::shared_ptr<const SourceFile>> changed;
    for (const edit::FileEdits& file : files) {
        auto result = edit::applyEdits(*file.file, file.edits);
        if (!result.ok()) {
            problem = file.file->path() + ": " + result.problem;
            return tasks;
        }
        changed[file.file->path()] =
            std::make_shared<const SourceFile>(file.file->path(), std::move(result.bytes));
    }
    std::vector<TaskInput> out = tasks;
    for (TaskInput& task : out)
        for (auto& file : task.files)
            if (const auto found = changed.find(file->path()); found != changed.end()) file = found->second;
    return out;
}

namespace {

std::map<diag::Code, size_t> errorsOf(const diag::Sink& sink) {
    std::map<diag::Code, size_t> counts;
    for (const diag::Diagnostic& d : sink.all())
        if (d.severity == diag::Severity::Error) ++counts[d.code];
    return counts;
}

/// A name and its declaration, as places that both programs have: files keep their number of tokens.
struct NamedPlace {
    std::string path;
    syntax::TokenIndex token;
    std::string declaredIn;
    syntax::TokenIndex declared;
    bool operator==(const NamedPlace&) const = default;
};

NamedPlace placeOf(const Reference& reference) {
    const Symbol& symbol = *reference.symbol;
    const bool outside = symbol.predefined || !symbol.module || !symbol.decl;
    return {reference.module->tree->source->path(), reference.token,
            outside ? foldName(symbol.name) : symbol.module->tree->source->path(),
            outside ? syntax::kNoToken : symbol.nameToken};
}

std::string whereIs(const diag::Diagnostic& d) {
    return d.file ? fmt::format("{}:{}: ", d.file->path(), d.file->lineColumn(d.range.begin).line) : "";
}

} // namespace

std::string meaningProblem(const Snapshot& snapshot, const std::vector<TaskInput>& tasks,
                           const CheckOptions& options, const std::vector<edit::FileEdits>& files) {
    std::string problem;
    const std::vector<TaskInput> changed = withEdits(tasks, files, problem);
    if (!problem.empty()) return problem;
    diag::Sink sink, old;
    const auto after = check(changed, options, sink);
    if (sink.hasErrors()) {
        check(tasks, options, old);
        const auto before = errorsOf(old);
        std::map<diag::Code, size_t> seen;
        for (const diag::Diagnostic& d : sink.sorted()) {
            if (d.severity != diag::Severity::Error) continue;
            const auto known = before.find(d.code);
            if (++seen[d.code] > (known == before.end() ? 0 : known->second)) return whereIs(d) + d.message;
        }
    }
    const std::vector<Reference> was = collectReferences(snapshot.program()), is = collectReferences(*after);
    for (size_t i = 0; i < std::min(was.size(), is.size()); ++i) {
        if (placeOf(was[i]) == placeOf(is[i])) continue;
        const syntax::SyntaxTree& tree = *was[i].module->tree;
        const LineColumn at = tree.source->lineColumn(tree.tokens[was[i].token].offset);
        return fmt::format("at {}:{}:{} the name '{}' would mean something else: choose another name",
                           tree.source->path(), at.line, at.column, tree.text(was[i].token));
    }
    return was.size() == is.size() ? "" : "a name would lose its meaning: choose another name";
}

} // namespace rapid::query
