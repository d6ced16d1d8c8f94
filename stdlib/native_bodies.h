#pragma once
// Bodies of small natives for the code generator, which inlines them.

#include <span>
#include <string_view>

namespace rt {

/// LLVM bitcode that defines nativesWithBody().
std::string_view nativeBodies();
/// Their symbols, in ascending order.
std::span<const std::string_view> nativesWithBody();

} // namespace rt
