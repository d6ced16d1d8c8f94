#pragma once
// The effect of weavedata on the path.

#include "runtime/host/controller.h"
#include "runtime/motion/weaving.h"

#include "stdlib_types.h"

namespace rt::lib {

/// The pattern of a movement along the seam at `speed` mm/s. ERR_ARGVALERR when the data make none.
Status weavePattern(TaskCore* task, const data::Weavedata& data, double speed, motion::WeavePattern& pattern);

} // namespace rt::lib
