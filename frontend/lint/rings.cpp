#include "frontend/lint/rings.h"

#include <algorithm>

namespace rapid::lint {

using sema::RoutineSymbol;
using RoutineSet = std::unordered_set<const RoutineSymbol*>;

namespace {

constexpr size_t kMostCandidates =
    500; ///< with more routines that are never called, the rest is not worth judging

/// Adds what `work` calls, directly or not; `within`: looks at these only.
void reach(const TaskFacts& facts, RoutineList work, const RoutineSet* within, RoutineSet& into) {
    while (!work.empty()) {
        const auto own = facts.routines.find(work.back());
        work.pop_back();
        if (own == facts.routines.end()) continue;
        for (size_t i = own->second.firstCall; i < own->second.endCall; ++i) {
            const RoutineSymbol* callee = facts.calls[i];
            if ((!within || within->count(callee) > 0) && into.insert(callee).second) work.push_back(callee);
        }
    }
}

} // namespace

std::vector<RoutineList> ringsOf(const TaskFacts& facts, const RoutineList& roots, RoutineList candidates) {
    std::vector<RoutineList> rings;
    if (candidates.empty()) return rings;
    RoutineSet live;
    reach(facts, roots, nullptr, live);
    std::erase_if(candidates, [&](const RoutineSymbol* routine) { return live.count(routine) > 0; });
    if (candidates.size() > kMostCandidates) return rings;
    const RoutineSet within(candidates.begin(), candidates.end());
    std::unordered_map<const RoutineSymbol*, RoutineSet> reached;
    for (const RoutineSymbol* routine : candidates)
        reach(facts, {routine}, &within, reached[routine]);
    const auto reaches = [&](const RoutineSymbol* from, const RoutineSymbol* to) {
        return reached.at(from).count(to) > 0;
    };
    for (const RoutineSymbol* first : candidates) {
        RoutineList ring;
        bool calledFromOutside = false;
        for (const RoutineSymbol* other : candidates) {
            if (!reaches(other, first)) continue;
            if (reaches(first, other))
                ring.push_back(other);
            else
                calledFromOutside = true;
        }
        if (!calledFromOutside && !ring.empty() && ring.front() == first) rings.push_back(std::move(ring));
    }
    return rings;
}

} // namespace rapid::lint
