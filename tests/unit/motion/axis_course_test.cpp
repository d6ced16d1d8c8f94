// AxisCourse: an axis that moves for itself keeps to speed and acceleration and arrives exactly.

#include "runtime/motion/axis_course.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace motion;

TEST_CASE("an independent axis accelerates, keeps its speed and arrives", "[motion]") {
    const AxisCourse course = AxisCourse(1, {10, 0}).movedTo(1, 110, 50, 100);
    // 0.5 s and 12.5 deg at each end, 75 deg at 50 deg/s between
    CHECK(course.settledAt() == Approx(1 + 0.5 + 1.5 + 0.5));
    CHECK(course.at(0.5).position == 10);
    CHECK(course.at(1.5).position == Approx(22.5));
    CHECK(course.at(2).speed == Approx(50));
    CHECK(course.at(9).position == 110);
    CHECK(course.at(9).speed == 0);
}

TEST_CASE("a short way of an independent axis does not reach the speed", "[motion]") {
    const AxisCourse course = AxisCourse(0, {0, 0}).movedTo(0, -1, 50, 100);
    CHECK(course.settledAt() == Approx(0.2));
    CHECK(course.at(0.1).speed == Approx(-10));
    CHECK(course.at(1).position == -1);
}

TEST_CASE("an independent axis turns for ever and comes to rest", "[motion]") {
    const AxisCourse turning = AxisCourse(0, {0, 0}).turning(0, -30, 60);
    CHECK(turning.at(100).position == Approx(-7.5 - 30 * 99.5));
    const AxisCourse resting = turning.turning(10, 0, 60);
    CHECK(resting.settledAt() == Approx(10.5));
    CHECK(resting.at(20).speed == 0);
    CHECK(resting.at(20).position == Approx(turning.at(10).position - 7.5));
}

TEST_CASE("a replaced movement of an independent axis continues without jumps", "[motion]") {
    std::mt19937 random(7); // NOLINT: the same numbers each time
    std::uniform_real_distribution<double> angle(-400, 400), speed(1, 200), span(0.01, 3);
    AxisCourse course(0, {0, 0});
    double time = 0;
    for (int i = 0; i < 40; ++i) {
        const double goal = angle(random);
        const AxisMoment before = course.at(time);
        const AxisCourse next = course.movedTo(time, goal, speed(random), 150);
        CHECK(next.at(time).position == Approx(before.position).margin(1e-9));
        CHECK(next.at(time).speed == Approx(before.speed).margin(1e-9));
        CHECK(next.at(next.settledAt() + 1).position == goal);
        AxisMoment last = next.at(time);
        for (double t = time + 0.001; t < next.settledAt() + 0.01; t += 0.001) {
            const AxisMoment moment = next.at(t);
            CHECK(std::fabs(moment.speed - last.speed) < 150 * 0.001 + 1e-6);
            CHECK(std::fabs(moment.position - last.position) < 0.001 * (std::fabs(last.speed) + 1));
            last = moment;
        }
        course = next;
        time += span(random);
    }
}
