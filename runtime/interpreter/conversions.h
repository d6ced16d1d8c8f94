#pragma once
// Conversions between numbers, as the words of the interpreter mean them: the operand, its type, the type of the result.

#include "runtime/interpreter/words.h"

namespace rt::words {

inline Slot real(double number, WordType type) {
    Slot made;
    made.bits = 0;
    if (type == WordType::F32)
        made.single = static_cast<float>(number);
    else
        made.twofold = number;
    return made;
}

inline Slot whole(int64_t number) {
    Slot made;
    made.integer = number;
    return made;
}

inline Slot zeroExtended(Slot a, WordType from, WordType to) {
    return whole(canonical(to, withoutSign(from, a.integer)));
}

inline Slot truncated(Slot a, WordType, WordType to) {
    return whole(canonical(to, a.bits));
}

/// An integer as a number, rounded once: not by way of a double.
template <class Integer> Slot toReal(Integer number, WordType type) {
    Slot made = real(0, type);
    if (type == WordType::F32)
        made.single = static_cast<float>(number);
    else
        made.twofold = static_cast<double>(number);
    return made;
}

inline Slot signedToReal(Slot a, WordType, WordType to) {
    return toReal(a.integer, to);
}

inline Slot unsignedToReal(Slot a, WordType from, WordType to) {
    return toReal(withoutSign(from, a.integer), to);
}

inline Slot realToSigned(Slot a, WordType from, WordType to) {
    return whole(toSigned(numberIn(from, a), to));
}

inline Slot realToUnsigned(Slot a, WordType from, WordType to) {
    return whole(toUnsigned(numberIn(from, a), to));
}

inline Slot realToReal(Slot a, WordType from, WordType to) {
    return real(numberIn(from, a), to);
}

} // namespace rt::words
