// textDocument/hover and textDocument/signatureHelp.

#include "config/cfg_parser.h"
#include "config/json_text.h"
#include "frontend/query/meaning.h"
#include "frontend/query/signature_help.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <cmath>

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

namespace {

/// The model that MOC.cfg names; empty when there is none, or when its base is not at the origin of the world.
std::string robotOf(const rapid::workspace::Program& program) {
    const auto& loaded = program.loaded();
    for (size_t i = 0; i < loaded.configTexts.size(); ++i) {
        std::vector<rapid::config::CfgProblem> ignored;
        const auto file = rapid::config::parseCfg(loaded.configTexts[i], loaded.configNames[i], ignored);
        if (file.domain != "MOC") continue;
        for (const auto* section : file.find("ROBOT"))
            for (const auto& robot : section->instances) {
                for (const char* name : {"base_frame_pos_x", "base_frame_pos_y", "base_frame_pos_z"})
                    if (double offset = 0; robot.number(name, offset) && offset != 0) return {};
                if (double upright = 1; robot.number("base_frame_orient_u0", upright) && upright != 1)
                    return {};
                if (const std::string model = robot.text("use_robot_type"); !model.empty()) return model;
            }
    }
    return {};
}

/// Whether the robot of the program reaches the constant robtarget at the offset; empty for everything else.
std::string reachOf(const State& state, const Target& target) {
    const query::Meaning meaning = query::meaningAt(*target.snapshot, *target.view, target.offset);
    const rapid::sema::DataSymbol* data = query::dataOf(meaning.symbol);
    if (!data || data->type.rank != 0 || !data->type.type || data->type.type->name != "robtarget") return {};
    const std::span<rapid::sema::ConstValue> parts = data->value().members();
    if (parts.size() < 4) return {};
    const auto number = [&](size_t part, size_t i) {
        const auto members = parts[part].members();
        return i < members.size() ? members[i].number : 0.0;
    };
    rapid::workspace::TargetNumbers numbers;
    for (size_t i = 0; i < 3; ++i)
        numbers.position[i] = number(0, i);
    for (size_t i = 0; i < 4; ++i) {
        constexpr double kMostQuarters = 1000;
        numbers.rotation[i] = number(1, i);
        numbers.configuration[i] = static_cast<int>(std::clamp(number(2, i), -kMostQuarters, kMostQuarters));
    }
    numbers.eaxA = number(3, 0);
    const std::string robot = robotOf(*target.program);
    return robot.empty() ? "" : state.environment.reach(robot, numbers);
}

} // namespace

Json hover(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return configurationHover(state, target);
    auto found = query::hoverAt(*target.snapshot, *target.view, target.offset);
    if (!found) return nullptr;
    if (const std::string reach = reachOf(state, target); !reach.empty())
        found->facts += (found->facts.empty() ? "" : "\n\n") + reach;
    return toJson(state, target, *found);
}

Json signatureHelp(State& state, const Json& params) {
    const Target target = state.targetWhileTyping(params);
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
