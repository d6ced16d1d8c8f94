#include "unit/runtime/test_program.h"

#include <catch2/catch.hpp>

#include <chrono>

#include <poll.h>
#include <unistd.h>

using namespace rt;
using testing::charge;
using testing::Run;

namespace {

std::vector<std::string> order; // what the tasks of a test did

void note(TaskCore* core, const std::string& what) {
    order.push_back(taskOf(core).name() + ":" + what);
}

struct Fresh {
    Fresh() { order.clear(); }
};

} // namespace

TEST_CASE("sleeping tasks wake in order of time, then in order of their sleep", "[sched]") {
    Fresh fresh;
    const auto body = [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        const double seconds = task.name() == "A" ? 0.3 : task.name() == "B" ? 0.1 : 0.3;
        if (const Status status = task.sleepFor(fromSeconds(seconds))) return status;
        note(core, formatSeconds(task.now(), 3));
        return kOk;
    };
    Run run;
    run.task("A", body).task("B", body).task("C", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(order == std::vector<std::string>{"B:0.100", "A:0.300", "C:0.300"});
    CHECK(run.now() == 300 * kMillisecond);
}

TEST_CASE("virtual time moves with instructions at the given rate", "[sched]") {
    const auto body = [](TaskCore* core, Frame* frame) -> Status { return charge(core, frame, 15'000); };
    Run run;
    run.task("T", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(run.now() == kSecond); // 15 per ms

    Run fast;
    fast.options.rate = 42;
    fast.task("T", [](TaskCore* core, Frame* frame) -> Status { return charge(core, frame, 42 * 7); });
    REQUIRE(fast.run() == ExitStatus::Ended);
    CHECK(fast.now() == 7 * kMillisecond);
}

TEST_CASE("time within a slice is exact to the instruction", "[sched]") {
    static Time seen = 0;
    const auto body = [](TaskCore* core, Frame* frame) -> Status {
        for (int i = 0; i < 30; ++i) {
            if (const Status status = charge(core, frame, 1)) return status;
        }
        seen = taskOf(core).now();
        return kOk;
    };
    Run run;
    run.task("T", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(seen == 2 * kMillisecond);
}

TEST_CASE("a lone computing task is not interrupted", "[sched]") {
    static int yields = 0;
    yields = 0;
    const auto body = [](TaskCore* core, Frame* frame) -> Status {
        for (int i = 0; i < 1'000'000; ++i) {
            core->budget -= 1;
            if (core->budget < 0) {
                ++yields;
                if (const Status status = rt_safepoint(core, frame)) return status;
            }
        }
        return kOk;
    };
    Run run;
    run.task("T", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(yields == 0);
}

TEST_CASE("several computing tasks take turns of a millisecond", "[sched]") {
    Fresh fresh;
    const auto body = [](TaskCore* core, Frame* frame) -> Status {
        for (int i = 1; i <= 45; ++i) {
            if (const Status status = charge(core, frame, 1)) return status;
            if (i % 15 == 0) note(core, std::to_string(i));
        }
        return kOk;
    };
    Run run;
    run.task("A", body).task("B", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    // A budget of 15 is used up by 15 instructions; the 16th gives way.
    CHECK(order == std::vector<std::string>{"A:15", "B:15", "A:30", "B:30", "A:45", "B:45"});
    CHECK(run.now() == 6 * kMillisecond);
}

TEST_CASE("a loop that is paid ahead lets others run meanwhile, and its effects come after", "[sched]") {
    Fresh fresh;
    Run run;
    run.task("LOOP",
             [](TaskCore* core, Frame* frame) -> Status {
                 if (const Status status = charge(core, frame, 15'000)) return status;
                 note(core, formatSeconds(taskOf(core).now(), 2));
                 return kOk;
             })
        .task("TICK", [](TaskCore* core, Frame*) -> Status {
            for (int i = 0; i < 3; ++i) {
                if (const Status status = taskOf(core).sleepFor(250 * kMillisecond)) return status;
                note(core, formatSeconds(taskOf(core).now(), 2));
            }
            return kOk;
        });
    REQUIRE(run.run() == ExitStatus::Ended);
    // A task that wakes waits for its turn: up to a slice of the other one.
    CHECK(order == std::vector<std::string>{"TICK:0.25", "TICK:0.50", "TICK:0.75", "LOOP:1.00"});
}

TEST_CASE("The option max-time ends a busy loop and a run that only waits", "[sched]") {
    Run busy;
    busy.options.hasMaxTime = true;
    busy.options.maxTime = 2;
    busy.task("T", [](TaskCore* core, Frame* frame) -> Status {
        for (;;) {
            if (const Status status = charge(core, frame, 1)) return status;
        }
    });
    CHECK(busy.run() == ExitStatus::MaxTimeReached);
    CHECK(busy.now() == 2 * kSecond);

    Run waiting;
    waiting.options.hasMaxTime = true;
    waiting.options.maxTime = 5;
    waiting.task("T", [](TaskCore* core, Frame*) -> Status { return taskOf(core).sleepUntil(kNever); });
    CHECK(waiting.run() == ExitStatus::MaxTimeReached);
    CHECK(waiting.now() == 5 * kSecond);
    CHECK(waiting.count(EventId::NothingPending) == 1);
}

TEST_CASE("a run in which nothing can happen any more ends with an event", "[sched]") {
    Run run;
    run.task("T", [](TaskCore* core, Frame*) -> Status { return taskOf(core).sleepUntil(kNever); });
    CHECK(run.run() == ExitStatus::StoppedByError);
    CHECK(run.count(EventId::NothingPending) == 1);
}

TEST_CASE("a wait queue wakes a task whose condition holds, others wait on", "[sched]") {
    Fresh fresh;
    static WaitQueue* queue = nullptr;
    static int value = 0;
    WaitQueue own;
    queue = &own;
    value = 0;
    const auto waiter = [](TaskCore* core, Frame*) -> Status {
        WaitResult result{};
        const int wanted = taskOf(core).name() == "W2" ? 2 : 1;
        const WaitSpec spec{{queue}, [wanted] { return value == wanted; }, 10 * kSecond, 0};
        if (const Status status = taskOf(core).waitFor(spec, result)) return status;
        note(core,
             (result == WaitResult::Done ? "done " : "timeout ") + formatSeconds(taskOf(core).now(), 1));
        return kOk;
    };
    Run run;
    run.task("W1", waiter).task("W2", waiter).task("S", [](TaskCore* core, Frame*) -> Status {
        if (const Status status = taskOf(core).sleepFor(kSecond)) return status;
        value = 1;
        queue->notifyAll();
        return kOk;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(order == std::vector<std::string>{"W1:done 1.0", "W2:timeout 10.0"});
}

TEST_CASE("cycles: NORMAL tasks run main as often as asked, STATIC ones do not keep the run alive",
          "[sched]") {
    static int mains = 0, resets = 0, statics = 0;
    mains = resets = statics = 0;
    Run run;
    run.options.cycles = 3;
    run.task(
           "T_ROB1",
           [](TaskCore* core, Frame*) -> Status {
               ++mains;
               return taskOf(core).sleepFor(kSecond);
           },
           "NORMAL", [](TaskCore*, Frame*) -> Status { return ++resets, kOk; })
        .task(
            "BACK",
            [](TaskCore* core, Frame*) -> Status {
                ++statics;
                return taskOf(core).sleepFor(100 * kMillisecond);
            },
            "STATIC");
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(mains == 3);
    CHECK(resets == 1); // variables keep their values between cycles
    CHECK(statics >= 29);
    CHECK(run.now() / kMillisecond == 3000); // a new cycle costs an instruction
}

TEST_CASE("an empty main without end still lets time pass", "[sched]") {
    Run run;
    run.options.cycles = 0;
    run.options.hasMaxTime = true;
    run.options.maxTime = 0.01;
    run.task("T", [](TaskCore*, Frame*) -> Status { return kOk; });
    CHECK(run.run() == ExitStatus::MaxTimeReached);
    CHECK(run.controller->tasks().front()->cyclesDone() > 100);
}

TEST_CASE("ExitCycle ends one cycle, EXIT the program", "[sched]") {
    static int mains = 0;
    mains = 0;
    Run run;
    run.options.cycles = 5;
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        ++mains;
        return mains < 3 ? taskOf(core).requestExitCycle() : taskOf(core).requestExit();
    });
    CHECK(run.run() == ExitStatus::Ended);
    CHECK(mains == 3);
}

TEST_CASE("Stop without a start to come ends the run; other NORMAL tasks continue", "[sched]") {
    static bool after = false, other = false;
    after = other = false;
    Run run;
    run.task("T",
             [](TaskCore* core, Frame*) -> Status {
                 const Status status = taskOf(core).stopHere("Stop");
                 after = status == kOk;
                 return status;
             })
        .task("U", [](TaskCore* core, Frame*) -> Status {
            const Status status = taskOf(core).sleepFor(kSecond);
            other = status == kOk;
            return status;
        });
    CHECK(run.run() == ExitStatus::Ended);
    CHECK_FALSE(after);
    CHECK(other);
    CHECK(run.count(EventId::ProgramStopped) == 1);
}

TEST_CASE("a native that waits is unwound without UNDO when the run ends", "[sched]") {
    static Status seen = 0;
    seen = 0;
    Run run;
    run.task("T", [](TaskCore* core, Frame*) -> Status { return taskOf(core).sleepFor(kSecond); })
        .task(
            "BACK", [](TaskCore* core, Frame*) -> Status { return seen = taskOf(core).sleepFor(kNever / 2); },
            "STATIC");
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(seen == kUnwindSilent);
}

TEST_CASE("interrupts are delivered while a task waits and at safepoints", "[sched]") {
    Fresh fresh;
    const auto body = [](TaskCore* core, Frame* frame) -> Status {
        Task& task = taskOf(core);
        InterruptTable& table = task.interrupts();
        const Trap trap{[](TaskCore* inner, Frame*) -> Status {
                            note(inner, "trap" + std::to_string(static_cast<int>(inner->interruptNumber)) +
                                            " " + formatSeconds(taskOf(inner).now(), 1));
                            return kOk;
                        },
                        nullptr,
                        {}};
        const int first = table.connect(trap);
        const int second = table.connect(trap);
        table.order(first, {});
        table.order(second, {}, true);
        task.scheduler().at(kSecond, [&table, first] { table.post(first); });
        core->errorNumber = 77;
        if (const Status status = task.sleepFor(2 * kSecond)) return status;
        CHECK(core->errorNumber == 77);
        table.disable();
        table.post(second);
        table.post(second); // \Single: the order ended with the first
        table.post(first);
        if (const Status status = task.sleepFor(kSecond)) return status;
        note(core, "enable");
        table.enable();
        if (const Status status = charge(core, frame, 1)) return status;
        note(core, "end");
        table.sleep(first);
        table.post(first);
        return charge(core, frame, 1);
    };
    Run run;
    run.task("T", body);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(order ==
          std::vector<std::string>{"T:trap1 1.0", "T:enable", "T:trap2 3.0", "T:trap1 3.0", "T:end"});
}

TEST_CASE("at most 100 interrupts may be defined", "[sched]") {
    Run run;
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        InterruptTable& table = taskOf(core).interrupts();
        for (int i = 1; i <= 100; ++i)
            CHECK(table.connect({}) == i);
        CHECK(table.connect({}) == 0);
        CHECK(table.remove(50));
        CHECK_FALSE(table.remove(50));
        CHECK(table.connect({}) > 100);
        return kOk;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
}

TEST_CASE("waiting for something outside holds virtual time back", "[sched]") {
    static int pipeEnds[2];
    REQUIRE(pipe(pipeEnds) == 0);
    Run run;
    run.task("READER", [](TaskCore* core, Frame*) -> Status {
        WaitResult result{};
        const Status status = taskOf(core).waitExternal(pipeEnds[0], POLLIN, 50 * kMillisecond, result);
        CHECK(result == WaitResult::Timeout); // the wall really took that long
        if (status) return status;
        CHECK(write(pipeEnds[1], "x", 1) == 1);
        return taskOf(core).waitExternal(pipeEnds[0], POLLIN, kNever, result);
    });
    const auto before = std::chrono::steady_clock::now();
    REQUIRE(run.run() == ExitStatus::Ended);
    const auto took = std::chrono::steady_clock::now() - before;
    CHECK(took >= std::chrono::milliseconds(45));
    close(pipeEnds[0]);
    close(pipeEnds[1]);
}

TEST_CASE("formatted and converted times are exact", "[sched]") {
    CHECK(fromSeconds(0.1) == 100 * kMillisecond);
    CHECK(fromSeconds(-1) == 0);
    CHECK(fromSeconds(1e300) == kNever);
    CHECK(formatSeconds(1'234'567'890, 3) == "1.234");
    CHECK(formatSeconds(kSecond * 3600, 6) == "3600.000000");
    CHECK(addTime(kNever, 5) == kNever);
}
