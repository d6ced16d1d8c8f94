// Manual 1.15: simple arithmetic. Inner calculations are done in double and rounded once to num.

#include "runtime/value/whole_limits.h"
#include "stdlib/impl/math/rounding.h"
#include "stdlib/impl/support/finite.h"

#include "natives/math.h"
#include "stdlib_constants.h"

#include <cmath>
#include <iterator>

using namespace rt;

namespace rt::lib {

namespace {

double powerOfTen(int exponent) {
    constexpr double kExact[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    return static_cast<size_t>(exponent) < std::size(kExact) ? kExact[exponent] : std::pow(10.0, exponent);
}

/// `step` is round or trunc. Beyond the precision of the type there is nothing left to cut.
template <class T> T atDecimals(T value, int decimals, T (*step)(T)) {
    if (decimals <= 0) return step(value);
    const double scale = powerOfTen(decimals);
    const T scaled = static_cast<T>(static_cast<double>(value) * scale);
    if (!std::isfinite(scaled) || step(scaled) == scaled) return value;
    return static_cast<T>(static_cast<double>(step(scaled)) / scale);
}

} // namespace

float roundNum(float value, int decimals) {
    return atDecimals<float>(value, decimals, [](float v) { return std::round(v); });
}
double roundDnum(double value, int decimals) {
    return atDecimals<double>(value, decimals, [](double v) { return std::round(v); });
}
float truncNum(float value, int decimals) {
    return atDecimals<float>(value, decimals, [](float v) { return std::trunc(v); });
}
double truncDnum(double value, int decimals) {
    return atDecimals<double>(value, decimals, [](double v) { return std::trunc(v); });
}

} // namespace rt::lib

namespace {

/// Number of decimals of an optional argument; negative when it is not valid.
int decimalsOf(const float* dec) {
    if (!dec) return 0;
    if (!(*dec >= 0 && *dec <= 300)) return -1;
    const int whole = static_cast<int>(*dec);
    return static_cast<float>(whole) == *dec ? whole : -1;
}

Status badDecimals(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR, "\\Dec must be a whole number of decimals, not negative");
}

/// x^y by the rules of the manual; ERR_NEGARG or ERR_OVERFLOW where it has no value.
Status power(TaskCore* task, double base, double exponent, double& value) {
    if (base < 0 && std::trunc(exponent) != exponent)
        return lib::fail(task, err::ERR_NEGARG, "a negative base needs a whole exponent");
    if (base == 0 && exponent <= 0)
        return lib::fail(task, err::ERR_OVERFLOW,
                         "0 raised to an exponent that is not positive has no value");
    value = std::pow(base, exponent);
    return kOk;
}

Status addTo(TaskCore* task, float* num, double* dnum, double amount) {
    const double sum = (num ? static_cast<double>(*num) : *dnum) + amount;
    if (num ? !std::isfinite(static_cast<float>(sum)) : !std::isfinite(sum))
        return lib::fail(task, err::ERR_NUM_LIMIT, "the sum is outside the range of the type");
    if (num)
        *num = static_cast<float>(sum);
    else
        *dnum = sum;
    return kOk;
}

} // namespace

extern "C" {

float rt_Abs(float Value) {
    return std::fabs(Value);
}
double rt_AbsDnum(double Value) {
    return std::fabs(Value);
}
float rt_Max(float A, float B) {
    return A < B ? B : A;
}
float rt_Min(float A, float B) {
    return B < A ? B : A;
}
double rt_NumToDnum(float Value) {
    return Value;
}

Status rt_Round(TaskCore* task, float* result, float Val, const float* Dec) {
    const int decimals = decimalsOf(Dec);
    if (decimals < 0) return badDecimals(task);
    return lib::give(task, result, lib::roundNum(Val, decimals));
}
Status rt_RoundDnum(TaskCore* task, double* result, double Val, const float* Dec) {
    const int decimals = decimalsOf(Dec);
    if (decimals < 0) return badDecimals(task);
    return lib::give(task, result, lib::roundDnum(Val, decimals));
}
Status rt_Trunc(TaskCore* task, float* result, float Val, const float* Dec) {
    const int decimals = decimalsOf(Dec);
    if (decimals < 0) return badDecimals(task);
    return lib::give(task, result, lib::truncNum(Val, decimals));
}
Status rt_TruncDnum(TaskCore* task, double* result, double Val, const float* Dec) {
    const int decimals = decimalsOf(Dec);
    if (decimals < 0) return badDecimals(task);
    return lib::give(task, result, lib::truncDnum(Val, decimals));
}

Status rt_Sqrt(TaskCore* task, float* result, float Value) {
    if (Value < 0)
        return lib::fail(task, err::ERR_NEGARG, "the square root of a negative number has no value");
    *result = std::sqrt(Value);
    return kOk;
}
Status rt_SqrtDnum(TaskCore* task, double* result, double Value) {
    if (Value < 0)
        return lib::fail(task, err::ERR_NEGARG, "the square root of a negative number has no value");
    *result = std::sqrt(Value);
    return kOk;
}

Status rt_Exp(TaskCore* task, float* result, float Exponent) {
    return lib::give(task, result, static_cast<float>(std::exp(static_cast<double>(Exponent))));
}
Status rt_Pow(TaskCore* task, float* result, float Base, float Exponent) {
    double value = 0;
    if (const Status status = power(task, Base, Exponent, value)) return status;
    return lib::give(task, result, static_cast<float>(value));
}
Status rt_PowDnum(TaskCore* task, double* result, double Base, float Exponent) {
    double value = 0;
    if (const Status status = power(task, Base, Exponent, value)) return status;
    return lib::give(task, result, value);
}

Status rt_DnumToNum(TaskCore* task, float* result, double Value, bool Integer) {
    if (Integer && std::trunc(Value) != Value)
        return lib::fail(task, err::ERR_INT_NOTVAL, "the value is not a whole number");
    if (Integer && std::fabs(Value) > kNumInteger)
        return lib::fail(task, err::ERR_ARGVALERR, "a num holds whole numbers exactly within +-8388608 only");
    const float value = static_cast<float>(Value);
    if (!std::isfinite(value))
        return lib::fail(task, err::ERR_NUM_LIMIT, "the value is outside the range of num");
    *result = value;
    return kOk;
}

Status rt_Clear(TaskCore*, float* Name, double* Dname) {
    if (Name)
        *Name = 0;
    else
        *Dname = 0;
    return kOk;
}
Status rt_Incr(TaskCore* task, float* Name, double* Dname) {
    return addTo(task, Name, Dname, 1);
}
Status rt_Decr(TaskCore* task, float* Name, double* Dname) {
    return addTo(task, Name, Dname, -1);
}
Status rt_Add(TaskCore* task, float* Name, double* Dname, const float* AddValue, const double* AddDvalue) {
    return addTo(task, Name, Dname, AddValue ? static_cast<double>(*AddValue) : *AddDvalue);
}
}
