#pragma once
// RobotWare options: whether a controller has what a built-in needs.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::sema {

/// `installed`: as a backup lists them, "623-1 Multitasking". `wanted`: as built-ins name them, "World Zones" or
/// "Path Corrections or RobotWare-Arc sensor". Options that another one includes count.
bool isOptionInstalled(const std::vector<std::string>& installed, std::string_view wanted);

} // namespace rapid::sema
