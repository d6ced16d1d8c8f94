#include "frontend/query/hover.h"

#include "frontend/query/config_text.h"
#include "frontend/query/keywords.h"

#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

std::string Hover::markdown() const {
    std::string text = "```rapid\n" + declaration + "\n```";
    const auto add = [&](const std::string& part) {
        if (!part.empty()) text += "\n\n" + part;
    };
    if (!value.empty()) add("Value: `" + value + "`");
    add(facts);
    add(table);
    add(documentation);
    return text;
}

namespace {

const ConstValue* member(const ConstValue& value, const Type& type, std::string_view name,
                         const Type** inner) {
    const int index = type.findComponent(name);
    const auto members = value.members();
    if (index < 0 || static_cast<size_t>(index) >= members.size()) return nullptr;
    if (inner) *inner = type.base()->components[static_cast<size_t>(index)].type;
    return &members[static_cast<size_t>(index)];
}

/// The numbers of a part in one row: `| x | y | z |` above `| 1 | 2 | 3 |`.
std::string rowOf(std::string_view title, const ConstValue& value, const Type& type) {
    std::string head = fmt::format("| {} |", title), rule = "|---|", row = "| |";
    const auto& components = type.base()->components;
    const auto members = value.members();
    for (size_t i = 0; i < components.size() && i < members.size(); ++i) {
        const bool unused = members[i].kind == ConstValue::Kind::Number && members[i].number == 9e9;
        head += " " + components[i].name + " |";
        rule += "---:|";
        row += " " +
               (unused || (members[i].kind == ConstValue::Kind::Number && members[i].number >= 8.9e9)
                    ? "-"
                    : valueText(members[i], {components[i].type, 0, {}})) +
               " |";
    }
    return head + "\n" + rule + "\n" + row + "\n";
}

struct Part {
    std::string_view component;
    std::string_view title;
};

} // namespace

std::string targetTable(const ConstValue& value, const Type& type) {
    static constexpr Part kParts[] = {
        {"trans", "position (mm)"},    {"rot", "orientation"},       {"robconf", "configuration"},
        {"robax", "robot axes (deg)"}, {"extax", "additional axes"}, {"uframe", "user frame"},
        {"oframe", "object frame"},    {"tframe", "tool frame"},     {"tload", "load"}};
    if (type.base()->kind != TypeKind::Record || value.kind != ConstValue::Kind::Aggregate) return {};
    std::string text;
    for (const Part& part : kParts) {
        const Type* inner = nullptr;
        const ConstValue* found = member(value, type, part.component, &inner);
        if (!found || found->kind != ConstValue::Kind::Aggregate || !inner) continue;
        const bool nested = inner->findComponent("trans") >= 0; // frames have two parts
        if (!text.empty()) text += "\n";
        if (!nested) {
            text += rowOf(part.title, *found, *inner);
            continue;
        }
        for (const char* half : {"trans", "rot"}) {
            const Type* halfType = nullptr;
            if (const ConstValue* of = member(*found, *inner, half, &halfType); of && halfType)
                text += (std::string_view(half) == "rot" ? "\n" : "") +
                        rowOf(fmt::format("{}, {}", part.title,
                                          std::string_view(half) == "rot" ? "orientation" : "position (mm)"),
                              *of, *halfType);
        }
    }
    return text;
}

namespace {

/// The value that a declaration writes: constants, and what persistents and variables begin with.
const ConstValue* writtenValue(const DataSymbol& data) {
    if (data.storage != Storage::ModuleData || data.type.isArray()) return nullptr;
    if (data.valueProgress != Progress::Done && !data.isLiteralConstant()) return nullptr;
    const ConstValue& value = data.value();
    return value.kind == ConstValue::Kind::None ? nullptr : &value;
}

std::string signalFacts(const Snapshot& snapshot, const DataSymbol& data) {
    const SignalDefinition found = findSignal(snapshot.configuration(), data.name);
    if (!found.file)
        return data.assumed ? "Known by its use only: no configuration defines it." : std::string();
    std::string text = fmt::format("`{}` in {}:", found.instance.text("SignalType"), found.file->path());
    for (const ConfigAttribute& attribute : found.instance.attributes)
        if (attribute.name != "Name" && attribute.name != "SignalType")
            text += fmt::format(" {} {};", attribute.name, attribute.value.empty() ? "yes" : attribute.value);
    if (text.back() == ';' || text.back() == ':') text.pop_back();
    return text;
}

void describeData(const Snapshot& snapshot, const DataSymbol& data, Hover& hover) {
    if (data.storage == Storage::Signal) {
        hover.facts = signalFacts(snapshot, data);
        return;
    }
    if (const ConstValue* value = constantOf(data)) {
        hover.value = valueText(*value, data.type);
        if (data.type.type && data.type.type->name == "errnum")
            hover.facts = "Number of the error: " + hover.value;
    }
    if (const ConstValue* value = writtenValue(data); value && data.type.type) {
        hover.table = targetTable(*value, *data.type.type);
        if (hover.value.empty()) hover.facts = "Initial value: `" + valueText(*value, data.type) + "`";
    }
}

} // namespace

std::optional<Hover> hoverAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    if (isInComment(file, offset)) return std::nullopt;
    const Meaning meaning = meaningAt(snapshot, file, offset);
    Hover hover;
    if (!meaning.found()) {
        const TokenIndex word = wordAt(file, offset);
        if (word == kNoToken) return std::nullopt;
        const std::string_view help = keywordHelp(file.tree->tokens[word].kind);
        if (help.empty()) return std::nullopt;
        hover.range = file.tree->range(word);
        hover.declaration = std::string(tokenTextOf(file.tree->tokens[word].kind));
        hover.documentation = std::string(help);
        return hover;
    }
    hover.range = meaning.range();
    hover.declaration = declarationText(snapshot, meaning);
    hover.documentation = documentationOf(snapshot, meaning);
    if (const DataSymbol* data = dataOf(meaning.symbol)) describeData(snapshot, *data, hover);
    return hover;
}

} // namespace rapid::query
