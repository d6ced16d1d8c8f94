// Geometry of corners against docs/motion.md, "Path": the figures there are for straight legs.

#include "runtime/motion/route.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace motion;

namespace {

const robot::Kinematics& large() {
    static const robot::Kinematics kinematics(robot::loadRobotModel("IRB 6640-180/2.55").value());
    return kinematics;
}

/// Nearest approach to the point over r sin(a/2): of a cubic with its inner points at 0.757 of the radius, half way.
constexpr double kApproach = (2 + 6 * (1 - 0.757)) / 8;

const JointTarget kStart{{0, 10, 10, 0, 60, 0}, kNoExternalAxes};

/// A route of lines through points given relative to the start, all with this zone.
class Lines {
  public:
    explicit Lines(const ZoneData& zone) : zone_(zone), end_(kStart) {
        origin_ = large().forward(kStart.robax);
    }
    void to(double x, double y, double z, const Quat& turn = {}) {
        MoveCommand command;
        command.kind = MoveKind::Linear;
        command.target.pose = {origin_.pos + Vec3{x, y, z}, origin_.rot * turn};
        command.confL = false;
        auto path = MotionPath::make(large(), end_, command);
        REQUIRE(path.hasValue());
        end_ = path->end();
        Leg leg;
        leg.path = std::make_shared<const MotionPath>(std::move(*path));
        leg.lengths = LengthMap::even(leg.path->curve().length());
        leg.zone = zone_;
        REQUIRE(route.append(std::move(leg), 0).has_value());
    }
    Pose at(double place) const { return large().forward(route.at(place).joints); }
    Vec3 point(double x, double y, double z) const { return origin_.pos + Vec3{x, y, z}; }
    Quat orientation() const { return origin_.rot; }
    Route route;

  private:
    ZoneData zone_;
    JointTarget end_;
    Pose origin_;
};

ZoneData zone(double tcp, double turn) {
    return {false, tcp, turn, turn, 0.1 * turn, turn, 0.1 * turn};
}

double nearest(const Lines& lines, const Vec3& point) {
    double least = 1e300;
    for (double s = 0; s <= lines.route.length(); s += 0.05)
        least = std::min(least, norm(lines.at(s).pos - point));
    return least;
}

} // namespace

TEST_CASE("a corner leaves and joins its legs at the zone radius", "[motion][route]") {
    for (const double radius : {10.0, 20.0, 50.0, 100.0}) {
        Lines lines(zone(radius, 1.5 * radius));
        lines.to(0, 300, 0);
        lines.to(0, 300, 300);
        const double entry = 300 - radius;
        CHECK(norm(lines.at(entry).pos - lines.point(0, entry, 0)) < 1e-6);
        // Just after it the path has left the line, just before it has not.
        CHECK(std::abs(lines.at(entry - 0.5).pos.z - lines.point(0, 0, 0).z) < 1e-6);
        CHECK(lines.at(entry + 0.1 * radius).pos.z - lines.point(0, 0, 0).z > 1e-3 * radius);
        const double exit = lines.route.leg(1).begin;
        CHECK(norm(lines.at(exit).pos - lines.point(0, 300, radius)) < 1e-6);
        CHECK(lines.route.length() == Approx(exit + 300 - radius).margin(1e-9));
    }
}

TEST_CASE("the nearest approach to the point is 0.4323 r sin(a/2)", "[motion][route]") {
    for (const double degrees : {30.0, 90.0, 150.0}) {
        const double angle = degrees * M_PI / 180;
        Lines lines(zone(50, 75));
        lines.to(0, 200, 0);
        lines.to(0, 200 + 200 * std::cos(angle), 200 * std::sin(angle));
        CHECK(nearest(lines, lines.point(0, 200, 0)) ==
              Approx(kApproach * 50 * std::sin(angle / 2)).epsilon(2e-3));
    }
}

TEST_CASE("a zone is cut to half of the shorter neighbouring move", "[motion][route]") {
    Lines lines(zone(200, 300));
    lines.to(0, 100, 0);
    lines.to(0, 100, 300);
    CHECK(lines.route.leg(0).cutEnd == Approx(50));
    CHECK(lines.route.leg(1).cutStart == Approx(50));
    CHECK(nearest(lines, lines.point(0, 100, 0)) ==
          Approx(kApproach * 50 * std::sin(M_PI / 4)).epsilon(2e-3));
}

TEST_CASE("orientation turns evenly outside its own zone and is blended inside", "[motion][route]") {
    // 30 degrees on the first leg, back on the second: the rate changes by 2 * 30 / 200 degrees a mm.
    Lines lines(zone(20, 30));
    const Quat turned = robot::fromAxisAngle({1, 0, 0}, 30);
    lines.to(0, 200, 0, turned);
    lines.to(0, 200, 200);
    const auto angle = [&](double s) { return robot::angleBetween(lines.orientation(), lines.at(s).rot); };
    CHECK(angle(100) == Approx(15).margin(1e-6));
    CHECK(angle(169.9) == Approx(30 * 169.9 / 200).margin(1e-6)); // the zone begins at 170 mm
    CHECK(angle(175) < 30 * 175.0 / 200 - 1e-4);
    // 0.217 times the change of the rate times the radius at the point (docs/motion.md).
    const double deviation = 30 - angle(lines.route.legEnd(0));
    CHECK(deviation == Approx(0.217 * (60.0 / 200) * 30).epsilon(0.06));
    // No jump, and no jump of the rate, where the zone begins and ends.
    double last = angle(150);
    double lastRate = 0;
    for (double s = 150.1; s < lines.route.length() - 20; s += 0.1) {
        const double rate = (angle(s) - last) / 0.1;
        if (s > 150.2) CHECK(std::abs(rate - lastRate) < 0.01);
        lastRate = rate;
        last = angle(s);
    }
}

TEST_CASE("places count from the programmed points, also inside a corner", "[motion][route]") {
    Lines lines(zone(50, 75));
    lines.to(0, 200, 0);
    lines.to(0, 200, 200);
    const Route& route = lines.route;
    CHECK(route.placeBeforeEnd(0, 80) == Approx(120));
    CHECK(route.placeBeforeEnd(0, 0) == Approx(route.legEnd(0)));
    CHECK(route.placeAfterStart(1, 0) == Approx(route.legStart(1)));
    CHECK(route.legEnd(0) == Approx(route.legStart(1)));
    CHECK(norm(lines.at(route.placeAfterStart(1, 60)).pos - lines.point(0, 200, 60)) < 1e-6);
    CHECK(route.legAt(route.legEnd(0) - 1) == 0);
    CHECK(route.legAt(route.legEnd(0) + 1) == 1);
    // A place 20 mm before the point, inside the corner, lies on the curve before its middle.
    const double inside = route.placeBeforeEnd(0, 20);
    CHECK(inside > 150);
    CHECK(inside < route.legEnd(0));
    CHECK(norm(lines.at(route.legEnd(0)).pos - lines.point(0, 200, 0)) ==
          Approx(kApproach * 50 * std::sin(M_PI / 4)).epsilon(1e-3));
}

TEST_CASE("a corner that would change what is fixed is not made", "[motion][route]") {
    Lines lines(zone(50, 75));
    lines.to(0, 200, 0);
    const double length = lines.route.length();
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.confL = false;
    const JointTarget end = lines.route.leg(0).path->end();
    command.target.pose = large().forward(end.robax);
    command.target.pose.pos.z += 200;
    auto path = MotionPath::make(large(), end, command);
    REQUIRE(path.hasValue());
    Leg leg;
    leg.path = std::make_shared<const MotionPath>(std::move(*path));
    leg.lengths = LengthMap::even(200);
    CHECK_FALSE(lines.route.append(leg, 160).has_value()); // the zone begins at 150 mm
    CHECK(lines.route.length() == length);
    CHECK(lines.route.legCount() == 1);
    const auto changed = lines.route.append(leg, 140); // the zone of orientation is not needed
    REQUIRE(changed.has_value());
    CHECK(*changed == Approx(150));
}
