#pragma once
// Constants of routines: compiled code knows only their values, so the checked program has to say what they are.

#include "runtime/abi/rt_abi.h"
#include "tools/program/pipeline.h"

#include <string>
#include <vector>

namespace rapidc::dap {

struct ConstantText {
    std::string name, type, value; ///< value: as RAPID text
};

/// Those that the routine declares; none when the program was not compiled with its module.
std::vector<ConstantText> constantsOf(const Compilation& compilation, std::size_t task,
                                      const rt::RoutineDesc& routine);

} // namespace rapidc::dap
