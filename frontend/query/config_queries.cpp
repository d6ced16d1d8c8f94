#include "frontend/query/config_queries.h"

#include "frontend/query/fuzzy.h"
#include "frontend/sema/names.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace rapid::query {

using sema::foldName;

namespace {

struct KnownAttribute {
    std::string_view type, name, values, help;
};
constexpr KnownAttribute kAttributes[] = {
#define ATTRIBUTE(type, name, values, help) {type, name, values, help},
#include "frontend/query/config_attributes.def"
};

const KnownAttribute* knownAttribute(std::string_view type, std::string_view name) {
    const std::string folded = foldName(name);
    for (const KnownAttribute& known : kAttributes)
        if (known.type == type && foldName(known.name) == folded) return &known;
    return nullptr;
}

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const size_t end = text.find('|');
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + 1);
    }
    return parts;
}

/// Devices have a type for each kind of network.
bool isOfType(std::string_view type, std::string_view wanted) {
    return type == wanted || (wanted == "EIO_DEVICE" && (type.ends_with("_DEVICE") || type == "EIO_UNIT"));
}

/// The parts of the text around an offset.
struct Place {
    const ConfigSection* section = nullptr;
    const ConfigInstance* instance = nullptr;
    const ConfigAttribute* attribute = nullptr;
    bool onName = false, onValue = false;
};

Place placeAt(const ConfigText& text, uint32_t offset) {
    Place place;
    for (const ConfigSection& section : text.sections) {
        if (offset < section.range.begin) break;
        place.section = offset <= std::max(section.end, section.range.end) ? &section : nullptr;
    }
    if (!place.section) return place;
    for (const ConfigInstance& instance : place.section->instances) {
        if (instance.range.begin > offset || instance.range.end < offset) continue;
        place.instance = &instance;
        for (const ConfigAttribute& attribute : instance.attributes) {
            const auto in = [&](SourceRange range) { return range.begin <= offset && offset <= range.end; };
            if (in(attribute.nameRange)) place.attribute = &attribute, place.onName = true;
            const bool value = attribute.valueRange.begin > attribute.nameRange.end;
            if (value && in(attribute.valueRange))
                place.attribute = &attribute, place.onValue = true, place.onName = false;
        }
    }
    return place;
}

/// Calls `visit` for the name of each instance of a type in all configuration files, and in the one that is edited.
void forEachInstance(
    const Snapshot& snapshot, const SourceFile& own, std::string_view type,
    const std::function<void(const SourceFile&, const ConfigInstance&, const ConfigAttribute&)>& visit) {
    const auto look = [&](const SourceFile& file) {
        for (const ConfigSection& section : readConfigText(file.text()).sections)
            if (isOfType(section.type, type))
                for (const ConfigInstance& instance : section.instances)
                    if (const ConfigAttribute* name = instance.find("Name"); name && !name->value.empty())
                        visit(file, instance, *name);
    };
    look(own);
    for (const auto& file : snapshot.configuration())
        if (file && file->path() != own.path()) look(*file);
}

class ConfigCompleter {
  public:
    ConfigCompleter(const Snapshot& snapshot, const SourceFile& file, uint32_t offset)
        : snapshot_(snapshot), file_(file), text_(file.text()),
          offset_(std::min(offset, static_cast<uint32_t>(text_.size()))) {}

    CompletionList run() {
        const ConfigText text = readConfigText(text_);
        const uint32_t line = lineStart();
        const std::string_view before = text_.substr(line, offset_ - line);
        uint32_t word = offset_;
        while (word > line && isWordChar(text_[word - 1]))
            --word;
        list_.replace = {word, offset_};
        prefix_ = text_.substr(word, offset_ - word);
        const Place place = placeAt(text, offset_);
        const bool quoted = std::count(before.begin(), before.end(), '"') % 2 != 0;
        if (!quoted && word > line && text_[word - 1] == '-')
            attributes(place);
        else if (before.find_first_not_of(" \t") == std::string_view::npos || word == line)
            types(before);
        else
            values(place, before, quoted);
        return std::move(list_);
    }

  private:
    static bool isWordChar(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               static_cast<unsigned char>(c) >= 0x80;
    }
    uint32_t lineStart() const {
        const size_t at = offset_ == 0 ? std::string_view::npos : text_.find_last_of("\r\n", offset_ - 1);
        return at == std::string_view::npos ? 0 : static_cast<uint32_t>(at + 1);
    }
    CompletionItem* add(std::string label, ItemKind kind, std::string insert, std::string_view detail) {
        if (!fuzzyMatch(prefix_, label)) return nullptr;
        CompletionItem& item = list_.items.emplace_back();
        item.label = std::move(label);
        item.kind = kind;
        item.insertText = std::move(insert);
        item.detail = std::string(detail);
        item.sortText = fmt::format("{:04}", list_.items.size());
        item.filterText = item.label;
        return &item;
    }

    void attributes(const Place& place) {
        if (!place.section) return;
        for (const KnownAttribute& known : kAttributes) {
            if (known.type != place.section->type) continue;
            const ConfigAttribute* given = place.instance ? place.instance->find(known.name) : nullptr;
            if (given && !(given->nameRange.begin <= offset_ && offset_ <= given->nameRange.end)) continue;
            const bool flag = known.values == "?", number = known.values == "#";
            const std::string name(known.name);
            CompletionItem* item = add(name, ItemKind::Component,
                                       flag     ? name
                                       : number ? name + " "
                                                : name + " \"\"",
                                       known.help);
            if (item && !flag) item->snippet = name + (number ? " ${1:0}" : " \"${1}\"") + "$0";
        }
    }

    void types(std::string_view before) {
        std::set<std::string_view> seen;
        for (const KnownAttribute& known : kAttributes)
            if (seen.insert(known.type).second && isOfDomain(known.type))
                add(std::string(known.type), ItemKind::Type, std::string(known.type) + ":",
                    "type of configuration");
        // An instance of the section that is open begins with its name.
        if (!before.empty() && prefix_.empty())
            if (CompletionItem* item = add("-Name", ItemKind::Snippet, "-Name \"\"", "new instance"))
                item->snippet = "-Name \"${1:name}\"$0";
    }
    /// "EIO:CFG_1.0:7:0::" takes the types of signals.
    bool isOfDomain(std::string_view type) const {
        const std::string domain = readConfigText(text_).domain;
        const bool io = type.starts_with("EIO") || type.starts_with("SYSSIG") || type.ends_with("_DEVICE");
        if (domain == "EIO") return io;
        if (domain == "SIO") return type.starts_with("COM_");
        return domain.empty() || (!io && !type.starts_with("COM_"));
    }

    void values(const Place& place, std::string_view before, bool quoted) {
        if (!place.section) return;
        // The last attribute before the offset.
        const size_t dash =
            before.rfind(" -") == std::string_view::npos ? before.find('-') : before.rfind(" -") + 1;
        if (dash == std::string_view::npos) return;
        const std::string_view rest = before.substr(dash + 1);
        const KnownAttribute* known =
            knownAttribute(place.section->type, rest.substr(0, rest.find_first_of(" \t\"")));
        if (!known) return;
        const auto quote = [&](std::string_view value) {
            return quoted ? std::string(value) : '"' + std::string(value) + '"';
        };
        for (const std::string_view value : split(known->values)) {
            if (value.starts_with('@'))
                forEachInstance(
                    snapshot_, file_, value.substr(1),
                    [&](const SourceFile&, const ConfigInstance& instance, const ConfigAttribute& name) {
                        add(name.value, ItemKind::Signal, quote(name.value), instance.text("SignalType"));
                    });
            else if (value.size() > 1)
                add(std::string(value), ItemKind::Value, quote(value), known->name);
        }
        if (known->name == "Entry" || known->name == "Routine") routines(quote);
    }
    void routines(const std::function<std::string(std::string_view)>& quote) {
        std::set<std::string> seen;
        for (const auto& task : snapshot_.program().tasks)
            for (const sema::Module* module : task->modules)
                for (const sema::RoutineSymbol* routine : module->routines)
                    if (routine->routineKind == syntax::RoutineKind::Proc && routine->params.empty() &&
                        seen.insert(foldName(routine->name)).second)
                        add(routine->name, ItemKind::Procedure, quote(routine->name), module->name);
    }

    const Snapshot& snapshot_;
    const SourceFile& file_;
    std::string_view text_;
    uint32_t offset_;
    std::string_view prefix_;
    CompletionList list_;
};

bool namesSignal(const ConfigSection& section, const ConfigAttribute& attribute) {
    if (section.type == "EIO_SIGNAL") return foldName(attribute.name) == "name";
    const KnownAttribute* known = knownAttribute(section.type, attribute.name);
    return known && known->values == "@EIO_SIGNAL";
}

Location placeOf(const std::shared_ptr<const SourceFile>& file, SourceRange range, SourceRange whole) {
    return {file, range, whole, false};
}

std::vector<std::shared_ptr<const SourceFile>> allFiles(const Snapshot& snapshot,
                                                        const std::shared_ptr<const SourceFile>& own) {
    std::vector<std::shared_ptr<const SourceFile>> files;
    if (own) files.push_back(own);
    for (const auto& file : snapshot.configuration())
        if (file && (!own || file->path() != own->path())) files.push_back(file);
    return files;
}

const sema::DataSymbol* configuredSignal(const Snapshot& snapshot, std::string_view name) {
    const auto found = snapshot.configured().find(foldName(name));
    return found == snapshot.configured().end() ? nullptr : found->second;
}

} // namespace

CompletionList configCompletionAt(const Snapshot& snapshot, const SourceFile& file, uint32_t offset) {
    return ConfigCompleter(snapshot, file, offset).run();
}

std::optional<Hover> configHoverAt(const Snapshot& snapshot, const SourceFile& file, uint32_t offset) {
    const ConfigText text = readConfigText(file.text());
    const Place place = placeAt(text, offset);
    if (!place.section) return std::nullopt;
    Hover hover;
    if (place.attribute && place.onName) {
        const KnownAttribute* known = knownAttribute(place.section->type, place.attribute->name);
        if (!known) return std::nullopt;
        hover.range = place.attribute->nameRange;
        hover.declaration = fmt::format("{} -{}", place.section->type, known->name);
        hover.documentation = std::string(known->help);
        if (known->values.size() > 1 && known->values.front() != '@')
            hover.facts = "One of: " + std::string(known->values);
        return hover;
    }
    if (place.attribute && place.onValue && namesSignal(*place.section, *place.attribute)) {
        hover.range = place.attribute->valueRange;
        const SignalDefinition signal = findSignal(snapshot.configuration(), place.attribute->value);
        const sema::DataSymbol* data = configuredSignal(snapshot, place.attribute->value);
        if (!signal.file && !data) return std::nullopt;
        hover.declaration = data && data->type.type
                                ? data->type.type->name + " " + data->name
                                : signal.instance.text("SignalType") + " " + place.attribute->value;
        hover.documentation = signal.file ? signal.instance.text("Label") : "";
        return hover;
    }
    const bool onType = place.section->range.begin <= offset && offset <= place.section->range.end;
    if (!onType) return std::nullopt;
    hover.range = place.section->range;
    hover.declaration = place.section->type + ":";
    for (const KnownAttribute& known : kAttributes)
        if (known.type == place.section->type)
            hover.documentation += fmt::format("- `{}`: {}\n", known.name, known.help);
    return hover;
}

std::vector<Location> configDefinitionAt(const Snapshot& snapshot,
                                         const std::shared_ptr<const SourceFile>& file, uint32_t offset) {
    std::vector<Location> places;
    if (!file) return places;
    const ConfigText text = readConfigText(file->text());
    const Place place = placeAt(text, offset);
    if (!place.attribute || !place.onValue) return places;
    const std::string wanted = foldName(place.attribute->value);
    const KnownAttribute* known = knownAttribute(place.section->type, place.attribute->name);
    if (!known) return places;
    std::string type;
    for (const std::string_view value : split(known->values))
        if (value.starts_with('@')) type = value.substr(1);
    if (known->name == "Name") type = place.section->type;
    for (const auto& other : allFiles(snapshot, file))
        for (const ConfigSection& section : readConfigText(other->text()).sections) {
            if (type.empty() || !isOfType(section.type, type)) continue;
            for (const ConfigInstance& instance : section.instances)
                if (const ConfigAttribute* name = instance.find("Name");
                    name && foldName(name->value) == wanted)
                    places.push_back(placeOf(other, name->valueRange, instance.range));
        }
    if (known->name == "Entry" || known->name == "Routine")
        for (const auto& task : snapshot.program().tasks) {
            const NameTable& globals = snapshot.globals(*task);
            const auto found = globals.find(wanted);
            if (found == globals.end() || found->second->kind != sema::SymbolKind::Routine) continue;
            Location routine = locationOf(snapshot, *found->second);
            if (routine.file && std::find(places.begin(), places.end(), routine) == places.end())
                places.push_back(std::move(routine));
        }
    return places;
}

std::vector<Location> signalInConfiguration(const Snapshot& snapshot, std::string_view name) {
    std::vector<Location> places;
    const std::string wanted = foldName(name);
    for (const auto& file : snapshot.configuration()) {
        if (!file) continue;
        for (const ConfigSection& section : readConfigText(file->text()).sections)
            for (const ConfigInstance& instance : section.instances)
                for (const ConfigAttribute& attribute : instance.attributes)
                    if (foldName(attribute.value) == wanted && namesSignal(section, attribute))
                        places.push_back(placeOf(file, attribute.valueRange, instance.range));
    }
    return places;
}

std::vector<Location> signalInConfiguration(const Snapshot& snapshot, const Meaning& meaning,
                                            bool withDeclaration) {
    const sema::DataSymbol* data = dataOf(meaning.symbol);
    if (!data || data->storage != sema::Storage::Signal) return {};
    std::vector<Location> places = signalInConfiguration(snapshot, data->name);
    if (withDeclaration) return places;
    const SignalDefinition signal = findSignal(snapshot.configuration(), data->name);
    std::erase_if(places, [&](const Location& place) {
        return place.file == signal.file && place.range.begin == signal.name.begin;
    });
    return places;
}

std::vector<Use> configUsesAt(const Snapshot& snapshot, const std::shared_ptr<const SourceFile>& file,
                              uint32_t offset, const Cancel* cancel) {
    std::vector<Use> uses;
    if (!file) return uses;
    const ConfigText text = readConfigText(file->text());
    const Place place = placeAt(text, offset);
    if (!place.attribute || !place.onValue || !namesSignal(*place.section, *place.attribute)) return uses;
    for (Location& where : signalInConfiguration(snapshot, place.attribute->value))
        uses.push_back({std::move(where), Access::Declaration});
    if (const sema::DataSymbol* data = configuredSignal(snapshot, place.attribute->value)) {
        Meaning meaning;
        meaning.symbol = data;
        for (Use& use : usesOf(snapshot, meaning, true, cancel))
            uses.push_back(std::move(use));
    }
    return uses;
}

std::vector<OutlineSymbol> configOutline(std::string_view text) {
    std::vector<OutlineSymbol> all;
    for (const ConfigSection& section : readConfigText(text).sections) {
        OutlineSymbol symbol;
        symbol.name = section.type;
        symbol.selection = section.range;
        symbol.range = {section.range.begin, std::max(section.end, section.range.end)};
        for (const ConfigInstance& instance : section.instances) {
            const ConfigAttribute* name = instance.find("Name");
            if (!name && !instance.attributes.empty()) name = &instance.attributes.front();
            if (!name || name->value.empty()) continue;
            OutlineSymbol child;
            child.name = name->value;
            child.detail =
                instance.text("SignalType").empty() ? instance.text("Type") : instance.text("SignalType");
            child.kind = OutlineKind::Constant;
            child.selection = name->valueRange;
            child.range = instance.range;
            symbol.children.push_back(std::move(child));
            symbol.range.end = std::max(symbol.range.end, instance.range.end);
        }
        all.push_back(std::move(symbol));
    }
    return all;
}

} // namespace rapid::query
