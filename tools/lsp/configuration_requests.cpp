// Completion, hover, definition and references in configuration files (.cfg), and the way from them to RAPID.

#include "config/json_text.h"
#include "config/text_util.h"
#include "frontend/project/files.h"
#include "frontend/query/config_text.h"
#include "frontend/query/references.h"
#include "tools/lsp/configuration_words.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace lsp {

namespace query = rapid::query;
using rapid::SourceRange;
using rapid::config::sameName;

namespace {

bool isConfiguration(const Target& target) {
    return rapid::project::extensionOf(target.path) == ".cfg";
}

/// Where an offset is in a configuration.
struct Spot {
    query::ConfigText text;
    const query::ConfigSection* section = nullptr;
    const query::ConfigInstance* instance = nullptr;
    const query::ConfigAttribute* attribute = nullptr;
    bool inValue = false;
};

bool touches(SourceRange range, uint32_t offset) {
    return range.begin <= offset && offset <= range.end;
}

void find(Spot& spot, uint32_t offset) {
    for (const query::ConfigSection& section : spot.text.sections) {
        if (offset < section.range.begin || offset > section.end) continue;
        spot.section = &section;
        for (const query::ConfigInstance& instance : section.instances) {
            if (!touches(instance.range, offset)) continue;
            spot.instance = &instance;
            for (const query::ConfigAttribute& attribute : instance.attributes) {
                const bool name = touches(attribute.nameRange, offset);
                const bool value = attribute.valueRange.end > 0 && touches(attribute.valueRange, offset);
                if (!name && !value) continue;
                spot.attribute = &attribute;
                spot.inValue = value;
            }
        }
    }
}

/// An instance with the value as its name, in the files of the program or in this one.
Json instanceNamed(State& state, const Target& target, std::string_view type, std::string_view name) {
    Json out = Json::array();
    const auto look = [&](const std::shared_ptr<const rapid::SourceFile>& file) {
        for (const query::ConfigSection& section : query::readConfigText(file->text()).sections) {
            if (!sameName(section.type, type)) continue;
            for (const query::ConfigInstance& instance : section.instances) {
                const query::ConfigAttribute* own = instance.find("Name");
                if (own && sameName(own->value, name)) out.push_back(state.location(file, own->valueRange));
            }
        }
    };
    look(target.positions->source());
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    if (!owner || !out.empty()) return out;
    for (const auto& file : state.snapshot(*owner).configuration())
        if (file->path() != target.path) look(file);
    return out;
}

/// The routines of this name in the program of the configuration.
Json routinesNamed(State& state, const Target& target, std::string_view name) {
    Json out = Json::array();
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    if (!owner) return out;
    const query::Snapshot& snapshot = state.snapshot(*owner);
    for (const auto& task : owner->checked().tasks)
        for (const rapid::sema::Module* module : task->modules)
            for (const rapid::sema::RoutineSymbol* routine : module->routines)
                if (sameName(routine->name, name)) {
                    Json place = state.location(query::locationOf(snapshot, *routine));
                    if (!place.is_null()) out.push_back(std::move(place));
                }
    return out;
}

/// Uses of a signal in the modules.
Json usesOfSignal(State& state, const Target& target, std::string_view name) {
    Json out = Json::array();
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    if (!owner) return out;
    const query::Snapshot& snapshot = state.snapshot(*owner);
    std::string folded(name);
    std::transform(folded.begin(), folded.end(), folded.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const auto found = snapshot.configured().find(folded);
    if (found == snapshot.configured().end()) return out;
    query::Meaning meaning;
    meaning.symbol = found->second;
    for (const query::Use& use : query::usesOf(snapshot, meaning, false))
        if (Json place = state.location(use.place); !place.is_null()) out.push_back(std::move(place));
    return out;
}

bool isSignalName(const Spot& spot) {
    return spot.attribute && spot.inValue && sameName(spot.section->type, "EIO_SIGNAL") &&
           sameName(spot.attribute->name, "Name");
}

Json item(const Json& range, std::string_view label, std::string_view detail, int kind) {
    return {{"label", label},
            {"kind", kind},
            {"detail", detail},
            {"textEdit", {{"range", range}, {"newText", label}}}};
}

/// The word before the offset: letters, digits, '_', and the characters of `more`.
SourceRange wordBefore(std::string_view text, uint32_t offset, std::string_view more) {
    uint32_t begin = offset;
    while (begin > 0 && (std::isalnum(static_cast<unsigned char>(text[begin - 1])) != 0 ||
                         text[begin - 1] == '_' || more.find(text[begin - 1]) != std::string_view::npos))
        --begin;
    return {begin, offset};
}

/// Values: those of the attribute, and the names of what it refers to.
void completeValue(State& state, const Target& target, const AttributeWord& word, Json& items) {
    constexpr int kEnumMember = 20, kReference = 18;
    const Json range =
        toJson(target.positions->range(wordBefore(target.positions->file().text(), target.offset, "/.")));
    for (std::string_view rest = word.values; !rest.empty();) {
        const size_t blank = std::min(rest.find(' '), rest.size());
        items.push_back(item(range, rest.substr(0, blank), word.name, kEnumMember));
        rest.remove_prefix(std::min(rest.size(), blank + 1));
    }
    if (word.refersTo.empty()) return;
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    std::vector<std::shared_ptr<const rapid::SourceFile>> files{target.positions->source()};
    if (owner)
        for (const auto& file : state.snapshot(*owner).configuration())
            if (file->path() != target.path) files.push_back(file);
    for (const auto& file : files)
        for (const query::ConfigSection& section : query::readConfigText(file->text()).sections)
            if (sameName(section.type, word.refersTo))
                for (const query::ConfigInstance& instance : section.instances)
                    if (const std::string name = instance.text("Name"); !name.empty())
                        items.push_back(item(range, name, section.type, kReference));
    if (word.refersTo != "routine" || !owner) return;
    for (const auto& task : owner->checked().tasks)
        for (const rapid::sema::Module* module : task->modules)
            for (const rapid::sema::RoutineSymbol* routine : module->routines)
                if (routine->params.empty())
                    items.push_back(item(range, routine->name, module->name, kReference));
}

void completeAttribute(const Target& target, const Spot& spot, Json& items) {
    constexpr int kProperty = 10;
    const TypeWord* type = findType(spot.section->type);
    if (!type) return;
    const Json range =
        toJson(target.positions->range(wordBefore(target.positions->file().text(), target.offset, "-")));
    for (const AttributeWord& word : type->attributes) {
        const bool given = spot.instance && spot.instance->find(word.name) &&
                           (!spot.attribute || !sameName(spot.attribute->name, word.name));
        if (!given) items.push_back(item(range, fmt::format("-{}", word.name), word.help, kProperty));
    }
}

void completeType(const Target& target, const Spot& spot, Json& items) {
    constexpr int kStruct = 22;
    const Json range =
        toJson(target.positions->range(wordBefore(target.positions->file().text(), target.offset, "")));
    for (const TypeWord& type : configurationTypes())
        if (spot.text.domain.empty() || sameName(type.domain, spot.text.domain))
            items.push_back(item(range, fmt::format("{}:", type.name), type.help, kStruct));
}

/// The attribute whose value is being written, when the reader did not see one: "-SignalType D", "-Access ".
const AttributeWord* attributeBefore(const TypeWord& type, std::string_view text, uint32_t offset) {
    SourceRange word = wordBefore(text, offset, "/.\"");
    uint32_t end = word.begin;
    while (end > 0 && text[end - 1] == ' ')
        --end;
    if (end == word.begin) return nullptr;
    const SourceRange name = wordBefore(text, end, "");
    if (name.begin == 0 || text[name.begin - 1] != '-') return nullptr;
    return findAttribute(type, text.substr(name.begin, name.end - name.begin));
}

} // namespace

Json configurationCompletion(State& state, const Target& target) {
    Json items = Json::array();
    if (isConfiguration(target)) {
        Spot spot{query::readConfigText(target.positions->file().text())};
        find(spot, target.offset);
        const std::string_view text = target.positions->file().text();
        const uint32_t line =
            target.offset - static_cast<uint32_t>(target.positions->at(target.offset).character);
        const bool indented = line < text.size() && text[std::min<size_t>(line, text.size() - 1)] == ' ';
        const TypeWord* type = spot.section ? findType(spot.section->type) : nullptr;
        const AttributeWord* word = type ? attributeBefore(*type, text, target.offset) : nullptr;
        if (word)
            completeValue(state, target, *word, items);
        else if (spot.section && (indented || spot.instance))
            completeAttribute(target, spot, items);
        else
            completeType(target, spot, items);
    }
    return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json configurationHover(State& state, const Target& target) {
    if (!isConfiguration(target)) return nullptr;
    Spot spot{query::readConfigText(target.positions->file().text())};
    find(spot, target.offset);
    if (!spot.section) return nullptr;
    const TypeWord* type = findType(spot.section->type);
    std::string text;
    SourceRange range = spot.section->range;
    if (spot.attribute) {
        range = spot.inValue ? spot.attribute->valueRange : spot.attribute->nameRange;
        const AttributeWord* word = type ? findAttribute(*type, spot.attribute->name) : nullptr;
        text = fmt::format("-{}", word ? word->name : spot.attribute->name);
        if (word) text += fmt::format(": {}", word->help);
        if (word && !word->values.empty()) text += fmt::format("\n\nValues: {}", word->values);
        if (isSignalName(spot)) {
            const size_t uses = usesOfSignal(state, target, spot.attribute->value).size();
            text = fmt::format("{} {}, used at {} place{} in RAPID", spot.instance->text("SignalType"),
                               spot.attribute->value, uses, uses == 1 ? "" : "s");
        }
    } else if (touches(spot.section->range, target.offset)) {
        text = spot.section->type;
        if (type) text += fmt::format(": {}", type->help);
    }
    if (text.empty()) return nullptr;
    return {{"contents", {{"kind", "plaintext"}, {"value", text}}},
            {"range", toJson(target.positions->range(range))}};
}

Json configurationDefinition(State& state, const Target& target) {
    if (!isConfiguration(target)) return Json::array();
    Spot spot{query::readConfigText(target.positions->file().text())};
    find(spot, target.offset);
    if (!spot.attribute || !spot.inValue) return Json::array();
    const TypeWord* type = findType(spot.section->type);
    const AttributeWord* word = type ? findAttribute(*type, spot.attribute->name) : nullptr;
    if (!word) return Json::array();
    if (word->refersTo == "routine") return routinesNamed(state, target, spot.attribute->value);
    const std::string_view named = word->refersTo.empty() && sameName(word->name, "Name")
                                       ? std::string_view(spot.section->type)
                                       : word->refersTo;
    return named.empty() ? Json::array() : instanceNamed(state, target, named, spot.attribute->value);
}

Json configurationReferences(State& state, const Target& target, bool withDeclaration) {
    if (!isConfiguration(target)) return Json::array();
    Spot spot{query::readConfigText(target.positions->file().text())};
    find(spot, target.offset);
    if (!spot.attribute || !spot.inValue) return Json::array();
    Json out = usesOfSignal(state, target, spot.attribute->value);
    if (withDeclaration)
        for (const Json& place : instanceNamed(state, target, "EIO_SIGNAL", spot.attribute->value))
            out.push_back(place);
    return out;
}

} // namespace lsp
