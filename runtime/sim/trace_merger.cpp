#include "runtime/sim/trace_merger.h"

#include <algorithm>

namespace rt {

void TraceMerger::sample(Time time, std::string_view unit, const motion::MotionState& state) {
    constexpr std::size_t kManyWaiting = 1000;
    const auto found =
        std::find_if(units_.begin(), units_.end(), [&](const Unit& known) { return known.name == unit; });
    if (found == units_.end()) return;
    found->waiting.push_back({time, state});
    while (passOne(false)) {
    }
    if (found->waiting.size() < kManyWaiting || isCatchingUp_) return;
    isCatchingUp_ = true;
    catchUp_();
    isCatchingUp_ = false;
}

/// The earliest sample, when every unit has one (or `whole`).
bool TraceMerger::passOne(bool whole) {
    Unit* first = nullptr;
    for (Unit& unit : units_) {
        if (unit.waiting.empty() && !whole) return false;
        if (unit.waiting.empty()) continue;
        if (first == nullptr || unit.waiting.front().time < first->waiting.front().time) first = &unit;
    }
    if (first == nullptr) return false;
    out_.sample(first->waiting.front().time, first->name, first->waiting.front().state);
    first->waiting.pop_front();
    return true;
}

void TraceMerger::finish() {
    while (passOne(true)) {
    }
}

} // namespace rt
