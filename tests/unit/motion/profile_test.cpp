// Profiles: limits are kept, the ends are exact, and nothing could be faster.

#include "runtime/motion/profile.h"
#include "runtime/motion/warp.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace motion;

namespace {

struct Peaks {
    double v = 0, a = 0, d = 0, j = 0, least = 0;
    bool isGrowing = true;
    double roughness = 0; // largest jump of v between samples beyond what a allows
};

Peaks peaksOf(const Profile& profile) {
    Peaks peaks;
    constexpr int kSamples = 2000;
    ProfileState last = profile.at(0);
    for (int i = 0; i <= kSamples; ++i) {
        const double time = profile.duration() * i / kSamples;
        const ProfileState state = profile.at(time);
        peaks.v = std::max(peaks.v, state.v);
        peaks.a = std::max(peaks.a, state.a);
        peaks.d = std::max(peaks.d, -state.a);
        peaks.j = std::max(peaks.j, std::fabs(state.j));
        peaks.isGrowing = peaks.isGrowing && state.s >= last.s - 1e-12;
        const double step = profile.duration() / kSamples;
        peaks.roughness =
            std::max(peaks.roughness, std::fabs(state.v - last.v) - step * std::max(peaks.a, peaks.d));
        last = state;
    }
    return peaks;
}

std::mt19937_64 generator(5);
double draw(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
}
double drawScale(double low, double high) {
    return std::exp(draw(std::log(low), std::log(high)));
}

void checkLimits(const Profile& profile, const ProfileLimits& limits) {
    const Peaks peaks = peaksOf(profile);
    CHECK(peaks.v <= limits.speed * (1 + 1e-9));
    CHECK(peaks.a <= limits.acceleration * (1 + 1e-9));
    CHECK(peaks.d <= (limits.deceleration > 0 ? limits.deceleration : limits.acceleration) * (1 + 1e-9));
    CHECK(peaks.j <= limits.jerk * (1 + 1e-9));
    CHECK(peaks.isGrowing);
    CHECK(std::isfinite(profile.duration()));
}

} // namespace

TEST_CASE("a rest to rest profile keeps its limits and ends exactly", "[motion][profile]") {
    for (int n = 0; n < 500; ++n) {
        ProfileLimits limits{drawScale(0.01, 100), drawScale(0.01, 1000), drawScale(0.1, 1e5), 0};
        if (n % 2 == 1) limits.deceleration = drawScale(0.01, 1000);
        const double from = draw(-5, 5);
        const double to = from + drawScale(1e-4, 50);
        const Profile profile = Profile::restToRest(from, to, limits);
        checkLimits(profile, limits);
        CHECK(profile.at(0).s == from);
        CHECK(profile.at(0).v == 0);
        CHECK(profile.at(profile.duration()).s == to);
        CHECK(profile.at(profile.duration() + 1).v == 0);
        // Continuous at the end: just before it the place is the end but for what the last jerk can do.
        const double before = profile.at(profile.duration() * (1 - 1e-9)).s;
        CHECK(before == Approx(to).epsilon(1e-9).margin(1e-9));
    }
}

TEST_CASE("a long motion takes way over speed plus the ramps", "[motion][profile]") {
    // v = 2, a = 4, j = 8: ramp time v/a + a/j = 1 s each, together costing 1 s more than way/v.
    const Profile profile = Profile::restToRest(0, 10, {2, 4, 8, 0});
    CHECK(profile.duration() == Approx(10.0 / 2 + 1));
    // Short: way = 2 v sqrt(v/j) with v the speed reached; four equal phases of (way/(2j))^(1/3).
    const Profile brief = Profile::restToRest(0, 0.001, {2, 4, 8, 0});
    CHECK(brief.duration() == Approx(4 * std::cbrt(0.001 / 16)));
    CHECK(brief.peakSpeed() < 2);
}

TEST_CASE("a duration asked for is met exactly or the limits decide", "[motion][profile]") {
    for (int n = 0; n < 200; ++n) {
        const ProfileLimits limits{drawScale(0.1, 10), drawScale(0.1, 100), drawScale(1, 1e4), 0};
        const double fastest = Profile::restToRest(0, 1, limits).duration();
        const double wanted = fastest * drawScale(0.2, 20);
        const Profile profile = Profile::withDuration(0, 1, limits, wanted);
        CHECK(profile.duration() == Approx(std::max(wanted, fastest)).epsilon(1e-9));
        checkLimits(profile, limits);
    }
}

TEST_CASE("braking and going on from any state keeps the limits", "[motion][profile]") {
    for (int n = 0; n < 500; ++n) {
        const ProfileLimits limits{drawScale(0.1, 10), drawScale(0.1, 100), drawScale(1, 1e4), 0};
        const Profile whole = Profile::restToRest(0, 1, limits);
        const ProfileState state = whole.at(whole.duration() * draw(0, 1));
        const Profile brake = Profile::brake(state, limits);
        checkLimits(brake, limits);
        CHECK(brake.at(0).v == Approx(state.v).margin(1e-12));
        CHECK(brake.end() <= 1 + 1e-9);
        CHECK(brake.end() >= state.s);
        CHECK(brake.at(brake.duration() * (1 - 1e-9)).v == Approx(0).margin(1e-6 * limits.speed));

        bool isFeasible = false;
        const Profile again = Profile::continueTo(brake.at(brake.duration()), 1, limits, isFeasible);
        CHECK(isFeasible);
        checkLimits(again, limits);
        CHECK(again.at(again.duration()).s == 1);
        CHECK(again.at(again.duration() * (1 - 1e-9)).s == Approx(1).epsilon(1e-6));

        // To another speed on the way: slower always works unless the end is being braked for.
        ProfileLimits slower = limits;
        slower.speed *= draw(0.05, 1);
        const Profile slowed = Profile::continueTo(state, 1, slower, isFeasible);
        if (!isFeasible) continue;
        CHECK(slowed.at(slowed.duration() * (1 - 1e-9)).s == Approx(1).epsilon(1e-6));
        const Peaks peaks = peaksOf(slowed);
        CHECK(peaks.a <= limits.acceleration * (1 + 1e-9));
        CHECK(peaks.d <= limits.acceleration * (1 + 1e-9));
        CHECK(peaks.isGrowing);
        CHECK(slowed.duration() >= whole.duration() - whole.timeAt(state.s) - 1e-6);
    }
}

TEST_CASE("the time of a place is the time at which it is reached", "[motion][profile]") {
    for (int n = 0; n < 100; ++n) {
        const Profile profile =
            Profile::restToRest(2, 3, {drawScale(0.1, 10), drawScale(0.1, 100), drawScale(1, 1e4), 0});
        const double place = draw(2.0001, 2.9999);
        CHECK(profile.at(profile.timeAt(place)).s == Approx(place).epsilon(1e-9));
        CHECK(profile.timeAt(2) == 0);
        CHECK(profile.timeAt(3) == profile.duration());
    }
}

TEST_CASE("a profile without way takes no time", "[motion][profile]") {
    CHECK(Profile::restToRest(1, 1, {1, 1, 1, 0}).duration() == 0);
    CHECK(Profile().duration() == 0);
    CHECK(Profile::pause(0.5).duration() == 0.5);
    CHECK(Profile::pause(0.5).at(0.2).v == 0);
}

TEST_CASE("a warp passes its places at the pace asked for and grows", "[motion][warp]") {
    std::vector<double> s;
    std::vector<double> slowness;
    for (int i = 0; i <= 200; ++i) {
        s.push_back(i / 200.0);
        slowness.push_back(1 + 30 * std::exp(-std::pow((s.back() - 0.4) / 0.05, 2)));
    }
    const Warp warp = Warp::fromSlowness(s, slowness);
    REQUIRE_FALSE(warp.isIdentity());
    CHECK(warp.at(0).s == 0);
    CHECK(warp.at(1).s == 1);
    const double whole = warp.at(0).first * slowness.front();
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Warp::Point point = warp.atPlace(k);
        CHECK(point.s == Approx(s[k]).margin(1e-12));
        CHECK(point.first * slowness[k] == Approx(whole).epsilon(0.02));
    }
    double last = -1;
    for (int i = 0; i <= 5000; ++i) {
        const Warp::Point point = warp.at(i / 5000.0);
        CHECK(point.s > last);
        CHECK(point.first > 0);
        last = point.s;
        CHECK(warp.inverse(point.s) == Approx(i / 5000.0).margin(1e-9));
    }
    constexpr double kStep = 1e-5;
    for (double u : {0.1, 0.37, 0.62, 0.9}) {
        CHECK((warp.at(u + kStep).s - warp.at(u - kStep).s) / (2 * kStep) ==
              Approx(warp.at(u).first).epsilon(1e-4));
    }
    CHECK(Warp::fromSlowness({0, 1}, {1, 1}).isIdentity());
}
