// textDocument/hover and textDocument/signatureHelp.

#include "config/json_text.h"
#include "frontend/query/signature_help.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

namespace lsp {

namespace query = rapid::query;

namespace {

/// Whether the client shows Markdown there; without a word about it, it is not asked to.
bool showsMarkdown(const State& state, std::string_view capability) {
    return hasElement(state.capability(capability), "markdown");
}

std::string plainText(const query::Hover& hover) {
    std::string text = hover.declaration;
    for (const std::string* part : {&hover.value, &hover.documentation, &hover.facts, &hover.table})
        if (!part->empty())
            text += (text.empty() ? "" : "\n\n") + (part == &hover.value ? "= " + *part : *part);
    return text;
}

/// UTF-16 units of the first bytes of a label.
uint32_t unitsOf(const std::string& label, uint32_t bytes) {
    const auto file = std::make_shared<const rapid::SourceFile>("label.modx", label);
    return PositionMap(file, PositionEncoding::Utf16).at(bytes).character;
}

} // namespace

Json toJson(State& state, const Target& target, const query::Hover& hover) {
    const bool markdown = showsMarkdown(state, "textDocument.hover.contentFormat");
    const Json contents{{"kind", markdown ? "markdown" : "plaintext"},
                        {"value", markdown ? hover.markdown() : plainText(hover)}};
    return {{"contents", contents}, {"range", toJson(target.positions->range(hover.range))}};
}

Json hover(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return configurationHover(state, target);
    const auto found = query::hoverAt(*target.snapshot, *target.view, target.offset);
    return found ? toJson(state, target, *found) : Json(nullptr);
}

Json signatureHelp(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return nullptr;
    const auto found = query::signatureHelpAt(*target.snapshot, *target.view, target.offset);
    if (!found) return nullptr;
    const bool markdown =
        showsMarkdown(state, "textDocument.signatureHelp.signatureInformation.documentationFormat");
    const bool offsets =
        state.can("textDocument.signatureHelp.signatureInformation.parameterInformation.labelOffsetSupport");
    const auto documentation = [&](const std::string& text) {
        return Json{{"kind", markdown ? "markdown" : "plaintext"}, {"value", text}};
    };
    Json parameters = Json::array();
    for (const query::SignatureParameter& parameter : found->parameters) {
        Json label = found->label.substr(parameter.begin, parameter.end - parameter.begin);
        if (offsets)
            label =
                Json::array({unitsOf(found->label, parameter.begin), unitsOf(found->label, parameter.end)});
        Json item{{"label", std::move(label)}};
        if (!parameter.documentation.empty()) item["documentation"] = documentation(parameter.documentation);
        parameters.push_back(std::move(item));
    }
    const auto active = found->active >= 0 ? static_cast<size_t>(found->active) : found->parameters.size();
    Json signature{
        {"label", found->label}, {"parameters", std::move(parameters)}, {"activeParameter", active}};
    if (!found->documentation.empty()) signature["documentation"] = documentation(found->documentation);
    return {{"signatures", Json::array({std::move(signature)})},
            {"activeSignature", 0},
            {"activeParameter", active}};
}

} // namespace lsp
