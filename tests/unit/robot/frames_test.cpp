// Frames: the algebra that poses must obey, and RAPID's Offs, RelTool and Euler angles.

#include "runtime/robot/frames.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace robot;

namespace {

std::mt19937_64 generator(21);

double draw(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
}

Pose randomPose() {
    const Quat q = normalized({draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)});
    return {{draw(-500, 500), draw(-500, 500), draw(-500, 500)}, q};
}

void checkSame(const Vec3& a, const Vec3& b) {
    CHECK(a.x == Approx(b.x).margin(1e-9));
    CHECK(a.y == Approx(b.y).margin(1e-9));
    CHECK(a.z == Approx(b.z).margin(1e-9));
}

} // namespace

TEST_CASE("composition applies the right frame first", "[robot][frames]") {
    for (int n = 0; n < 200; ++n) {
        const Pose a = randomPose();
        const Pose b = randomPose();
        const Vec3 p{draw(-9, 9), draw(-9, 9), draw(-9, 9)};
        checkSame(apply(a * b, p), apply(a, apply(b, p)));
        checkSame(apply(inverse(a), apply(a, p)), p);
        checkSame((inverse(a) * a).pos, {});
        CHECK(angleBetween((inverse(a) * a).rot, {}) < 1e-9);
    }
}

TEST_CASE("slerp turns evenly and the short way", "[robot][frames]") {
    for (int n = 0; n < 200; ++n) {
        const Quat a = randomPose().rot;
        const Quat b = randomPose().rot;
        const double whole = angleBetween(a, b);
        CHECK(whole <= 180.0 + 1e-9);
        CHECK(angleBetween(a, slerp(a, b, 0.3)) == Approx(0.3 * whole).margin(1e-9));
        CHECK(angleBetween(slerp(a, b, 0.3), b) == Approx(0.7 * whole).margin(1e-9));
        CHECK(angleBetween(slerp(a, b, 1), b) < 1e-9);
    }
    const Quat same{0.6, 0.8, 0, 0};
    CHECK(slerp(same, same, 0.5) == same);
}

TEST_CASE("Euler angles come back", "[robot][frames]") {
    for (int n = 0; n < 200; ++n) {
        const double z = draw(-179, 179);
        const double y = draw(-89, 89);
        const double x = draw(-179, 179);
        checkSame(eulerZyx(fromEulerZyx(z, y, x)), {x, y, z});
    }
    for (double y : {90.0, -90.0}) {
        const Quat upright = fromEulerZyx(40, y, 0);
        const Vec3 angles = eulerZyx(upright);
        CHECK(angleBetween(fromEulerZyx(angles.z, angles.y, angles.x), upright) < 1e-6);
    }
    // 90 degrees about z carries x to y.
    checkSame(rotate(fromEulerZyx(90, 0, 0), {1, 0, 0}), {0, 1, 0});
}

TEST_CASE("Offs moves in the frame, RelTool along the tool", "[robot][frames]") {
    const Pose down{{600, 0, 400}, {0, 0, 1, 0}}; // half a turn about y: tool z points down
    checkSame(offs(down, 0, 0, 10).pos, {600, 0, 410});
    checkSame(relTool(down, 0, 0, 10, 0, 0, 0).pos, {600, 0, 390});
    const Pose turned = relTool(down, 0, 0, 0, 0, 0, 25);
    checkSame(turned.pos, down.pos);
    CHECK(angleBetween(turned.rot, down.rot) == Approx(25));
    // First about x, then about the new y: x forward goes where y then takes it.
    const Quat both = relTool({}, 0, 0, 0, 90, 90, 0).rot;
    checkSame(rotate(both, {1, 0, 0}), {0, 1, 0});
}

TEST_CASE("a quaternion of no length becomes the identity", "[robot][frames]") {
    CHECK(normalized({0, 0, 0, 0}) == Quat{});
    CHECK(norm(normalized({2, 1, 0, -4})) == Approx(1));
}
