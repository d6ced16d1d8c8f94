#pragma once
// The text of a movement instruction, read from the source of its module.

#include "runtime/report/run_record.h"

#include <cstdint>
#include <string_view>

namespace rt::report {

/// The instruction that begins at this line and column (from 1, in bytes): its name and its target argument on one line.
/// Empty when no movement instruction is there, as in a file that was changed since it was compiled. In an instruction
/// for a circle the target follows the circle point, in a search the signal and the search point.
MoveText moveTextAt(std::string_view source, uint32_t line, uint32_t column);

} // namespace rt::report
