#pragma once
// Indexes into rawbytes: from 1 to 1024 (manual 1.10). The texts of the errors are put together out of line.

#include "runtime/abi/rt_abi.h"

namespace rt::lib {

/// A whole number from 1 to the capacity.
inline bool toIndex(float value, uint32_t& index) {
    if (!(value >= 1 && value <= 1024)) return false;
    index = static_cast<uint32_t>(value);
    return static_cast<float>(index) == value;
}

/// These raise ERR_ARGVALERR. `first`: index from 1.
[[gnu::cold]] Status notAnIndex(TaskCore* task, const char* argument);
[[gnu::cold]] Status beyondCapacity(TaskCore* task, uint32_t first, uint32_t count);
[[gnu::cold]] Status beyondValid(TaskCore* task, uint32_t first, uint32_t count, uint32_t valid);

} // namespace rt::lib
