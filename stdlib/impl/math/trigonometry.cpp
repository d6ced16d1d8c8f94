// Manual 1.15: angles in degrees.

#include "runtime/robot/angles.h"
#include "stdlib/impl/math/angles.h"
#include "stdlib/impl/support/fail.h"

#include "natives/math.h"
#include "stdlib_constants.h"

#include <cmath>
#include <numbers>
#include <utility>

using namespace rt;

namespace rt::lib {

namespace {

constexpr double kTangentPole = 1.633123935319537e16; // tan(pi/2) of binary64

/// Rest within +-45 degrees, and the quadrant 0..3 it belongs to. Both ways are exact: the product has few digits, and the two
/// numbers subtracted are of one magnitude. remquo is left for large angles and for those half way between two quadrants.
double reduced(double degrees, int& quadrant) {
    constexpr double kUsual = 1e9;
    const double quarters = std::rint(degrees * (1 / 90.0));
    const double usual = degrees - quarters * 90.0;
    if (std::abs(usual) < 45.0 && std::abs(degrees) < kUsual) {
        quadrant = static_cast<int>(quarters) & 3;
        return usual == 0 ? std::copysign(0.0, degrees) : usual;
    }
    int quotient = 0;
    const double rest = std::remquo(degrees, 90.0, &quotient);
    quadrant = quotient & 3;
    return rest;
}

} // namespace

double sinDeg(double degrees) {
    int quadrant = 0;
    const double rest = reduced(degrees, quadrant) * robot::kDeg;
    const double value = quadrant % 2 == 0 ? std::sin(rest) : std::cos(rest);
    return quadrant < 2 ? value : 0.0 - value;
}

double cosDeg(double degrees) {
    int quadrant = 0;
    const double rest = reduced(degrees, quadrant) * robot::kDeg;
    const double value = quadrant % 2 == 0 ? std::cos(rest) : std::sin(rest);
    return quadrant == 0 || quadrant == 3 ? value : 0.0 - value;
}

SineCosine sinCosDeg(double degrees) {
    int quadrant = 0;
    const double rest = reduced(degrees, quadrant) * robot::kDeg;
    double sine = rest, cosine = 1;
    if (rest != 0) ::sincos(rest, &sine, &cosine);
    if (quadrant % 2 != 0) std::swap(sine, cosine);
    return {quadrant < 2 ? sine : 0.0 - sine, quadrant == 0 || quadrant == 3 ? cosine : 0.0 - cosine};
}

double tanDeg(double degrees) {
    int quadrant = 0;
    const double rest = reduced(degrees, quadrant) * robot::kDeg;
    if (quadrant % 2 == 0) return std::tan(rest);
    return rest == 0 ? (quadrant == 1 ? kTangentPole : -kTangentPole) : -1.0 / std::tan(rest);
}

double asinDeg(double value) {
    return std::asin(value) / robot::kDeg;
}
double acosDeg(double value) {
    return std::acos(value) / robot::kDeg;
}
double atanDeg(double value) {
    return std::atan(value) / robot::kDeg;
}
double atan2Deg(double y, double x) {
    return std::atan2(y, x) / robot::kDeg;
}

} // namespace rt::lib

namespace {

bool outsideOne(double value) {
    return !(std::fabs(value) <= 1.0);
}

Status badArc(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     "the argument of an arc sine or arc cosine must lie between -1 and 1");
}

} // namespace

extern "C" {

float rt_Sin(float Angle) {
    return static_cast<float>(lib::sinDeg(Angle));
}
double rt_SinDnum(double Angle) {
    return lib::sinDeg(Angle);
}
float rt_Cos(float Angle) {
    return static_cast<float>(lib::cosDeg(Angle));
}
double rt_CosDnum(double Angle) {
    return lib::cosDeg(Angle);
}
float rt_Tan(float Angle) {
    return static_cast<float>(lib::tanDeg(Angle));
}
double rt_TanDnum(double Angle) {
    return lib::tanDeg(Angle);
}
float rt_ATan(float Value) {
    return static_cast<float>(lib::atanDeg(Value));
}
double rt_ATanDnum(double Value) {
    return lib::atanDeg(Value);
}
float rt_ATan2(float Y, float X) {
    return static_cast<float>(lib::atan2Deg(Y, X));
}
double rt_ATan2Dnum(double Y, double X) {
    return lib::atan2Deg(Y, X);
}

Status rt_ASin(TaskCore* task, float* result, float Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = static_cast<float>(lib::asinDeg(Value));
    return kOk;
}
Status rt_ASinDnum(TaskCore* task, double* result, double Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = lib::asinDeg(Value);
    return kOk;
}
Status rt_ACos(TaskCore* task, float* result, float Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = static_cast<float>(lib::acosDeg(Value));
    return kOk;
}
Status rt_ACosDnum(TaskCore* task, double* result, double Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = lib::acosDeg(Value);
    return kOk;
}
}
