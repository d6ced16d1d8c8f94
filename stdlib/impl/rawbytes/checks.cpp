#include "stdlib/impl/rawbytes/checks.h"

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

namespace rt::lib {

Status notAnIndex(TaskCore* task, const char* argument) {
    return fail(task, err::ERR_ARGVALERR, fmt::format("{} must be a whole number from 1 to 1024", argument));
}

Status beyondCapacity(TaskCore* task, uint32_t first, uint32_t count) {
    return fail(task, err::ERR_ARGVALERR,
                fmt::format("{} bytes from index {} on do not fit: rawbytes has 1024", count, first));
}

Status beyondValid(TaskCore* task, uint32_t first, uint32_t count, uint32_t valid) {
    return fail(task, err::ERR_ARGVALERR,
                fmt::format("bytes {} to {} are asked for, but only {} are valid (RawBytesLen)", first,
                            first + count - 1, valid));
}

} // namespace rt::lib
