#pragma once
// Optional value of TPWrite and Write (manual 1.10).

#include "stdlib_types.h"

#include <string>

namespace rt::lib {

/// The text with the value after it, without a blank between them; null: not given.
std::string withValue(const String& text, const float* num, const bool* boolean, const data::Pos* pos,
                      const data::Orient* orient, const double* dnum);

} // namespace rt::lib
