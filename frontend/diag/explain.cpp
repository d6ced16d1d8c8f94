#include "frontend/diag/explain.h"

#include <algorithm>

namespace rapid::diag {

const Explanation* findExplanation(uint16_t number) {
    const auto all = explanations1xxx();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Explanation& e) { return e.number == number; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace rapid::diag
