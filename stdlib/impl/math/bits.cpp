// Manual 1.15: bit functions on byte (8 bits in a num) and on dnum (52 bits). Bit 1 is the least significant.

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <cmath>

using namespace rt;

namespace {

constexpr int kByteBits = 8;
constexpr int kDnumBits = 52;

uint64_t maskOf(int bits) {
    return (uint64_t{1} << bits) - 1;
}

/// A non-negative whole number of at most `bits` bits.
bool readBits(double value, int bits, uint64_t& out) {
    if (!(value >= 0 && value <= static_cast<double>(maskOf(bits))) || std::trunc(value) != value)
        return false;
    out = static_cast<uint64_t>(value);
    return true;
}

bool readCount(double value, int limit, int& out) {
    if (!(value >= 1 && value <= limit) || std::trunc(value) != value) return false;
    out = static_cast<int>(value);
    return true;
}

Status badBits(TaskCore* task, int bits) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     bits == kByteBits ? "the argument must be a whole number from 0 to 255"
                                       : "the argument must be a whole number from 0 to 2^52 - 1");
}

Status badCount(TaskCore* task, int limit) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     "bit position, steps and size must be whole numbers from 1 to " + std::to_string(limit));
}

template <class T, class Op> Status combine(TaskCore* task, T* result, int bits, T a, T b, Op op) {
    uint64_t x = 0;
    uint64_t y = 0;
    if (!readBits(a, bits, x) || !readBits(b, bits, y)) return badBits(task, bits);
    *result = static_cast<T>(op(x, y));
    return kOk;
}

template <class T> Status negate(TaskCore* task, T* result, int bits, T value, int size) {
    uint64_t x = 0;
    if (!readBits(value, bits, x)) return badBits(task, bits);
    *result = static_cast<T>(~x & maskOf(size));
    return kOk;
}

template <class T>
Status shift(TaskCore* task, T* result, int bits, T value, float steps, bool left, int size) {
    uint64_t x = 0;
    int count = 0;
    if (!readBits(value, bits, x)) return badBits(task, bits);
    if (!readCount(steps, bits, count)) return badCount(task, bits);
    *result = static_cast<T>(left ? (x << count) & maskOf(size) : x >> count);
    return kOk;
}

template <class T> Status check(TaskCore* task, bool* result, int bits, T value, float position) {
    uint64_t x = 0;
    int bit = 0;
    if (!readBits(value, bits, x)) return badBits(task, bits);
    if (!readCount(position, bits, bit)) return badCount(task, bits);
    *result = (x >> (bit - 1) & 1) != 0;
    return kOk;
}

template <class T> Status change(TaskCore* task, T* data, int bits, float position, bool set) {
    uint64_t x = 0;
    int bit = 0;
    if (!readBits(*data, bits, x)) return badBits(task, bits);
    if (!readCount(position, bits, bit)) return badCount(task, bits);
    const uint64_t mask = uint64_t{1} << (bit - 1);
    *data = static_cast<T>(set ? x | mask : x & ~mask);
    return kOk;
}

Status sizeOf(TaskCore* task, const float* size, int& bits) {
    bits = kDnumBits;
    return size && !readCount(*size, kDnumBits, bits) ? badCount(task, kDnumBits) : kOk;
}

constexpr auto kAnd = [](uint64_t x, uint64_t y) { return x & y; };
constexpr auto kOr = [](uint64_t x, uint64_t y) { return x | y; };
constexpr auto kXor = [](uint64_t x, uint64_t y) { return x ^ y; };

} // namespace

extern "C" {

Status rt_BitAnd(TaskCore* task, float* result, float BitData1, float BitData2) {
    return combine(task, result, kByteBits, BitData1, BitData2, kAnd);
}
Status rt_BitAndDnum(TaskCore* task, double* result, double Value1, double Value2) {
    return combine(task, result, kDnumBits, Value1, Value2, kAnd);
}
Status rt_BitOr(TaskCore* task, float* result, float BitData1, float BitData2) {
    return combine(task, result, kByteBits, BitData1, BitData2, kOr);
}
Status rt_BitOrDnum(TaskCore* task, double* result, double Value1, double Value2) {
    return combine(task, result, kDnumBits, Value1, Value2, kOr);
}
Status rt_BitXOr(TaskCore* task, float* result, float BitData1, float BitData2) {
    return combine(task, result, kByteBits, BitData1, BitData2, kXor);
}
Status rt_BitXOrDnum(TaskCore* task, double* result, double Value1, double Value2) {
    return combine(task, result, kDnumBits, Value1, Value2, kXor);
}

Status rt_BitNeg(TaskCore* task, float* result, float BitData) {
    return negate(task, result, kByteBits, BitData, kByteBits);
}
Status rt_BitNegDnum(TaskCore* task, double* result, double Value, const float* Size) {
    int bits = 0;
    if (const Status status = sizeOf(task, Size, bits)) return status;
    return negate(task, result, kDnumBits, Value, bits);
}

Status rt_BitLSh(TaskCore* task, float* result, float BitData, float ShiftSteps) {
    return shift(task, result, kByteBits, BitData, ShiftSteps, true, kByteBits);
}
Status rt_BitLShDnum(TaskCore* task, double* result, double Value, float ShiftSteps, const float* Size) {
    int bits = 0;
    if (const Status status = sizeOf(task, Size, bits)) return status;
    return shift(task, result, kDnumBits, Value, ShiftSteps, true, bits);
}
Status rt_BitRSh(TaskCore* task, float* result, float BitData, float ShiftSteps) {
    return shift(task, result, kByteBits, BitData, ShiftSteps, false, kByteBits);
}
Status rt_BitRShDnum(TaskCore* task, double* result, double Value, float ShiftSteps) {
    return shift(task, result, kDnumBits, Value, ShiftSteps, false, kDnumBits);
}

Status rt_BitCheck(TaskCore* task, bool* result, float BitData, float BitPos) {
    return check(task, result, kByteBits, BitData, BitPos);
}
Status rt_BitCheckDnum(TaskCore* task, bool* result, double Value, float BitPos) {
    return check(task, result, kDnumBits, Value, BitPos);
}
Status rt_BitSet(TaskCore* task, float* BitData, double* DnumData, float BitPos) {
    return BitData ? change(task, BitData, kByteBits, BitPos, true)
                   : change(task, DnumData, kDnumBits, BitPos, true);
}
Status rt_BitClear(TaskCore* task, float* BitData, double* DnumData, float BitPos) {
    return BitData ? change(task, BitData, kByteBits, BitPos, false)
                   : change(task, DnumData, kDnumBits, BitPos, false);
}

Status rt_BytesReset(TaskCore*, float* Bytes, int32_t BytesDim1) {
    for (int32_t i = 0; i < BytesDim1; ++i)
        Bytes[i] = 0;
    return kOk;
}
}
