#pragma once
// The data files of runtime/robot/models as they were when the library was built.

#include <span>
#include <string_view>

namespace robot {

/// One JSON text per shipped model.
std::span<const std::string_view> embeddedModelTexts();

} // namespace robot
