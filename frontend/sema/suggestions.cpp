// The probable meaning of a misspelt name.

#include "frontend/sema/suggestions.h"

#include "frontend/sema/place.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"

namespace rapid::sema {

using namespace syntax;

namespace {

struct Word {
    std::string_view folded;
    std::string_view spelling;
};
constexpr Word kInstructionWords[] = {{"goto", "GOTO"},   {"return", "RETURN"},     {"raise", "RAISE"},
                                      {"retry", "RETRY"}, {"trynext", "TRYNEXT"},   {"exit", "EXIT"},
                                      {"break", "BREAK"}, {"continue", "CONTINUE"}, {"connect", "CONNECT"},
                                      {"endif", "ENDIF"}, {"endwhile", "ENDWHILE"}, {"endfor", "ENDFOR"}};
constexpr Word kValueWords[] = {{"true", "TRUE"}, {"false", "FALSE"}};

/// The predefined name for a word of other languages.
struct ForeignName {
    std::string_view folded, meant;
};
constexpr ForeignName kForeignNames[] = {
    {"int", "num"},           {"integer", "num"},       {"float", "num"},         {"real", "num"},
    {"double", "dnum"},       {"number", "num"},        {"boolean", "bool"},      {"char", "string"},
    {"str", "string"},        {"text", "string"},       {"wait", "WaitTime"},     {"sleep", "WaitTime"},
    {"delay", "WaitTime"},    {"pause", "WaitTime"},    {"print", "TPWrite"},     {"println", "TPWrite"},
    {"echo", "TPWrite"},      {"msgbox", "UIMsgBox"},   {"strtonum", "StrToVal"}, {"stringtonum", "StrToVal"},
    {"valtonum", "StrToVal"}, {"len", "StrLen"},        {"length", "StrLen"},     {"substr", "StrPart"},
    {"strsub", "StrPart"},    {"tostring", "ValToStr"}, {"sqr", "Sqrt"},          {"power", "Pow"},
    {"movep", "MoveJ"},       {"linear", "MoveL"},      {"on", "high"},           {"off", "low"}};

/// A name of one or two letters is near to everything of that length.
bool near(std::string_view written, unsigned distance) {
    return written.size() > 2 && distance < written.size();
}

/// The number of "v100" or "z50"; -1 of other names.
long numberInSeries(std::string_view folded) {
    constexpr size_t kLongest = 6;
    const bool member = folded.size() > 1 && folded.size() <= kLongest &&
                        (folded[0] == 'v' || folded[0] == 'z') &&
                        folded.find_first_not_of("0123456789", 1) == std::string_view::npos;
    return member ? std::stol(std::string(folded.substr(1))) : -1;
}

} // namespace

Suggestions::Suggestions(State& state, const Parts& parts) : CheckerPart(state), scopes_(parts.scopes) {}

// "v110" and "z25": of speeds and zones, the next ones that are predefined.
std::string Suggestions::inSeries(std::string_view written) {
    const long wanted = numberInSeries(written);
    if (wanted < 0 || task_.comparisonsLeft < state_.predefined.size()) return {};
    task_.comparisonsLeft -= state_.predefined.size();
    std::string_view below, above;
    for (const Symbol* symbol : state_.predefined) {
        const std::string_view other = symbol ? names_.folded(symbol->nameId) : std::string_view();
        const long number = other.starts_with(written[0]) ? numberInSeries(other) : -1;
        if (number < 0) continue;
        if (number < wanted && (below.empty() || number > numberInSeries(below))) below = other;
        if (number > wanted && (above.empty() || number < numberInSeries(above))) above = other;
    }
    if (below.empty() && above.empty()) return {};
    if (below.empty() || above.empty())
        return "; predefined is '" + std::string(below.empty() ? above : below) + "'";
    return "; predefined are '" + std::string(below) + "' and '" + std::string(above) + "'";
}

const NameLists& Suggestions::nameLists() {
    if (task_.nameLists) return *task_.nameLists;
    NameLists& lists = task_.nameLists.emplace();
    for (size_t id = 0; id < task_.globals.size(); ++id)
        if (task_.globals[id]) lists.global.push_back(static_cast<NameId>(id));
    for (size_t id = 0; id < task_.configured.size(); ++id)
        if (task_.configured[id]) lists.configured.push_back(static_cast<NameId>(id));
    if (task_.task)
        for (const Module* module : task_.task->modules)
            state_.scopes[module->id]->names.forEach(
                [&](NameId name, const Symbol*) { lists.ofModules.insert(name); });
    return lists;
}

const Symbol* Suggestions::meantByForeign(std::string_view written, Wanted wanted) {
    for (const ForeignName& foreign : kForeignNames) {
        if (foreign.folded != written) continue;
        const Symbol* meant = at(state_.predefined, names_.intern(foreign.meant));
        if (meant && isWanted(*meant, wanted) && scopes_.lookup(meant->nameId) == meant) return meant;
    }
    return nullptr;
}

/// Within the limit for a name of this length, in the order of their numbers.
const std::vector<NameId>& Suggestions::nearPredefined(NameId name) {
    const auto [found, isNew] = state_.nearPredefined.try_emplace(name);
    if (!isNew) return found->second;
    const std::string_view written = names_.folded(name);
    const WordShape shape = names_.shape(name);
    const unsigned limit = suggestionLimit(written.size());
    for (size_t i = 0; i < state_.predefined.size(); ++i) {
        const auto id = static_cast<NameId>(i);
        if (state_.predefined[id] && mayBeNear(shape, names_.shape(id), limit) &&
            editDistance(written, names_.folded(id), limit) <= limit)
            found->second.push_back(id);
    }
    return found->second;
}

Suggestion Suggestions::suggestion(NameId name, Wanted wanted) {
    facts().open = true;
    const NameMap<Symbol>& own = state_.scopes[context_.module->id]->names;
    const size_t names = task_.globals.size() + state_.predefined.size() + own.size();
    if (task_.comparisonsLeft < names) return {};
    task_.comparisonsLeft -= names;
    const std::string_view written = names_.folded(name);
    if (const Symbol* meant = meantByForeign(written, wanted)) return {meant->name, false};
    unsigned limit = suggestionLimit(written.size());
    // The nearest scope first: on equal distance it wins, and within a scope the first in the alphabet.
    Suggestion best;
    std::string_view bestFolded;
    unsigned scope = 0, bestScope = 0;
    const auto consider = [&](std::string_view folded, std::string_view spelling, bool keyword,
                              const Symbol* symbol = nullptr) {
        const unsigned distance = editDistance(written, folded, limit);
        if (distance > std::min(limit, suggestionLimit(folded.size()))) return; // Search_1D is not SearchC
        const bool equal = !best.name.empty() && distance == limit;
        if (equal && (scope != bestScope || bestFolded <= folded)) return;
        if (symbol && scopes_.lookup(symbol->nameId) != symbol) return; // hidden by another of its name
        best = {std::string(spelling), keyword, symbol};
        bestFolded = folded;
        bestScope = scope;
        limit = distance;
    };
    const WordShape shape = names_.shape(name);
    const auto considerSymbol = [&](NameId id, const Symbol* symbol) {
        if (symbol && id != name && mayBeNear(shape, names_.shape(id), limit) && !symbol->name.empty() &&
            isWanted(*symbol, wanted))
            consider(names_.folded(id), symbol->name, false, symbol);
    };
    if (context_.routine)
        for (const NameId id : state_.declaredInRoutine)
            considerSymbol(id, at(state_.routineNames, id));
    scope = 1;
    own.forEach(considerSymbol);
    scope = 2;
    for (const NameId id : nameLists().global)
        considerSymbol(id, at(task_.globals, id));
    scope = 3;
    for (const NameId id : nameLists().configured)
        considerSymbol(id, at(task_.configured, id));
    // A name of one to three letters is near to everything of that length.
    scope = 4;
    constexpr size_t kShort = 4;
    if (written.size() >= kShort) {
        if (wanted == Wanted::Procedure)
            for (const Word& word : kInstructionWords)
                consider(word.folded, word.spelling, true);
        if (wanted == Wanted::Data)
            for (const Word& word : kValueWords)
                consider(word.folded, word.spelling, true);
        for (const NameId id : nearPredefined(name))
            considerSymbol(id, state_.predefined[id]);
    }
    return near(written, limit) ? best : Suggestion();
}

std::string Suggestions::deeperComponent(const Type& record, std::string_view name) {
    std::string found;
    for (const Type::Component& part : record.base()->components) {
        if (part.type->base()->kind != TypeKind::Record) continue;
        const int inner = part.type->findComponent(name);
        if (inner < 0) continue;
        if (!found.empty()) return {};
        found = part.name + "." + part.type->base()->components[static_cast<size_t>(inner)].name;
    }
    return found;
}

const Type::Component* Suggestions::nearComponent(const Type& record, std::string_view name) {
    const std::vector<Type::Component>& components = record.base()->components;
    if (routine_.partComparisonsLeft < components.size()) return nullptr;
    routine_.partComparisonsLeft -= components.size();
    unsigned limit = suggestionLimit(name.size());
    const Type::Component* best = nullptr;
    for (const Type::Component& c : components) {
        const unsigned distance = editDistance(name, c.name, limit);
        if (distance > limit || (best && distance == limit)) continue;
        best = &c;
        limit = distance;
    }
    return best && near(name, limit) ? best : nullptr;
}

const DataSymbol* Suggestions::nearOptional(const RoutineSymbol& routine, NameId name) {
    if (routine_.partComparisonsLeft < routine.params.size()) return nullptr;
    routine_.partComparisonsLeft -= routine.params.size();
    const std::string_view written = names_.folded(name);
    unsigned limit = suggestionLimit(written.size());
    const DataSymbol* best = nullptr;
    for (const DataSymbol* param : routine.params) {
        if (!param->optional) continue;
        const unsigned distance = editDistance(written, names_.folded(param->nameId), limit);
        if (distance > limit || (best && distance == limit)) continue;
        best = param;
        limit = distance;
    }
    return best && near(written, limit) ? best : nullptr;
}

bool Suggestions::isWanted(const Symbol& symbol, Wanted wanted) const {
    if (symbol.kind == SymbolKind::Data) {
        const auto& data = static_cast<const DataSymbol&>(symbol);
        if (data.assumed) return false; // nothing declares it
        return wanted == Wanted::Data || (wanted == Wanted::Signal && data.storage == Storage::Signal);
    }
    if (symbol.kind == SymbolKind::Type) {
        const Type* type = static_cast<const TypeSymbol&>(symbol).type; // null: not resolved yet
        return wanted == Wanted::Type && (!type || isReal(*type));
    }
    if (symbol.kind != SymbolKind::Routine) return false;
    switch (static_cast<const RoutineSymbol&>(symbol).routineKind) {
    case RoutineKind::Proc: return wanted == Wanted::Procedure;
    case RoutineKind::Func: return wanted == Wanted::Function;
    case RoutineKind::Trap: return wanted == Wanted::Trap;
    }
    return false;
}

} // namespace rapid::sema
