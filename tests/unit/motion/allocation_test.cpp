// The cycle of motion - from one sample to the next - takes no memory from the heap.

#include "runtime/motion/motion_system.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <new>

#ifndef RAPIDC_SANITIZE // these replace the allocator themselves

namespace {

thread_local long allocations = 0;

} // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

using namespace motion;

TEST_CASE("samples of the motion take no memory from the heap", "[motion]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        MotionOptions options;
        options.planner = planner;
        MotionSystem system(robot::loadRobotModel("IRB 120-3/0.58").value(), options);
        const JointTarget start{{0, 10, 10, 0, 60, 0}, kNoExternalAxes};
        system.placeAt(start);
        const Pose first = system.current().tcp;
        for (int n = 1; n <= 6; ++n) { // lines with corners, then a joint move
            MoveCommand command;
            command.target.pose = first;
            command.target.pose.pos.y += 20 * n;
            command.target.pose.pos.z += n % 2 == 0 ? 30 : 0;
            command.joints = start;
            command.kind = n < 6 ? MoveKind::Linear : MoveKind::AbsJoint;
            command.speed.vTcp = 200;
            command.zone = {n == 6, 5, 8, 8, 0.8, 8, 0.8};
            command.confL = false;
            REQUIRE(system.enqueue(command).hasValue());
        }
        long cycles = 0;
        constexpr TimeNs kTick = 4'000'000;
        while (!system.isIdle() || system.isMoving()) {
            const TimeNs next = (system.now() / kTick + 1) * kTick;
            const auto event = system.nextEventTime();
            if (event && *event <= next) { // reported in a list, and handed over
                system.advanceTo(*event);
                system.takeEvents();
                continue;
            }
            const long before = allocations;
            system.advanceTo(next);
            const MotionState state = system.current();
            CHECK(allocations == before);
            REQUIRE(state.tcpSpeed < 1e4);
            ++cycles;
        }
        CHECK(cycles > 100);
    }
}

#endif
