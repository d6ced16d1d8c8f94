// Mathematics, bits and geometry: manual 1.15.

#include "natives/bits.h"
#include "natives/math.h"
#include "stdlib/impl/math/angles.h"
#include "stdlib/impl/math/rounding.h"
#include "stdlib_constants.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace rt;

TEST_CASE("trigonometry is exact at multiples of 90 degrees", "[stdlib][math]") {
    for (int turn = -2; turn <= 2; ++turn) {
        const double base = 360.0 * turn;
        CHECK(lib::sinDeg(base) == 0);
        CHECK(lib::sinDeg(base + 90) == 1);
        CHECK(lib::sinDeg(base + 180) == 0);
        CHECK(lib::sinDeg(base + 270) == -1);
        CHECK(lib::cosDeg(base) == 1);
        CHECK(lib::cosDeg(base + 90) == 0);
        CHECK(lib::cosDeg(base + 180) == -1);
        CHECK(lib::cosDeg(base + 270) == 0);
        CHECK(lib::tanDeg(base + 180) == 0);
    }
    CHECK(lib::sinDeg(30) == Approx(0.5).epsilon(1e-15));
    CHECK(lib::cosDeg(120) == Approx(-0.5).epsilon(1e-15));
    CHECK(lib::sinDeg(-135) == Approx(-std::sqrt(0.5)).epsilon(1e-15));
    CHECK(lib::tanDeg(135) == Approx(-1).epsilon(1e-15));
    CHECK(lib::tanDeg(90) > 1e16);
    CHECK(rt_Sin(30) == 0.5F);
    CHECK(rt_ATan2(1, -1) == 135.0F);
    CHECK(rt_ATan2(0, 0) == 0.0F);
    CHECK(rt_ATan(-1) == -45.0F);
}

TEST_CASE("sines are those of the mathematical library, whatever the size of the angle", "[stdlib][math]") {
    constexpr long double kTurn = 3.14159265358979323846264338327950288L / 180;
    constexpr double kUlp = 2.3e-16; // below 2 ulp of the largest sine
    for (double angle = -725.0625; angle < 725; angle += 0.8125) {
        CHECK(std::abs(lib::sinDeg(angle) - static_cast<double>(std::sin(angle * kTurn))) < kUlp);
        CHECK(std::abs(lib::cosDeg(angle) - static_cast<double>(std::cos(angle * kTurn))) < kUlp);
    }
    CHECK(lib::sinDeg(3.6e15 + 30) == lib::sinDeg(30)); // whole turns, beyond the range of the fast reduction
    CHECK(lib::cosDeg(-3.6e15 - 90) == 0);
    for (const double zero :
         {lib::sinDeg(180), lib::sinDeg(-180), lib::cosDeg(90), lib::cosDeg(270), lib::sinDeg(-0.0)})
        CHECK_FALSE(std::signbit(zero)); // would be printed as -0
}

TEST_CASE("arcs of num are correct to the last digit", "[stdlib][math]") {
    constexpr long double kTurn = 3.14159265358979323846264338327950288L / 180;
    const auto near = [](float angle, long double radians) {
        return std::abs(static_cast<long double>(angle) - radians / kTurn) <=
               0.500001L * std::abs(std::nextafter(angle, 1e9F) - angle);
    };
    for (float value = -1; value <= 1; value += 1 / 64.0F) {
        float arc = 0;
        REQUIRE(rt_ASin(nullptr, &arc, value) == kOk);
        CHECK(near(arc, std::asin(static_cast<long double>(value))));
        REQUIRE(rt_ACos(nullptr, &arc, value) == kOk);
        CHECK(near(arc, std::acos(static_cast<long double>(value))));
        CHECK(near(rt_ATan(value * 1000), std::atan(1000.0L * value)));
        CHECK(near(rt_ATan2(value, -0.375F), std::atan2(static_cast<long double>(value), -0.375L)));
    }
    CHECK(rt_ATan(3e38F) == 90);
    CHECK(rt_ATan2(-3e38F, -3e38F) == -135);
}

TEST_CASE("arc functions refuse arguments outside -1 to 1", "[stdlib][math]") {
    float angle = 7;
    CHECK(rt_ACos(nullptr, &angle, 0.5F) == kOk);
    CHECK(angle == Approx(60).epsilon(1e-6));
    CHECK(rt_ASin(nullptr, &angle, 1) == kOk);
    CHECK(angle == 90);
    CHECK(rt_ACos(nullptr, &angle, 1.001F) == err::ERR_ARGVALERR);
    CHECK(rt_ASin(nullptr, &angle, std::numeric_limits<float>::quiet_NaN()) == err::ERR_ARGVALERR);
    CHECK(angle == 90);
}

TEST_CASE("halves are rounded away from zero", "[stdlib][math]") {
    CHECK(lib::roundNum(2.5F, 0) == 3);
    CHECK(lib::roundNum(-2.5F, 0) == -3);
    CHECK(lib::roundNum(2.4F, 0) == 2);
    CHECK(lib::roundNum(0.3852138F, 3) == 0.385F);
    CHECK(lib::roundDnum(123456789.125, 2) == 123456789.13);
    CHECK(lib::truncNum(-2.9F, 0) == -2);
    CHECK(lib::truncNum(0.29F, 2) == 0.29F); // although binary32 holds less than 0.29
    CHECK(lib::truncDnum(0.3899, 2) == 0.38);
    CHECK(lib::roundNum(1234567.0F, 6) == 1234567.0F); // more decimals than there are: nothing changes
    CHECK(lib::roundNum(3e38F, 6) == 3e38F);
    float out = 0;
    const float negative = -1;
    CHECK(rt_Round(nullptr, &out, 1, &negative) == err::ERR_ARGVALERR);
}

TEST_CASE("powers and roots", "[stdlib][math]") {
    float out = 0;
    CHECK(rt_Pow(nullptr, &out, 2, 10) == kOk);
    CHECK(out == 1024);
    CHECK(rt_Pow(nullptr, &out, -2, 3) == kOk);
    CHECK(out == -8);
    CHECK(rt_Pow(nullptr, &out, -2, 0.5F) == err::ERR_NEGARG);
    CHECK(rt_Pow(nullptr, &out, 0, -1) == err::ERR_OVERFLOW);
    CHECK(rt_Pow(nullptr, &out, 10, 39) == err::ERR_OVERFLOW); // binary32 ends at 3.4E38
    double wide = 0;
    CHECK(rt_PowDnum(nullptr, &wide, 10, 39) == kOk);
    CHECK(wide == Approx(1e39));
    CHECK(rt_Exp(nullptr, &out, 89) == err::ERR_OVERFLOW); // e^89 = 4.5E38
    CHECK(rt_Sqrt(nullptr, &out, 144) == kOk);
    CHECK(out == 12);
    CHECK(rt_Sqrt(nullptr, &out, -1) == err::ERR_NEGARG);
}

TEST_CASE("numeric variables of both types", "[stdlib][math]") {
    float num = 5;
    double dnum = 3e9;
    const float three = 3;
    CHECK(rt_Incr(nullptr, &num, nullptr) == kOk);
    CHECK(num == 6);
    CHECK(rt_Decr(nullptr, nullptr, &dnum) == kOk);
    CHECK(dnum == 2999999999.0);
    CHECK(rt_Add(nullptr, &num, nullptr, &three, nullptr) == kOk);
    CHECK(num == 9);
    const double huge = 1e39;
    CHECK(rt_Add(nullptr, &num, nullptr, nullptr, &huge) == err::ERR_NUM_LIMIT);
    CHECK(num == 9);
    CHECK(rt_Clear(nullptr, nullptr, &dnum) == kOk);
    CHECK(dnum == 0);
}

TEST_CASE("dnum to num", "[stdlib][math]") {
    float out = 0;
    CHECK(rt_DnumToNum(nullptr, &out, 3.5, false) == kOk);
    CHECK(out == 3.5F);
    CHECK(rt_DnumToNum(nullptr, &out, 3.5, true) == err::ERR_INT_NOTVAL);
    CHECK(rt_DnumToNum(nullptr, &out, 8388608, true) == kOk);
    CHECK(rt_DnumToNum(nullptr, &out, 8388609, true) == err::ERR_ARGVALERR);
    CHECK(rt_DnumToNum(nullptr, &out, 1e39, false) == err::ERR_NUM_LIMIT);
}

TEST_CASE("bits of a byte", "[stdlib][bits]") {
    float out = 0;
    CHECK(rt_BitAnd(nullptr, &out, 38, 34) == kOk);
    CHECK(out == 34);
    CHECK(rt_BitNeg(nullptr, &out, 38) == kOk);
    CHECK(out == 217);
    CHECK(rt_BitLSh(nullptr, &out, 38, 3) == kOk); // 304: the ninth bit is lost
    CHECK(out == 48);
    CHECK(rt_BitRSh(nullptr, &out, 130, 3) == kOk);
    CHECK(out == 16);
    for (const float bad : {-1.0F, 256.0F, 1.5F})
        CHECK(rt_BitNeg(nullptr, &out, bad) == err::ERR_ARGVALERR);
    CHECK(rt_BitLSh(nullptr, &out, 1, 0) == err::ERR_ARGVALERR);
    CHECK(rt_BitLSh(nullptr, &out, 1, 9) == err::ERR_ARGVALERR);
    bool bit = false;
    CHECK(rt_BitCheck(nullptr, &bit, 130, 8) == kOk);
    CHECK(bit);
    CHECK(rt_BitCheck(nullptr, &bit, 130, 9) == err::ERR_ARGVALERR);
    float data = 2;
    CHECK(rt_BitSet(nullptr, &data, nullptr, 8) == kOk);
    CHECK(data == 130);
    CHECK(rt_BitClear(nullptr, &data, nullptr, 2) == kOk);
    CHECK(data == 128);
}

TEST_CASE("bits of a dnum", "[stdlib][bits]") {
    double out = 0;
    CHECK(rt_BitOrDnum(nullptr, &out, 4294967296.0, 1) == kOk);
    CHECK(out == 4294967297.0);
    CHECK(rt_BitNegDnum(nullptr, &out, 0, nullptr) == kOk);
    CHECK(out == 4503599627370495.0);
    const float four = 4;
    CHECK(rt_BitNegDnum(nullptr, &out, 5, &four) == kOk);
    CHECK(out == 10);
    CHECK(rt_BitLShDnum(nullptr, &out, 9, 1, &four) == kOk); // 1001 -> (1)0010
    CHECK(out == 2);
    CHECK(rt_BitLShDnum(nullptr, &out, 1, 52, nullptr) == kOk);
    CHECK(out == 0);
    CHECK(rt_BitAndDnum(nullptr, &out, 4503599627370496.0, 1) == err::ERR_ARGVALERR);
}

TEST_CASE("orientations from and to Euler angles", "[stdlib][geometry]") {
    data::Orient q{};
    REQUIRE(rt_OrientZYX(nullptr, &q, 90, 0, 0) == kOk); // half angle 45 degrees about z
    CHECK(q.q1 == Approx(std::sqrt(0.5)));
    CHECK(q.q2 == 0);
    CHECK(q.q4 == Approx(std::sqrt(0.5)));
    REQUIRE(rt_OrientZYX(nullptr, &q, 30, 20, 10) == kOk);
    const float expected[] = {10, 20, 30};
    for (int axis = 0; axis < 3; ++axis) {
        float angle = 0;
        REQUIRE(rt_EulerZYX(nullptr, &angle, axis == 0, axis == 1, axis == 2, &q) == kOk);
        CHECK(angle == Approx(expected[axis]).epsilon(1e-5)); // binary32 components
    }
    float angle = 0;
    CHECK(rt_EulerZYX(nullptr, &angle, false, false, false, &q) == err::ERR_ARGVALERR);
    const data::Orient twice{2, 0, 0, 0};
    CHECK(rt_NOrient(nullptr, &q, &twice) == kOk);
    CHECK(q.q1 == 1);
    const data::Orient none{0, 0, 0, 0};
    CHECK(rt_NOrient(nullptr, &q, &none) == err::ERR_ILLQUAT);
}

TEST_CASE("coordinate systems", "[stdlib][geometry]") {
    data::Pose turn{{1, 2, 3}, {}};
    REQUIRE(rt_OrientZYX(nullptr, &turn.rot, 90, 0, 0) == kOk); // x of the frame points along y
    const data::Pos unit{1, 0, 0};
    data::Pos out{};
    REQUIRE(rt_PoseVect(nullptr, &out, &turn, &unit) == kOk);
    CHECK(out.x == Approx(1));
    CHECK(out.y == Approx(3));
    CHECK(out.z == Approx(3));
    data::Pose inverse{};
    REQUIRE(rt_PoseInv(nullptr, &inverse, &turn) == kOk);
    CHECK(inverse.trans.x == Approx(-2));
    CHECK(inverse.trans.y == Approx(1));
    CHECK(inverse.trans.z == Approx(-3));
    data::Pose one{};
    REQUIRE(rt_PoseMult(nullptr, &one, &turn, &inverse) == kOk);
    CHECK(one.trans.x == Approx(0).margin(1e-6));
    CHECK(one.rot.q1 == Approx(1));
    const data::Pos a{1, 2, 3};
    const data::Pos b{4, 5, 6};
    float dot = 0;
    REQUIRE(rt_DotProd(nullptr, &dot, &a, &b) == kOk);
    CHECK(dot == 32);
    REQUIRE(rt_CrossProd(nullptr, &out, &a, &b) == kOk);
    CHECK((out.x == -3 && out.y == 6 && out.z == -3));
}
