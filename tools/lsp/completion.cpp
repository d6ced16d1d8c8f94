// textDocument/completion and completionItem/resolve.

#include "config/json_text.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

#include <fmt/format.h>

namespace lsp {

namespace query = rapid::query;
using query::CompletionItem;
using query::ItemKind;

namespace {

/// CompletionItemKind
int kindOf(ItemKind kind) {
    switch (kind) {
    case ItemKind::Keyword: return 14;
    case ItemKind::Snippet: return 15;
    case ItemKind::Procedure: return 2; // Method
    case ItemKind::Function: return 3;
    case ItemKind::Trap: return 23; // Event
    case ItemKind::Variable:
    case ItemKind::Persistent:
    case ItemKind::Parameter: return 6;
    case ItemKind::Constant: return 21;
    case ItemKind::OptionalArgument: return 10; // Property
    case ItemKind::Component: return 5;         // Field
    case ItemKind::Type: return 22;             // Struct
    case ItemKind::Module: return 9;
    case ItemKind::Signal: return 23;
    case ItemKind::Label: return 18; // Reference
    case ItemKind::Value: return 12;
    case ItemKind::NewData: return 4; // Constructor
    }
    return 1;
}

struct Style {
    bool snippets = false;
    bool adjusts = false; ///< the client can be asked to indent the lines of a text
};

Json itemJson(const State& state, const Target& target, const Json& range, const CompletionItem& item,
              const Style& style) {
    const bool snippet = style.snippets && !item.snippet.empty();
    Json out{{"label", item.label},
             {"kind", kindOf(item.kind)},
             {"textEdit", {{"range", range}, {"newText", snippet ? item.snippet : item.insertText}}}};
    if (snippet) out["insertTextFormat"] = 2;
    const std::string& text = snippet ? item.snippet : item.insertText;
    if (style.adjusts && text.find('\n') != std::string::npos) out["insertTextMode"] = 2;
    if (!item.detail.empty()) out["detail"] = item.detail;
    if (!item.sortText.empty()) out["sortText"] = item.sortText;
    if (!item.filterText.empty() && item.filterText != item.label) // the label counts otherwise
        out["filterText"] = item.filterText;
    if (!item.edits.empty()) out["additionalTextEdits"] = state.edits(*target.positions, item.edits);
    if (!item.key.empty()) out["data"] = {{"path", target.path}, {"key", item.key}};
    return out;
}

} // namespace

Json toJson(State& state, const Target& target, const query::CompletionList& list) {
    const Json range = lsp::toJson(target.positions->range(list.replace));
    Style style;
    style.snippets = state.can("textDocument.completion.completionItem.snippetSupport");
    style.adjusts = hasElement(
        state.capability("textDocument.completion.completionItem.insertTextModeSupport.valueSet"), 2);
    Json items = Json::array();
    for (const CompletionItem& item : list.items)
        items.push_back(itemJson(state, target, range, item, style));
    return {{"isIncomplete", list.incomplete}, {"items", std::move(items)}};
}

Json completion(State& state, const Json& params) {
    const Target target = state.targetWhileTyping(params);
    if (!target.isModule()) return configurationCompletion(state, target);
    query::CompletionOptions options;
    options.limit = 1000; // more than anyone reads; the next letter asks again
    return toJson(state, target,
                  query::completionAt(*target.snapshot, *target.view, target.offset, options, state.cancel));
}

Json resolveCompletion(State& state, const Json& params) {
    textField(params, "label");
    Json item = params;
    const Json* data = optionalField(params, "data");
    if (!data || !data->is_object()) return item;
    const std::string path = textField(*data, "path"), key = textField(*data, "key");
    // Editors ask between two letters: the rest of a change need not have been checked.
    const rapid::workspace::Program* program = state.workspace.programAsAnswered(path);
    if (!program) program = state.workspace.programOf(path);
    if (!program) return item;
    const query::ItemDocumentation found = query::resolveItem(state.snapshot(*program), key);
    const bool markdown = hasElement(
        state.capability("textDocument.completion.completionItem.documentationFormat"), "markdown");
    const std::string declaration = found.declaration.empty() || !markdown
                                        ? found.declaration
                                        : fmt::format("```rapid\n{}\n```", found.declaration);
    std::string text = declaration;
    if (!text.empty() && !found.markdown.empty()) text += "\n\n";
    text += found.markdown;
    if (!text.empty())
        item["documentation"] = {{"kind", markdown ? "markdown" : "plaintext"}, {"value", text}};
    return item;
}

} // namespace lsp
