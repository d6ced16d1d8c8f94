#pragma once
// Names that options and add-ins of RobotWare declare in modules which no backup holds.

#include <string_view>

namespace rapid::sema {

/// The option or add-in that declares a name (lower case), or nothing. `whole`: the beginning of a name is not enough.
std::string_view addInOf(std::string_view folded, bool whole);

} // namespace rapid::sema
