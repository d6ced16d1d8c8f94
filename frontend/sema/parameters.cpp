// The parameters of a routine as the arguments of a call meet them.

#include "frontend/sema/parameters.h"

#include <algorithm>

namespace rapid::sema {

size_t alternativesEnd(const RoutineSymbol& routine, size_t first) {
    size_t end = first + 1;
    if (first < routine.params.size() && routine.params[first]->requiredAlternative)
        while (end < routine.params.size() && !routine.params[end]->optional &&
               routine.params[end]->group == routine.params[first]->group)
            ++end;
    return end;
}

size_t nextRequired(const RoutineSymbol& routine, size_t from) {
    while (from < routine.params.size() && routine.params[from]->optional)
        ++from;
    return from;
}

size_t requiredSlots(const RoutineSymbol& routine) {
    size_t count = 0;
    for (size_t i = nextRequired(routine, 0); i < routine.params.size();
         i = nextRequired(routine, alternativesEnd(routine, i)))
        ++count;
    return count;
}

size_t nextLacking(const BoundCall& call, size_t from) {
    const RoutineSymbol& routine = *call.routine;
    for (size_t i = nextRequired(routine, from); i < routine.params.size();) {
        const size_t end = alternativesEnd(routine, i);
        const std::span<const BoundArg> place = call.args.subspan(i, end - i);
        if (std::none_of(place.begin(), place.end(), [](const BoundArg& bound) { return bound.argument; }))
            return i;
        i = nextRequired(routine, end);
    }
    return routine.params.size();
}

/// "'Value' or 'Dvalue'"
std::string namesOf(std::span<const BoundArg> alternatives) {
    std::string names;
    for (const BoundArg& bound : alternatives)
        names += (names.empty() ? "'" : " or '") + bound.param->name + "'";
    return names;
}

} // namespace rapid::sema
