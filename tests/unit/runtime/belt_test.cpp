// The course of a conveyor: constant acceleration between constant speeds, and when it comes to a place.

#include "runtime/host/belt.h"

#include <catch2/catch.hpp>

using namespace rt;

TEST_CASE("belt keeps its speed and changes it with its acceleration", "[conveyor]") {
    Belt belt(100, 1000);
    CHECK(belt.position(2 * kSecond) == Approx(200));
    belt.setSpeed(2 * kSecond, 300); // 0.2 s, 40 mm
    CHECK(belt.speed(2 * kSecond + 100 * kMillisecond) == Approx(200));
    CHECK(belt.position(2 * kSecond + 200 * kMillisecond) == Approx(240));
    CHECK(belt.position(3 * kSecond) == Approx(240 + 0.8 * 300));
    CHECK(belt.position(1 * kSecond) == Approx(100)); // the past stays
}

TEST_CASE("belt says when it comes to a place", "[conveyor]") {
    Belt belt(100, 1000);
    CHECK(belt.whenAt(50, 0) == 500 * kMillisecond);
    CHECK(belt.whenAt(-50, 0) == kNever);
    belt.setSpeed(kSecond, 0); // 0.1 s, 5 mm more
    CHECK(belt.whenAt(104, kSecond) < kSecond + 100 * kMillisecond);
    CHECK(belt.position(belt.whenAt(104, kSecond)) == Approx(104));
    CHECK(belt.whenAt(105.5, kSecond) == kNever);
    belt.setSpeed(2 * kSecond, -100);
    CHECK(belt.position(belt.whenAt(55, 2 * kSecond)) == Approx(55));
    CHECK(belt.target() == -100);
}
