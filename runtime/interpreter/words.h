#pragma once
// Slots, and the operations on them that need nothing but their operands.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "runtime/abi/interpreted.h"

namespace rt::words {

union Slot {
    int64_t integer;
    uint64_t bits;
    float single;
    double twofold;
    void* pointer;
};
static_assert(sizeof(Slot) == 8);

constexpr WordOp opOf(uint32_t word) {
    return static_cast<WordOp>(word & 0xFF);
}
constexpr WordType typeOf(uint32_t word) {
    return static_cast<WordType>(word >> 8 & 0xFF);
}
constexpr uint32_t countOf(uint32_t word) {
    return word >> 16;
}

constexpr unsigned bitsOf(WordType type) {
    switch (type) {
    case WordType::I8: return 8;
    case WordType::I16: return 16;
    case WordType::I32: return 32;
    case WordType::None:
    case WordType::Bool:
    case WordType::I64:
    case WordType::F32:
    case WordType::F64:
    case WordType::Ptr: return 64;
    }
    return 64;
}

/// An integer of the type as slots hold it: the lowest bits of `value`, sign-extended.
constexpr int64_t canonical(WordType type, uint64_t value) {
    const unsigned unused = 64 - bitsOf(type);
    return static_cast<int64_t>(value << unused) >> unused;
}
constexpr uint64_t withoutSign(WordType type, int64_t value) {
    const unsigned unused = 64 - bitsOf(type);
    return static_cast<uint64_t>(value) << unused >> unused;
}

template <class T> T read(const void* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}
template <class T> void write(T value, void* to) {
    std::memcpy(to, &value, sizeof value);
}

inline Slot load(WordType type, const void* from) {
    Slot slot;
    slot.bits = 0;
    switch (type) {
    case WordType::Bool: slot.bits = read<uint8_t>(from) != 0 ? 1 : 0; break;
    case WordType::I8: slot.integer = read<int8_t>(from); break;
    case WordType::I16: slot.integer = read<int16_t>(from); break;
    case WordType::I32: slot.integer = read<int32_t>(from); break;
    case WordType::F32: slot.single = read<float>(from); break;
    case WordType::None:
    case WordType::I64:
    case WordType::F64:
    case WordType::Ptr: slot.bits = read<uint64_t>(from); break;
    }
    return slot;
}

inline void store(WordType type, Slot slot, void* to) {
    switch (type) {
    case WordType::Bool:
    case WordType::I8: write(static_cast<uint8_t>(slot.bits), to); break;
    case WordType::I16: write(static_cast<uint16_t>(slot.bits), to); break;
    case WordType::I32: write(static_cast<uint32_t>(slot.bits), to); break;
    case WordType::F32: write(slot.single, to); break;
    case WordType::None:
    case WordType::I64:
    case WordType::F64:
    case WordType::Ptr: write(slot.bits, to); break;
    }
}

inline double numberIn(WordType type, Slot slot) {
    return type == WordType::F32 ? static_cast<double>(slot.single) : slot.twofold;
}

/// Toward zero, saturating; NaN gives 0.
inline int64_t toSigned(double number, WordType type) {
    const unsigned bits = bitsOf(type);
    if (std::isnan(number)) return 0;
    const double limit = std::ldexp(1.0, static_cast<int>(bits) - 1);
    const int64_t largest = std::numeric_limits<int64_t>::max() >> (64 - bits);
    if (number >= limit) return largest;
    if (number < -limit) return -largest - 1;
    return static_cast<int64_t>(number);
}
inline int64_t toUnsigned(double number, WordType type) {
    const unsigned bits = bitsOf(type);
    if (!(number > 0)) return 0;
    if (number >= std::ldexp(1.0, static_cast<int>(bits))) return -1;
    return canonical(type, static_cast<uint64_t>(number));
}

/// IDiv and IRem: dividing by -1 is set apart, since the smallest integer overflows.
inline int64_t divide(WordType type, int64_t a, int64_t b) {
    return b == -1 ? canonical(type, 0 - static_cast<uint64_t>(a))
                   : canonical(type, static_cast<uint64_t>(a / b));
}
inline int64_t remainder(int64_t a, int64_t b) {
    return b == -1 ? 0 : a % b;
}

inline Slot truth(bool value) {
    Slot slot;
    slot.bits = value ? 1 : 0;
    return slot;
}

} // namespace rt::words
