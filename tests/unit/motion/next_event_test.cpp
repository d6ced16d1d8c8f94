// The next event of a motion system: nothing happens before it, and orders change it (motion_system.h).

#include "tests/unit/motion/motion_system_rig.h"

using namespace motion_testing;

namespace {

constexpr TimeNs kCycle = 4 * kMs;

/// Orders that a tick may bring.
void orderSomething(MotionSystem& system, unsigned dice, int number) {
    const double turn = 20.0 * (number % 4);
    switch (dice) {
    case 0:
    case 1:
    case 2: {
        MoveCommand command = jointsTo({turn, 10, 5, 0, 40, 0});
        command.zone = {number % 3 == 0, 10, 15, 15, 1.5, 15, 1.5};
        PathTrigger trigger;
        trigger.fromStart = number % 2 == 0;
        trigger.amount = 5;
        command.triggers.push_back(trigger);
        (void)system.enqueue(command);
        break;
    }
    case 3: system.stop(); break;
    case 4: system.halt(); break;
    case 5: system.setOverride(number % 2 == 0 ? 100 : 30); break;
    case 6: system.clear(); break;
    default: system.start();
    }
}

struct Outcome {
    std::vector<MotionEvent> events;
    std::vector<Joints> axes;
};

/// The same orders at the same ticks. `isAsked`: before and after each of them the system is asked for its next event.
Outcome outcomeOf(Planner planner, bool isAsked) {
    MotionOptions options;
    options.planner = planner;
    MotionSystem system = makeSystem(options);
    std::mt19937_64 random(11);
    Outcome result;
    for (int tick = 1; tick <= 3000; ++tick) {
        const bool isOrdered = random() % 25 == 0;
        const auto dice = static_cast<unsigned>(random() % 12);
        if (isAsked) (void)system.nextEventTime();
        if (isOrdered) orderSomething(system, dice, tick);
        const std::optional<TimeNs> next = isAsked ? system.nextEventTime() : std::nullopt;
        for (const MotionEvent& event : system.takeEvents()) // of the order itself
            result.events.push_back(event);
        system.advanceTo(tick * kCycle);
        for (const MotionEvent& event : system.takeEvents()) {
            if (isAsked) REQUIRE((next && event.time >= *next));
            result.events.push_back(event);
        }
        result.axes.push_back(system.current().joints);
    }
    return result;
}

} // namespace

TEST_CASE("nothing happens before the next event, and asking for it changes nothing", "[motion][system]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        const Outcome asked = outcomeOf(planner, true);
        const Outcome unasked = outcomeOf(planner, false);
        REQUIRE(asked.events.size() > 50);
        REQUIRE(asked.events.size() == unasked.events.size());
        for (std::size_t i = 0; i < asked.events.size(); ++i) {
            CHECK(asked.events[i].time == unasked.events[i].time);
            CHECK(asked.events[i].kind == unasked.events[i].kind);
        }
        CHECK(asked.axes == unasked.axes);
    }
}

TEST_CASE("an order changes the next event", "[motion][system]") {
    MotionSystem system = makeSystem();
    CHECK_FALSE(system.nextEventTime().has_value()); // nothing is ordered
    REQUIRE(system.enqueue(jointsTo({40, 0, 0, 0, 30, 0})).hasValue());
    CHECK(system.nextEventTime() == 20 * kMs); // the start of a move of an arm at rest (docs/motion.md)
    system.advanceTo(100 * kMs);
    const TimeNs reached = system.nextEventTime().value();
    system.setOverride(50); // slower, so later
    CHECK(system.nextEventTime().value() > reached);
    system.stop(); // braking takes less than the rest of the way
    CHECK(system.nextEventTime().value() < reached);
    system.clear();
    system.advanceTo(2000 * kMs);
    CHECK_FALSE(system.nextEventTime().has_value());
}
