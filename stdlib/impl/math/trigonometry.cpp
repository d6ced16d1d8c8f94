// Manual 1.15: angles in degrees.

#include "runtime/robot/angles.h"
#include "runtime/robot/fast_trig.h"
#include "stdlib/impl/math/angles.h"
#include "stdlib/impl/support/fail.h"

#include "natives/math.h"
#include "stdlib_constants.h"

#include <cmath>

using namespace rt;

namespace rt::lib {

namespace {

constexpr double kTangentPole = 1.633123935319537e16; // tan(pi/2) of binary64

} // namespace

double sinDeg(double degrees) {
    return robot::trig::sinCosDeg(degrees).sine;
}

double cosDeg(double degrees) {
    return robot::trig::sinCosDeg(degrees).cosine;
}

double tanDeg(double degrees) {
    const auto [sine, cosine] = robot::trig::sinCosDeg(degrees);
    return cosine == 0 ? std::copysign(kTangentPole, sine) : sine / cosine;
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
    return static_cast<float>(robot::trig::atan2Deg(Value, 1));
}
double rt_ATanDnum(double Value) {
    return std::atan(Value) / robot::kDeg;
}
float rt_ATan2(float Y, float X) {
    return static_cast<float>(robot::trig::atan2Deg(Y, X));
}
double rt_ATan2Dnum(double Y, double X) {
    return std::atan2(Y, X) / robot::kDeg;
}

Status rt_ASin(TaskCore* task, float* result, float Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = static_cast<float>(robot::trig::asinDeg(Value));
    return kOk;
}
Status rt_ASinDnum(TaskCore* task, double* result, double Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = std::asin(Value) / robot::kDeg;
    return kOk;
}
Status rt_ACos(TaskCore* task, float* result, float Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = static_cast<float>(robot::trig::acosDeg(Value));
    return kOk;
}
Status rt_ACosDnum(TaskCore* task, double* result, double Value) {
    if (outsideOne(Value)) return badArc(task);
    *result = std::acos(Value) / robot::kDeg;
    return kOk;
}
}
