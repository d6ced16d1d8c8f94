#include "frontend/diag/explain.h"

#include <algorithm>

namespace rapid::diag {

const Explanation* findExplanation(uint16_t number) {
    for (const auto all : {explanations1xxx(), explanations2xxx(), explanations3xxx(), explanations4xxx(),
                           explanations5xxx(), explanations6xxx(), explanations7xxx(), explanations8xxx()}) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const Explanation& e) { return e.number == number; });
        if (found != all.end()) return &*found;
    }
    return nullptr;
}

} // namespace rapid::diag
