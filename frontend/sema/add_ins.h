#pragma once
// Names that options and add-ins of RobotWare declare in modules which no backup holds.

#include <string_view>

namespace rapid::sema {

/// The place where a name (lower case) may be declared: "the add-in ..." or "another release of RobotWare", or nothing. `type`: it
/// is where a data type is expected. `whole`: the beginning of a name is not enough.
std::string_view addInOf(std::string_view folded, bool type, bool whole);

} // namespace rapid::sema
