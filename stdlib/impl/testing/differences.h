#pragma once
// Comparison of values of any type for assertions: where they differ, and their texts.

#include "runtime/abi/rt_abi.h"

#include <string>

namespace rt::lib {

/// Value of a num or dnum.
double numberOf(const void* data, const TypeDesc& type);

/// The first part in which two values differ.
struct Difference {
    bool found = false;
    std::string part;     ///< ".trans.x", "{2}", "{1,3}.count"; "" for the whole value
    std::string expected; ///< values of the part
    std::string actual;
    std::string measured; ///< "distance 3.2 mm"; "" when values were compared
};

/// Numbers may differ by `tolerance`. Arrays of different sizes differ as a whole.
Difference compareValues(const void* expected, const TypeDesc& expectedType, const void* actual,
                         const TypeDesc& actualType, double tolerance);

/// Positions may differ by `distance` (mm), orientations and axes by `angle` (degrees). False when the type has no places
/// (not a robtarget, pose, pos, orient, jointtarget or robjoint).
bool compareNear(const void* expected, const void* actual, const TypeDesc& type, double distance,
                 double angle, Difference& difference);

/// Texts of both values in RAPID's notation, with as many digits as show that they differ.
void describeValues(const void* expected, const TypeDesc& expectedType, const void* actual,
                    const TypeDesc& actualType, std::string& expectedText, std::string& actualText);

} // namespace rt::lib
