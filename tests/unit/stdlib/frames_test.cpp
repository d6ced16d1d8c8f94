// Coordinate systems from positions, matrices and fitting: manual 1.7, 1.15.

#include "natives/math.h"
#include "natives/matrix.h"
#include "natives/motion_settings.h"
#include "natives/positions.h"
#include "stdlib_constants.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rt;

namespace {

data::Robtarget at(float x, float y, float z) {
    data::Robtarget target{};
    target.trans = {x, y, z};
    target.rot = {1, 0, 0, 0};
    return target;
}

void checkPos(const data::Pos& p, double x, double y, double z, double margin = 1e-4) {
    CHECK(p.x == Approx(x).margin(margin));
    CHECK(p.y == Approx(y).margin(margin));
    CHECK(p.z == Approx(z).margin(margin));
}

data::Pos inFrame(const data::Pose& frame, float x, float y, float z) {
    const data::Pos p{x, y, z};
    data::Pos out{};
    REQUIRE(rt_PoseVect(nullptr, &out, &frame, &p) == kOk);
    return out;
}

} // namespace

TEST_CASE("DefFrame puts the origin where asked", "[stdlib][frames]") {
    // x of the frame along world y, the third point on its positive y side: that is world -x
    const data::Robtarget p1 = at(10, 0, 5);
    const data::Robtarget p2 = at(10, 100, 5);
    const data::Robtarget p3 = at(-20, 40, 5);
    data::Pose frame{};
    REQUIRE(rt_DefFrame(nullptr, &frame, &p1, &p2, &p3, nullptr) == kOk);
    checkPos(frame.trans, 10, 0, 5);
    checkPos(inFrame(frame, 1, 0, 0), 10, 1, 5);
    checkPos(inFrame(frame, 0, 1, 0), 9, 0, 5);
    checkPos(inFrame(frame, 0, 0, 1), 10, 0, 6);
    float origin = 2;
    REQUIRE(rt_DefFrame(nullptr, &frame, &p1, &p2, &p3, &origin) == kOk);
    checkPos(frame.trans, 10, 100, 5);
    origin = 3; // on the line p1-p2, so that the y axis goes through p3
    REQUIRE(rt_DefFrame(nullptr, &frame, &p1, &p2, &p3, &origin) == kOk);
    checkPos(frame.trans, 10, 40, 5);
    checkPos(inFrame(frame, 0, 30, 0), -20, 40, 5);
    origin = 4;
    CHECK(rt_DefFrame(nullptr, &frame, &p1, &p2, &p3, &origin) == err::ERR_FRAME);
    const data::Robtarget onLine = at(10, 50, 5);
    CHECK(rt_DefFrame(nullptr, &frame, &p1, &p2, &onLine, nullptr) == err::ERR_FRAME);
}

TEST_CASE("DefDFrame is the displacement from old to new", "[stdlib][frames]") {
    const data::Robtarget a = at(0, 0, 0);
    const data::Robtarget b = at(100, 0, 0);
    const data::Robtarget c = at(0, 100, 0);
    const data::Robtarget a2 = at(10, 20, 30); // turned 90 degrees about z and shifted
    const data::Robtarget b2 = at(10, 120, 30);
    const data::Robtarget c2 = at(-90, 20, 30);
    data::Pose d{};
    REQUIRE(rt_DefDFrame(nullptr, &d, &a, &b, &c, &a2, &b2, &c2) == kOk);
    checkPos(inFrame(d, 50, 7, 3), 10 - 7, 20 + 50, 33);
}

TEST_CASE("DefAccFrame fits and reports what is left", "[stdlib][frames]") {
    const data::Robtarget one[] = {at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(0, 0, 100)};
    const data::Robtarget two[] = {at(10, 20, 30), at(10, 120, 30), at(-90, 20, 30), at(10, 20, 130)};
    data::Pose frame{};
    float maxErr = -1;
    float meanErr = -1;
    REQUIRE(rt_DefAccFrame(nullptr, &frame, one, 4, two, 4, 4, &maxErr, &meanErr) == kOk);
    checkPos(inFrame(frame, 50, 7, 3), 3, 70, 33);
    CHECK(maxErr == Approx(0).margin(1e-4));
    CHECK(meanErr == Approx(0).margin(1e-4));
    CHECK(rt_DefAccFrame(nullptr, &frame, one, 4, two, 4, 2, &maxErr, &meanErr) == err::ERR_FRAME);
    CHECK(rt_DefAccFrame(nullptr, &frame, one, 4, two, 3, 4, &maxErr, &meanErr) == err::ERR_FRAME);
    const data::Robtarget same[] = {at(1, 1, 1), at(1, 1, 1), at(1, 1, 1)};
    CHECK(rt_DefAccFrame(nullptr, &frame, same, 3, same, 3, 3, &maxErr, &meanErr) == err::ERR_FRAME);
}

TEST_CASE("MirPos mirrors in the xy plane of the work object", "[stdlib][frames]") {
    // A mirror standing upright: its z axis points along world x (turned 90 degrees about y), 100 mm in front.
    const float h = std::sqrt(0.5F);
    const data::Wobjdata mirror{false, true, {}, {{100, 0, 0}, {h, 0, h, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    const data::Robtarget point = at(130, 20, 5);
    data::Robtarget image{};
    REQUIRE(rt_MirPos(nullptr, &image, &point, &mirror, nullptr, false) == kOk);
    checkPos(image.trans, 70, 20, 5);
    // tool x (world x) turns round, z stays, so y turns round: half a turn about z
    CHECK(std::fabs(image.rot.q4) == Approx(1).epsilon(1e-5));
    data::Robtarget again{};
    REQUIRE(rt_MirPos(nullptr, &again, &image, &mirror, nullptr, false) == kOk);
    checkPos(again.trans, 130, 20, 5);
    REQUIRE(rt_MirPos(nullptr, &image, &point, &mirror, nullptr, true) == kOk);
    CHECK(std::fabs(image.rot.q1) == Approx(1).epsilon(1e-5)); // y and z stay, x follows from them
}

TEST_CASE("matrices of fitting dimensions only", "[stdlib][matrix]") {
    const double a[] = {1, 2, 3, 4, 5, 6}; // 2 x 3
    const double b[] = {1, 0, 2, 0, 1, 1}; // 3 x 2
    double c[4] = {};
    REQUIRE(rt_MatrixMult(nullptr, a, 2, 3, b, 3, 2, nullptr, c, 2, 2) == kOk);
    CHECK(c[0] == 1 * 1 + 2 * 2 + 3 * 1);
    CHECK(c[1] == 3);
    CHECK(c[2] == 4 + 10 + 6);
    CHECK(c[3] == 6);
    CHECK(rt_MatrixMult(nullptr, a, 2, 3, a, 2, 3, nullptr, c, 2, 2) == err::ERR_ARRAY_SIZE);
    double scaled[6] = {};
    const double two = 2;
    REQUIRE(rt_MatrixMult(nullptr, a, 2, 3, nullptr, 0, 0, &two, scaled, 2, 3) == kOk);
    CHECK(scaled[5] == 12);
    double t[6] = {};
    REQUIRE(rt_MatrixTranspose(nullptr, a, 2, 3, t, 3, 2) == kOk);
    CHECK(t[1] == 4);
    double sum[6] = {};
    REQUIRE(rt_MatrixAdd(nullptr, a, 2, 3, a, 2, 3, sum, 2, 3) == kOk);
    CHECK(sum[4] == 10);
}

TEST_CASE("inverse and linear equations", "[stdlib][matrix]") {
    double m[] = {2, 1, 1, 1};
    REQUIRE(rt_MatrixInverse(nullptr, m, 2, 2, m, 2, 2) == kOk); // in place
    CHECK(m[0] == Approx(1));
    CHECK(m[1] == Approx(-1));
    CHECK(m[3] == Approx(2));
    const double flat[] = {1, 2, 2, 4};
    CHECK(rt_MatrixInverse(nullptr, flat, 2, 2, m, 2, 2) == err::ERR_ARGVALERR);
    const double a[] = {2, 1, 1, 3};
    const double rhs[] = {5, 10};
    double x[2] = {};
    REQUIRE(rt_MatrixSolve(nullptr, a, 2, 2, nullptr, nullptr, rhs, 2, x, 2) == kOk);
    CHECK(x[0] == Approx(1)); // 2 + 3 = 5, 1 + 9 = 10
    CHECK(x[1] == Approx(3));
    CHECK(rt_MatrixSolve(nullptr, flat, 2, 2, nullptr, nullptr, rhs, 2, x, 2) == err::ERR_ARGVALERR);
    double q[4] = {};
    double r[4] = {};
    REQUIRE(rt_MatrixSolveQR(nullptr, a, 2, 2, nullptr, nullptr, q, 2, 2, r, 2, 2) == kOk);
    CHECK(r[2] == 0);
    CHECK(q[0] * r[0] == Approx(2)); // first column of Q*R
    CHECK(q[2] * r[0] == Approx(1));
    const double d[] = {3, 0, 0, 4};
    double u[4], s[2], v[4];
    REQUIRE(rt_MatrixSVD(nullptr, d, 2, 2, nullptr, nullptr, u, 2, 2, s, 2, v, 2, 2, false) == kOk);
    CHECK(s[0] == Approx(4));
    CHECK(s[1] == Approx(3));
}

TEST_CASE("fitting finds exact shapes exactly", "[stdlib][matrix]") {
    data::Pos point{};
    data::Pos direction{};
    float rms = -1;
    float maxErr = -1;
    float worst = -1;
    const data::Pos line[] = {{0, 0, 1}, {10, 0, 1}, {30, 0, 1}};
    REQUIRE(rt_FitLine(nullptr, nullptr, 0, 0, line, 3, nullptr, &point, &direction, &rms, &maxErr, &worst) ==
            kOk);
    checkPos(direction, 1, 0, 0);
    CHECK(maxErr == Approx(0).margin(1e-5));
    // Circle of radius 5 about (1, 2, 3) in the plane z = 3, and one point 1 mm off it
    const data::Pos circle[] = {{6, 2, 3}, {-4, 2, 3}, {1, 7, 3}, {1, -3, 3}};
    data::Pos centre{};
    float radius = 0;
    REQUIRE(rt_FitCircle(nullptr, nullptr, 0, 0, circle, 4, nullptr, &centre, &radius, &direction, &rms,
                         &maxErr, &worst) == kOk);
    checkPos(centre, 1, 2, 3);
    CHECK(radius == Approx(5));
    checkPos(direction, 0, 0, 1);
    const double sphere[] = {4, 0, 0, -2, 0, 0, 1, 3, 0, 1, -3, 0, 1, 0, 3}; // radius 3 about (1, 0, 0)
    REQUIRE(rt_FitSphere(nullptr, sphere, 5, 3, nullptr, 0, nullptr, &centre, &radius, &rms, &maxErr,
                         &worst) == kOk);
    checkPos(centre, 1, 0, 0);
    CHECK(radius == Approx(3));
    const data::Pos plane[] = {{0, 0, 7}, {10, 0, 7}, {0, 10, 7}, {10, 10, 7}};
    REQUIRE(rt_FitPlane(nullptr, nullptr, 0, 0, plane, 4, nullptr, &point, &direction, &rms, &maxErr,
                        &worst) == kOk);
    checkPos(direction, 0, 0, 1);
    checkPos(point, 5, 5, 7);
    CHECK(rt_FitPlane(nullptr, nullptr, 0, 0, line, 3, nullptr, &point, &direction, &rms, &maxErr, &worst) ==
          err::ERR_ARGVALERR);
    CHECK(rt_FitPlane(nullptr, nullptr, 0, 0, plane, 2, nullptr, &point, &direction, &rms, &maxErr, &worst) ==
          err::ERR_ARRAY_SIZE);
}
