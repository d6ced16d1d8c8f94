#pragma once
// DIV and MOD of whole numbers of any size (manual 1.3.1), as compiled code, the interpreter and the standard library compute them.

#include <cmath>

namespace rt {

/// Has the sign of a; never -0. b is not 0.
template <class Float> Float wholeRemainder(Float a, Float b) {
    return std::fmod(a, b) + Float(0);
}

/// Right as long as it is below 2^53, and the nearest number otherwise. b is not 0.
template <class Float> Float wholeQuotient(Float a, Float b) {
    const Float ratio = std::trunc(a / b);
    const Float mostExact = sizeof(Float) == sizeof(float) ? Float(0x1p24) : Float(0x1p53);
    if (std::abs(a) <= mostExact)
        return ratio; // two exact numbers: rounding the ratio does not reach the next whole number
    // a - remainder is a multiple of b, so the quotient is whole; 64 bits of precision leave no doubt which number it is.
    const long double multiple = static_cast<long double>(a) - std::fmod(a, b);
    return static_cast<Float>(std::round(multiple / b));
}

} // namespace rt
