#include "stdlib/native_table.h"

#include <algorithm>

namespace rt {

const char* errorName(int32_t number) {
    const auto table = errorTable();
    const auto found = std::lower_bound(table.begin(), table.end(), number,
                                        [](const ErrorEntry& entry, int32_t n) { return entry.number < n; });
    return found != table.end() && found->number == number ? found->name : nullptr;
}

} // namespace rt
