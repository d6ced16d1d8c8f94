// Types: looking up components.

#include "frontend/sema/types.h"

#include "config/letter_case.h"

#include <algorithm>
#include <numeric>

namespace rapid::sema {

void Type::sortComponents() {
    constexpr size_t kMany = 64;
    if (components.size() < kMany) return;
    sorted.resize(components.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::sort(sorted.begin(), sorted.end(), [this](uint32_t a, uint32_t b) {
        const int order = config::compareNames(components[a].name, components[b].name);
        return order != 0 ? order < 0 : a < b; // of equal names the first counts
    });
}

int Type::findComponent(std::string_view wanted) const {
    const std::vector<Component>& all = base()->components;
    if (const std::vector<uint32_t>& order = base()->sorted; !order.empty()) {
        const auto found = std::partition_point(order.begin(), order.end(), [&](uint32_t index) {
            return config::compareNames(all[index].name, wanted) < 0;
        });
        const bool present = found != order.end() && config::sameName(all[*found].name, wanted);
        return present ? static_cast<int>(*found) : -1;
    }
    for (size_t i = 0; i < all.size(); ++i)
        if (config::sameName(all[i].name, wanted)) return static_cast<int>(i);
    return -1;
}

} // namespace rapid::sema
