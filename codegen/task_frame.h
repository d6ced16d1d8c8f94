#pragma once
// Which routines keep TaskCore::frame up to date.

#include <vector>

#include "ir/core/ir.h"

namespace codegen {

/// By routine: whether it calls natives, itself or by way of other routines, or has a handler. These set TaskCore::frame to
/// their record and back to their caller's; the others leave it alone.
std::vector<bool> routinesSettingTaskFrame(const ir::Module& module);

} // namespace codegen
