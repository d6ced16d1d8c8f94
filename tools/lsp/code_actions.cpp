// textDocument/codeAction: the fixes of diagnostics, found by place, and what the query library can rewrite.

#include "config/json_text.h"
#include "frontend/query/refactoring.h"
#include "tools/lsp/diagnostics.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <cctype>

namespace lsp {

namespace query = rapid::query;
using rapid::SourceRange;
using rapid::TextEdit;
using rapid::diag::Diagnostic;

namespace {

/// Whether the client wants actions of this kind; a kind includes those below it ("source" for "source.fixAll").
bool isWanted(const Json* only, const std::string& kind) {
    if (!only || !only->is_array()) return true;
    return std::any_of(only->begin(), only->end(), [&](const Json& each) {
        if (!each.is_string()) return false;
        const auto wanted = each.get<std::string>();
        return wanted.empty() || kind == wanted || kind.starts_with(wanted + ".");
    });
}

bool touch(SourceRange a, SourceRange b) {
    return a.begin <= b.end && b.begin <= a.end;
}

std::string titleOf(std::string message) {
    if (!message.empty())
        message[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(message[0])));
    return message;
}

Json quickFix(State& state, const Target& target, const Diagnostic& diagnostic, const Diagnostic::Fix& fix) {
    Json action{{"title", titleOf(fix.message)},
                {"kind", "quickfix"},
                {"diagnostics", Json::array({toJson(state, diagnostic)})},
                {"edit", state.workspaceEdit({{target.positions->source(), fix.edits}})}};
    if (fix.certain) action["isPreferred"] = true;
    return action;
}

/// The certain fixes of a document that do not touch each other.
std::vector<TextEdit> certainFixes(const std::vector<const Diagnostic*>& diagnostics) {
    std::vector<TextEdit> edits;
    for (const Diagnostic* diagnostic : diagnostics) {
        const auto certain = std::find_if(diagnostic->fixes.begin(), diagnostic->fixes.end(),
                                          [](const Diagnostic::Fix& fix) { return fix.certain; });
        if (certain == diagnostic->fixes.end()) continue;
        const bool collides =
            std::any_of(certain->edits.begin(), certain->edits.end(), [&](const TextEdit& fresh) {
                return std::any_of(edits.begin(), edits.end(),
                                   [&](const TextEdit& taken) { return touch(fresh.range, taken.range); });
            });
        if (!collides) edits.insert(edits.end(), certain->edits.begin(), certain->edits.end());
    }
    return edits;
}

} // namespace

namespace {

const char* kindOf(query::RefactoringKind kind) {
    switch (kind) {
    case query::RefactoringKind::QuickFix: return "quickfix";
    case query::RefactoringKind::Extract: return "refactor.extract";
    case query::RefactoringKind::Inline: return "refactor.inline";
    case query::RefactoringKind::Rewrite: return "refactor.rewrite";
    case query::RefactoringKind::Organize: return "source.organize";
    }
    return "refactor";
}

void addRefactorings(State& state, const Target& target, SourceRange range, const Json* only,
                     const std::vector<const Diagnostic*>& diagnostics, Json& actions) {
    for (const query::Refactoring& found :
         query::refactoringsAt(*target.snapshot, *target.view, range, state.cancel)) {
        const std::string kind = kindOf(found.kind);
        if (!isWanted(only, kind)) continue;
        Json action{{"title", found.title},
                    {"kind", kind},
                    {"edit", state.workspaceEdit({{target.positions->source(), found.edits}})}};
        if (found.kind == query::RefactoringKind::QuickFix) {
            Json about = Json::array();
            for (const Diagnostic* diagnostic : diagnostics)
                if (diagnostic->file && touch(diagnostic->range, range))
                    about.push_back(toJson(state, *diagnostic));
            action["diagnostics"] = std::move(about);
        }
        actions.push_back(std::move(action));
    }
}

} // namespace

Json codeActions(State& state, const Json& params) {
    const Target target = state.target(params);
    const SourceRange range = target.positions->offsets(rangeOf(field(params, "range")));
    const Json& context = objectField(params, "context");
    arrayField(context, "diagnostics");
    const Json* only = optionalField(context, "only");
    const std::vector<const Diagnostic*> diagnostics = diagnosticsOf(state, target.path);
    Json actions = Json::array();
    if (isWanted(only, "quickfix"))
        for (const Diagnostic* diagnostic : diagnostics)
            if (diagnostic->file && touch(diagnostic->range, range))
                for (const Diagnostic::Fix& fix : diagnostic->fixes)
                    actions.push_back(quickFix(state, target, *diagnostic, fix));
    if (target.isModule()) addRefactorings(state, target, range, only, diagnostics, actions);
    if (isWanted(only, "source.fixAll"))
        if (const auto edits = certainFixes(diagnostics); !edits.empty())
            actions.push_back({{"title", "Fix all mistakes with certain fixes"},
                               {"kind", "source.fixAll"},
                               {"edit", state.workspaceEdit({{target.positions->source(), edits}})}});
    return actions;
}

} // namespace lsp
