// AxisProfile: jerk-limited courses of axes in closed form, against the equations of motion and exact durations.

#include "runtime/motion/axis_profile.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

using namespace motion_testing;

namespace {

/// A state that can be kept within the limits before and after.
AxisState randomState(std::mt19937_64& random, const AxisLimits& limits) {
    AxisState state;
    state.p = between(random, -3, 3);
    double change = 0;
    do {
        state.v = between(random, -1, 1) * limits.speed;
        state.a = between(random, -1, 1) * limits.acceleration;
        change = state.a * state.a / (2 * limits.jerk);
    } while (std::abs(state.v) + change > limits.speed);
    return state;
}

struct Excess {
    double speed = 0, acceleration = 0, jerk = 0, end = 0;
};

/// How far a profile passes its limits (as a share) and misses its end.
Excess excessOf(const AxisProfile& profile, const AxisLimits& limits) {
    Excess excess;
    AxisState state = profile.begin();
    for (std::size_t i = 0; i < AxisProfile::kPieces; ++i) {
        const double time = profile.times()[i];
        const double jerk = profile.jerks()[i];
        if (!(time >= 0)) excess.end = 1e300;
        for (int k = 1; k <= 4; ++k) {
            const AxisState at = advanced(state, jerk, time * k / 4);
            excess.speed = std::max(excess.speed, std::abs(at.v) / limits.speed - 1);
            excess.acceleration = std::max(excess.acceleration, std::abs(at.a) / limits.acceleration - 1);
        }
        excess.jerk = std::max(excess.jerk, std::abs(jerk) / limits.jerk - 1);
        state = advanced(state, jerk, time);
    }
    const AxisState& end = profile.end();
    excess.end = std::max(
        {excess.end, std::abs(state.p - end.p), std::abs(state.v - end.v), std::abs(state.a - end.a)});
    return excess;
}

long soakCount(long usual) {
    const char* soak = std::getenv("RAPIDC_SOAK");
    return soak != nullptr ? std::atol(soak) : usual;
}

} // namespace

TEST_CASE("rest to rest takes the exact shortest time", "[motion][profile]") {
    const AxisLimits limits{2, 4, 20};
    // Speed is reached: v/a + a/j for each change of speed, which covers half of v times that.
    CHECK(AxisProfile::restToRest(0, 10, limits).duration() == Approx(10 / 2.0 + 2 / 4.0 + 4 / 20.0));
    // Acceleration is reached, speed is not: v with v (v/a + a/j) = way, twice v/a + a/j.
    const double v = 0.5 * (-0.8 + std::sqrt(0.8 * 0.8 + 4 * 4 * 1.0));
    CHECK(AxisProfile::restToRest(5, 4, limits).duration() == Approx(2 * (v / 4 + 0.2)));
    // Neither: four pieces of (way / 2 j)^(1/3).
    CHECK(AxisProfile::restToRest(0, 0.01, limits).duration() == Approx(4 * std::cbrt(0.01 / 40)));
    // Speed is reached before acceleration is.
    CHECK(AxisProfile::restToRest(0, 1, {0.2, 4, 20}).duration() == Approx(1 / 0.2 + 2 * std::sqrt(0.01)));
    CHECK(AxisProfile::restToRest(3, 3, limits).duration() == 0);
}

TEST_CASE("axes from rest to rest keep their limits and arrive together", "[motion][profile]") {
    std::mt19937_64 random(3);
    for (int n = 0; n < 2000; ++n) {
        std::array<double, 6> from{}, to{};
        std::array<AxisLimits, 6> limits{};
        std::array<AxisProfile, 6> profiles;
        for (std::size_t i = 0; i < 6; ++i) {
            from[i] = between(random, -3, 3);
            to[i] = n % 7 == 0 ? from[i] + 1e-6 : between(random, -3, 3);
            limits[i] = {between(random, 0.1, 5), between(random, 0.1, 10), between(random, 1, 100)};
        }
        restToRestTogether(from, to, limits, profiles);
        double longest = 0;
        for (std::size_t i = 0; i < 6; ++i)
            longest = std::max(longest, AxisProfile::restToRest(from[i], to[i], limits[i]).duration());
        for (std::size_t i = 0; i < 6; ++i) {
            CHECK(profiles[i].duration() == longest);
            const Excess excess = excessOf(profiles[i], limits[i]);
            CHECK(excess.speed < 1e-12);
            CHECK(excess.acceleration < 1e-12);
            CHECK(excess.jerk < 1e-12);
            CHECK(excess.end < 1e-11);
        }
    }
}

TEST_CASE("axes between any states keep their limits and arrive together", "[motion][profile][random]") {
    const char* seed = std::getenv("RAPIDC_SEED");
    std::mt19937_64 random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 11);
    const long count = soakCount(20'000);
    for (long n = 0; n < count; ++n) {
        std::array<AxisState, 6> from{}, to{};
        std::array<AxisLimits, 6> limits{};
        std::array<AxisProfile, 6> profiles;
        for (std::size_t i = 0; i < 6; ++i) {
            limits[i] = {between(random, 0.5, 5), between(random, 0.5, 10), between(random, 1, 50)};
            from[i] = randomState(random, limits[i]);
            to[i] = randomState(random, limits[i]);
        }
        betweenTogether(from, to, limits, profiles);
        for (std::size_t i = 0; i < 6; ++i) {
            const Excess excess = excessOf(profiles[i], limits[i]);
            const bool isGood = excess.speed < 1e-11 && excess.acceleration < 1e-11 && excess.jerk < 1e-12 &&
                                excess.end < 1e-9 &&
                                std::abs(profiles[i].duration() - profiles[0].duration()) < 1e-9;
            INFO("problem " << n << ", axis " << i);
            if (!isGood) CHECK(isGood);
        }
    }
    CHECK(count > 0);
}

TEST_CASE("between states at rest the shortest time is that from rest to rest", "[motion][profile]") {
    std::mt19937_64 random(5);
    for (int n = 0; n < 5000; ++n) {
        const AxisLimits limits{between(random, 0.1, 5), between(random, 0.1, 10), between(random, 1, 100)};
        const double to = between(random, -3, 3);
        const double exact = AxisProfile::restToRest(0, to, limits).duration();
        CHECK(AxisProfile::between({0, 0, 0}, {to, 0, 0}, limits).duration() == Approx(exact).epsilon(1e-8));
    }
}

TEST_CASE("a profile of a given duration", "[motion][profile]") {
    const AxisLimits limits{2, 4, 20};
    const auto slow = AxisProfile::lasting(8, {0, 1, 0}, {5, 0, 0}, limits);
    REQUIRE(slow);
    CHECK(slow->duration() == Approx(8));
    CHECK(excessOf(*slow, limits).end < 1e-9);
    CHECK_FALSE(AxisProfile::lasting(0.5, {0, 1, 0}, {5, 0, 0}, limits)); // shorter than the shortest
}

TEST_CASE("a speed beyond its limit is taken back", "[motion][profile]") {
    const AxisLimits limits{1, 4, 20};
    const AxisProfile profile = AxisProfile::between({0, 3, 0}, {10, 0, 0}, limits);
    CHECK(excessOf(profile, limits).end < 1e-9);
    CHECK(profile.at(0.5 * profile.duration()).v == Approx(1));
}
