// Types: looking up components.

#include "frontend/sema/types.h"

#include "config/letter_case.h"

namespace rapid::sema {

int Type::findComponent(std::string_view wanted) const {
    const std::vector<Component>& all = base()->components;
    for (size_t i = 0; i < all.size(); ++i)
        if (config::sameName(all[i].name, wanted)) return static_cast<int>(i);
    return -1;
}

} // namespace rapid::sema
