#pragma once
// CycleCount: how punctual a periodic work is.

#include "runtime/base/time.h"

#include <algorithm>
#include <cstdint>

namespace rapidc::service {

struct CycleCount {
    uint64_t cycles = 0;
    uint64_t missed = 0; ///< began when the next one was due already
    rt::Time latest = 0; ///< the greatest delay

    void count(rt::Time lateness, rt::Time period) {
        ++cycles;
        if (lateness >= period) ++missed;
        latest = std::max(latest, lateness);
    }
    /// Per cent.
    double missedShare() const {
        return cycles == 0 ? 0 : 100.0 * static_cast<double>(missed) / static_cast<double>(cycles);
    }
};

} // namespace rapidc::service
