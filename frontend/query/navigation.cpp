#include "frontend/query/navigation.h"

#include "frontend/query/config_text.h"
#include "frontend/query/late_calls.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

void addOnce(std::vector<Location>& places, Location place) {
    if (place.file && std::find(places.begin(), places.end(), place) == places.end())
        places.push_back(std::move(place));
}

std::vector<Location> lateTargets(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    std::vector<Location> places;
    if (const auto late = lateCallAt(file, offset))
        for (const RoutineSymbol* routine : targetsOf(snapshot, file, *late))
            addOnce(places, locationOf(snapshot, *routine));
    return places;
}

/// A persistent that several tasks declare.
void addShared(const Snapshot& snapshot, const Entity& entity, std::vector<Location>& places) {
    for (const auto& task : snapshot.program().tasks) {
        const NameTable& globals = snapshot.globals(*task);
        const auto found = globals.find(entity.name);
        if (found == globals.end()) continue;
        Meaning meaning;
        meaning.symbol = found->second;
        if (entityOf(snapshot, meaning) == entity) addOnce(places, locationOf(snapshot, *found->second));
    }
}

} // namespace

std::vector<Location> definitionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    std::vector<Location> places;
    if (isInComment(file, offset)) return places;
    const Meaning meaning = meaningAt(snapshot, file, offset);
    if (!meaning.found()) return lateTargets(snapshot, file, offset);
    addOnce(places, declarationOf(snapshot, meaning));
    if (const DataSymbol* data = dataOf(meaning.symbol)) {
        if (data->storage == Storage::Signal) {
            const SignalDefinition signal = findSignal(snapshot.configuration(), data->name);
            if (signal.file) addOnce(places, {signal.file, signal.name, signal.instance.range, false});
        }
        const Entity entity = entityOf(snapshot, meaning);
        if (entity.place == "<persistent>") addShared(snapshot, entity, places);
    }
    return places;
}

std::vector<Location> typeDefinitionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    std::vector<Location> places;
    const Meaning meaning = meaningAt(snapshot, file, offset);
    const Type* type = nullptr;
    if (const DataSymbol* data = dataOf(meaning.symbol)) type = data->type.type;
    if (const RoutineSymbol* routine = routineOf(meaning.symbol)) type = routine->returnType.type;
    if (const TypeSymbol* symbol = typeSymbolOf(meaning.symbol); symbol && symbol->type)
        type = symbol->type->aliasOf ? symbol->type->aliasOf : symbol->type;
    if (meaning.record) type = meaning.record->components[static_cast<size_t>(meaning.component)].type;
    if (const TypeSymbol* symbol = type ? snapshot.symbolOf(*type) : nullptr)
        addOnce(places, locationOf(snapshot, *symbol));
    return places;
}

std::vector<Location> implementationAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    std::vector<Location> places = lateTargets(snapshot, file, offset);
    if (!places.empty()) return places;
    const Meaning meaning = meaningAt(snapshot, file, offset);
    if (routineOf(meaning.symbol)) addOnce(places, locationOf(snapshot, *meaning.symbol));
    return places;
}

std::vector<Use> highlightsAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                              const Cancel* cancel) {
    if (isInComment(file, offset)) return {};
    const Meaning meaning = meaningAt(snapshot, file, offset);
    return meaning.found() ? usesIn(snapshot, file, meaning, cancel) : std::vector<Use>();
}

} // namespace rapid::query
