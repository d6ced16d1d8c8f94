#pragma once
// A robot on the clock, moves, and what happened, for tests of MotionSystem.

#include "runtime/motion/motion_system.h"

#include <catch2/catch.hpp>

#include <random>
#include <vector>

namespace motion_testing {

using namespace motion;

inline constexpr TimeNs kMs = 1'000'000;

inline double between(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline MotionSystem makeSystem(MotionOptions options = {}) {
    auto model = robot::loadRobotModel("IRB 120-3/0.58");
    REQUIRE(model.hasValue());
    return MotionSystem(*model, options);
}

inline MoveCommand jointsTo(const Joints& joints, uint64_t tag = 0) {
    MoveCommand command;
    command.joints.robax = joints;
    command.speed.vTcp = 1000;
    command.tag = tag;
    return command;
}

inline MoveCommand lineFrom(const MotionSystem& system, double x, double y, double z) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose = robot::offs(command.target.pose, x, y, z);
    command.speed.vTcp = 200;
    command.confL = false;
    return command;
}

inline std::vector<MotionEventKind> kinds(const std::vector<MotionEvent>& events) {
    std::vector<MotionEventKind> result;
    for (const MotionEvent& event : events)
        result.push_back(event.kind);
    return result;
}

inline TimeNs timeOf(const std::vector<MotionEvent>& events, MotionEventKind kind, MoveId move) {
    for (const MotionEvent& event : events) {
        if (event.kind == kind && event.move == move) return event.time;
    }
    return -1;
}

inline void run(MotionSystem& system, std::vector<MotionEvent>* events = nullptr) {
    while (const auto next = system.nextEventTime()) {
        system.advanceTo(*next);
        for (const MotionEvent& event : system.takeEvents()) {
            if (events != nullptr) events->push_back(event);
        }
    }
}

} // namespace motion_testing
