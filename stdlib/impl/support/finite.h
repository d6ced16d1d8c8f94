#pragma once
// Results of calculations: num and dnum hold numbers only (manual 1.12).

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <type_traits>

namespace rt::lib {

/// `T`: a number, or a record of nothing but num.
template <class T> [[gnu::always_inline]] inline bool isFinite(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        return std::isfinite(value);
    } else {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0);
        float numbers[sizeof(T) / sizeof(float)];
        std::memcpy(numbers, &value, sizeof value);
        // NaN for infinities and NaN, 0 for others; no branch for each. Added in pairs: no addition waits for all before it.
        for (float& number : numbers)
            number -= number;
        for (size_t count = std::size(numbers); count > 1; count = (count + 1) / 2)
            for (size_t i = 0; i < count / 2; ++i)
                numbers[i] += numbers[count - 1 - i];
        return !std::isnan(numbers[0]);
    }
}

[[gnu::cold]] inline Status tooLarge(TaskCore* task) {
    return fail(task, err::ERR_OVERFLOW, "the result is beyond the range of its type");
}

/// Stores a calculated value; raises ERR_OVERFLOW, and stores nothing, when a number in it is out of range.
template <class T> [[gnu::always_inline]] inline Status give(TaskCore* task, T* result, const T& value) {
    if (!isFinite(value)) return tooLarge(task);
    *result = value;
    return kOk;
}

} // namespace rt::lib
