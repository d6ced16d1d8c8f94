#pragma once
// Which routines keep TaskCore::frame up to date.

#include <vector>

#include "codegen/codegen.h"
#include "ir/core/ir.h"

namespace codegen {

/// By routine: whether it calls natives that look at frame records, itself or by way of other routines, or has a handler. These set
/// TaskCore::frame to their record and back to their caller's; the others leave it alone. `inlined`: do not look at frame records in
/// short routines; none when routines are compiled one by one, by different passes.
std::vector<bool> routinesSettingTaskFrame(const ir::Module& module, const NativeBodies& inlined);

} // namespace codegen
