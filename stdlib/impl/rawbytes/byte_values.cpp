// ValToBytes, BytesToVal (manual 1.17): a whole number as bytes, lowest byte first.

#include "stdlib/impl/support/fail.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <cmath>

using namespace rt;

namespace {

constexpr double kByte = 256;
constexpr double kMost = 9007199254740991; // the largest whole number up to which dnum has all of them

} // namespace

extern "C" {

Status rt_ValToBytes(TaskCore* task, const float* Value, const double* Dvalue, float* Bytes,
                     int32_t BytesDim1) {
    double value = Value != nullptr ? static_cast<double>(*Value) : *Dvalue;
    if (!(value >= 0 && value <= kMost && value == std::floor(value)))
        return lib::fail(task, err::ERR_ARGVALERR, "ValToBytes takes a whole number from 0 on");
    if (value >= std::pow(kByte, BytesDim1))
        return lib::failWith(task, err::ERR_ARGVALERR, "ValToBytes: {} does not fit into {} bytes", value,
                             BytesDim1);
    for (int32_t i = 0; i < BytesDim1; ++i) {
        const double rest = std::floor(value / kByte);
        Bytes[i] = static_cast<float>(value - rest * kByte);
        value = rest;
    }
    return kOk;
}

Status rt_BytesToVal(TaskCore* task, double* result, const float* Bytes, int32_t BytesDim1) {
    double value = 0;
    for (int32_t i = BytesDim1; i > 0; --i) {
        const float byte = Bytes[i - 1];
        if (!(byte >= 0 && byte < kByte && byte == std::floor(byte)))
            return lib::fail(task, err::ERR_ARGVALERR, "BytesToVal: bytes are whole numbers from 0 to 255");
        value = value * kByte + byte;
        if (value > kMost) return lib::fail(task, err::ERR_ARGVALERR, "BytesToVal: the value is too large");
    }
    *result = value;
    return kOk;
}
}
