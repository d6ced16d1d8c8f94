// Types: looking up components.

#include "frontend/sema/types.h"

namespace rapid::sema {

namespace {
bool equalsNoCase(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i) {
        const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
        if (lower(a[i]) == lower(b[i])) continue;
        // Second bytes of ISO 8859-1 letters in UTF-8: the cases differ by 0x20.
        const auto x = static_cast<unsigned char>(a[i]);
        const auto y = static_cast<unsigned char>(b[i]);
        const bool letters =
            i > 0 && static_cast<unsigned char>(a[i - 1]) == 0xC3 && (x | 0x20) == (y | 0x20);
        if (!letters || (x | 0x20) == 0xB7) return false;
    }
    return true;
}
} // namespace

int Type::findComponent(std::string_view wanted) const {
    const std::vector<Component>& all = base()->components;
    for (size_t i = 0; i < all.size(); ++i)
        if (equalsNoCase(all[i].name, wanted)) return static_cast<int>(i);
    return -1;
}

} // namespace rapid::sema
