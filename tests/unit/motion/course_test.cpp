// Course against the rules of docs/motion.md, "Time": the plan averaged over two windows.

#include "runtime/motion/course.h"

#include <catch2/catch.hpp>

#include <cmath>

using motion::Course;
using motion::CourseState;

namespace {

constexpr double kLong = 0.108;
constexpr double kShort = 0.048;

/// 600 mm at 1000 mm/s with 5000 mm/s^2: 100 mm up, 400 mm even, 100 mm down.
Course trapezoid(double start = 0) {
    Course course(start, 0, kLong, kShort);
    course.moveTo(100, 1000);
    course.moveTo(500, 1000);
    course.moveTo(600, 0);
    return course;
}

/// The average of the plan over both windows, numerically.
double averaged(const Course& course, double time) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j)
            sum += course.plannedAt(time - kLong * (i + 0.5) / kSteps - kShort * (j + 0.5) / kSteps).s;
    return sum / (kSteps * kSteps);
}

} // namespace

TEST_CASE("the motion is the plan averaged over both windows", "[motion][course]") {
    const Course course = trapezoid();
    CHECK(course.plannedEnd() == Approx(0.2 + 0.4 + 0.2));
    CHECK(course.end() == Approx(course.plannedEnd() + kLong + kShort)); // a piece takes the windows longer
    for (const double time : {0.02, 0.1, 0.17, 0.33, 0.5, 0.75, 0.9, 0.94})
        CHECK(course.at(time).s == Approx(averaged(course, time)).margin(2e-3));
    CHECK(course.at(course.end() - 1e-4).s < 600);
    CHECK(course.at(course.end()).s == 600);
    CHECK(course.at(-1).s == 0);
}

TEST_CASE("speed and acceleration are the derivatives of the place", "[motion][course]") {
    const Course course = trapezoid(10);
    constexpr double kStep = 1e-5;
    for (double time = 10.001; time < course.end(); time += 0.0137) {
        const CourseState at = course.at(time);
        const double before = course.at(time - kStep).s;
        const double after = course.at(time + kStep).s;
        CHECK(at.v == Approx((after - before) / (2 * kStep)).margin(1e-2));
        CHECK(at.a ==
              Approx((course.at(time + kStep).v - course.at(time - kStep).v) / (2 * kStep)).margin(1));
    }
}

TEST_CASE("a ramp has the length and peaks that were measured", "[motion][course]") {
    // Speed 300 mm/s with 12.6 m/s^2: peak acceleration dv / 0.108 s = 2.8 m/s^2, length dv/a + 0.156 s.
    Course course(0, 0, kLong, kShort);
    course.moveTo(300.0 * 300 / (2 * 12600), 300);
    course.moveTo(200, 300);
    double peak = 0;
    for (double time = 0; time < 0.3; time += 1e-4)
        peak = std::max(peak, course.at(time).a);
    CHECK(peak == Approx(300 / kLong).epsilon(1e-3));
    const double length = 300.0 / 12600 + kLong + kShort;
    CHECK(course.at(length - 1e-3).v < 300);
    CHECK(course.at(length + 1e-9).v == Approx(300));
}

TEST_CASE("the time of a place is the inverse of the place at a time", "[motion][course]") {
    const Course course = trapezoid(3);
    for (double place = 0.001; place < 600; place += 7.3)
        CHECK(course.at(course.timeAt(place)).s == Approx(place).margin(1e-6));
    CHECK(course.timeAt(0) == 3);
    CHECK(course.timeAt(600) == course.end());
    CHECK(course.timeAt(700) == course.end());
}

TEST_CASE("replacing the plan leaves what was executed as it was", "[motion][course]") {
    const Course whole = trapezoid();
    Course stopped = trapezoid();
    stopped.cutAfter(0.4);
    const CourseState there = stopped.plannedAt(0.4);
    CHECK(there.v == Approx(1000));
    stopped.moveTo(there.s + 100, 0);
    for (double time = 0; time <= 0.4; time += 0.01)
        CHECK(stopped.at(time).s == Approx(whole.at(time).s).margin(1e-9));
    CHECK(stopped.at(stopped.end()).s == Approx(there.s + 100));
    CHECK(stopped.plannedEnd() == Approx(0.6));
}

TEST_CASE("forgetting the past of a long course changes nothing that follows", "[motion][course]") {
    Course course(0, 0, kLong, kShort);
    course.moveTo(1, 100);
    for (int i = 1; i <= 5000; ++i)
        course.moveTo(1 + i, i % 2 == 0 ? 100 : 80);
    course.moveTo(5010, 0);
    const double now = 0.5 * course.plannedEnd();
    const CourseState before = course.at(now + 1);
    course.forgetBefore(now);
    const CourseState after = course.at(now + 1);
    CHECK(after.s == Approx(before.s).margin(1e-7));
    CHECK(after.v == Approx(before.v).margin(1e-6));
    CHECK(course.at(course.end()).s == Approx(5010).margin(1e-9));
}

TEST_CASE("without the long window the course continues without a step and stops sooner",
          "[motion][course]") {
    // Rule (decision 112): at 1000 mm/s and 5000 mm/s^2 a stop takes v^2 / 2a = 100 mm and v/2 times the windows.
    constexpr double kNow = 0.5, kSpeed = 1000, kBraking = 5000;
    const auto stopped = [](bool isQuick) {
        Course course = trapezoid();
        if (isQuick) course.dropLongWindow(kNow);
        const double from = course.plannedAt(kNow).s;
        course.cutAfter(kNow);
        course.moveTo(from + kSpeed * kSpeed / (2 * kBraking), 0);
        course.rest(0);
        return course;
    };
    const double here = trapezoid().at(kNow).s;
    CHECK(stopped(false).endPlace() - here == Approx(100 + kSpeed / 2 * (kLong + kShort)));
    Course quick = stopped(true);
    CHECK(quick.endPlace() - here == Approx(100 + kSpeed / 2 * kShort));
    CHECK(quick.end() == Approx(kNow + kSpeed / kBraking + kShort));
    CHECK(quick.at(kNow - 0.3).s == trapezoid().at(kNow - 0.3).s);
    CHECK(quick.timeAt(50) == Approx(trapezoid().timeAt(50)));
    constexpr double kStep = 1e-6;
    for (double time = kNow - 0.01; time < quick.end() + 0.01; time += 0.0007) {
        const CourseState before = quick.at(time - kStep);
        const CourseState after = quick.at(time + kStep);
        CHECK(after.s - before.s == Approx(2 * kStep * quick.at(time).v).margin(1e-4));
        CHECK(std::abs(after.v - before.v) < 2 * kStep * 1.01 * kBraking + 1e-2);
        if (time > kNow && time < quick.end())
            CHECK(quick.at(quick.timeAt(quick.at(time).s)).s == Approx(quick.at(time).s));
    }
    // It is executed to its end, whatever follows, and can then be continued with both windows.
    Course next = quick.continued(kNow + 0.01, kLong, kShort);
    next.moveTo(600, 0.5);
    for (double time = kNow - 0.1; time < quick.end(); time += 0.01)
        CHECK(next.at(time).s == quick.at(time).s);
    next.forgetBefore(quick.end());
    CHECK(next.at(quick.end()).s == Approx(quick.endPlace()));
    CHECK(next.at(quick.end() + 0.1).s > quick.endPlace());
}
