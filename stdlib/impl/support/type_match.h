#pragma once
// Types of data that meet at run time, when names are bound late. Each module loaded brings descriptions of its own, so
// types are compared by what they are, not by address.

#include "runtime/abi/rt_abi.h"

namespace rt::lib {

/// Of an array the type of its elements, else the type itself.
const TypeDesc& elementOf(const TypeDesc& type);
/// Number of dimensions, 0 for no array.
int rankOf(const TypeDesc& type);
/// Both are the same type of the language: aliases count as what they stand for, records by name and components.
bool sameType(const TypeDesc& a, const TypeDesc& b);

enum class Match { Yes, OtherType, OtherDimensions };
/// Does an argument of type `have` fit a parameter of `rank` dimensions (of any size) with elements of type `want`?
Match matchArgument(const TypeDesc& have, const TypeDesc& want, int rank);
/// Can values be copied between these two?
Match matchValue(const TypeDesc& a, const TypeDesc& b);

} // namespace rt::lib
