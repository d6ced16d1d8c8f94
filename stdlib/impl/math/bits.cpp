// Manual 1.15: bit functions on byte (8 bits in a num) and on dnum (52 bits). Bit 1 is the least significant.

#include "stdlib/impl/support/fail.h"

#include "natives/bits.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

constexpr int kByteBits = 8;
constexpr int kDnumBits = 52;

uint64_t maskOf(int bits) {
    return (uint64_t{1} << bits) - 1;
}

/// A whole number from `low` to `high`. LLVM recognizes the conversions: of what was a whole number before it leaves
/// nothing.
template <class T> bool readWhole(T value, T low, T high, int64_t& out) {
    if (!(value >= low && value <= high)) return false;
    out = static_cast<int64_t>(value);
    return static_cast<T>(out) == value;
}

/// A non-negative whole number of at most `bits` bits.
template <class T> bool readBits(T value, int bits, uint64_t& out) {
    int64_t whole = 0;
    const bool fine = readWhole(value, T{0}, static_cast<T>(maskOf(bits)), whole);
    out = static_cast<uint64_t>(whole) & maskOf(bits);
    return fine;
}

bool readCount(float value, int limit, int& out) {
    int64_t whole = 0;
    const bool fine = readWhole(value, 1.0F, static_cast<float>(limit), whole);
    out = static_cast<int>(whole);
    return fine;
}

/// At most 52 bits: the conversion of a signed number is one instruction.
template <class T> T fromBits(uint64_t bits) {
    return static_cast<T>(static_cast<int64_t>(bits));
}

Status badBits(TaskCore* task, int bits) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     bits == kByteBits ? "the argument must be a whole number from 0 to 255"
                                       : "the argument must be a whole number from 0 to 2^52 - 1");
}

Status badCount(TaskCore* task, int limit) {
    return lib::failWith(task, err::ERR_ARGVALERR,
                         "bit position, steps and size must be whole numbers from 1 to {}", limit);
}

template <class T, class Op> Status combine(TaskCore* task, T* result, int bits, T a, T b, Op op) {
    uint64_t x = 0;
    uint64_t y = 0;
    if (!readBits(a, bits, x) || !readBits(b, bits, y)) return badBits(task, bits);
    *result = fromBits<T>(op(x, y));
    return kOk;
}

template <class T> Status negate(TaskCore* task, T* result, int bits, T value, int size) {
    uint64_t x = 0;
    if (!readBits(value, bits, x)) return badBits(task, bits);
    *result = fromBits<T>(~x & maskOf(size));
    return kOk;
}

template <class T>
Status shift(TaskCore* task, T* result, int bits, T value, float steps, bool left, int size) {
    uint64_t x = 0;
    int count = 0;
    if (!readBits(value, bits, x)) return badBits(task, bits);
    if (!readCount(steps, bits, count)) return badCount(task, bits);
    *result = fromBits<T>(left ? (x << count) & maskOf(size) : x >> count);
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
    const uint64_t mask =
        uint64_t{1} << (bit - 1) & maskOf(bits); // so programs know how many bits the result has
    *data = fromBits<T>(set ? x | mask : x & ~mask);
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
