#include "unit/runtime/test_program.h"

#include "runtime/sched/error_search.h"

#include <catch2/catch.hpp>

using namespace rt;
using testing::Routine;
using testing::Run;

namespace {

Status fails(TaskCore* core, Frame* caller, const Routine& routine, int statement, Status number) {
    Frame frame{caller, &routine.desc, statement, 0};
    return rt_raise(core, &frame, number);
}

/// Burns stack until the limit, as an endless recursion does.
Status recurse(TaskCore* core, Frame* caller, const RoutineDesc* routine) {
    Frame frame{caller, routine, 0, 0};
    volatile char room[512];
    room[0] = 1;
    if (reinterpret_cast<char*>(&frame) < core->stackLimit) return rt_stackOverflow(core, &frame);
    const Status status = recurse(core, &frame, routine);
    return room[0] == 1 ? status : kOk;
}

} // namespace

TEST_CASE("the search for a handler follows manual 1.12", "[errors]") {
    const Routine main("main", 4, 2), middle("middle", 2), picky("picky", 3, 2, {5, 7}),
        any("any", 2, 1, {kAllErrors});
    Frame outer{nullptr, &main.desc, 0, 0};
    Frame inner{&outer, &middle.desc, 1, 0};
    CHECK(routeOfError(&inner, 3).handler ==
          nullptr); // without handler: the system handler, callers are not asked
    CHECK(routeFromCall(&outer, 3).handler == &outer); // RAISE passes it on,
    CHECK_FALSE(routeFromCall(&outer, 3).longJump);
    CHECK(routeFromCall(&inner, 3).handler == nullptr); // to the next caller and no further
    Frame selective{&outer, &picky.desc, 1, 0};
    CHECK(routeOfError(&selective, 7).handler == &selective);
    CHECK(routeOfError(&selective, 8).handler == nullptr); // its list does not name it
    Routine instruction("CallByVar", 2);
    instruction.desc.isBuiltin = 1;
    Frame builtin{&outer, &instruction.desc, 1,
                  0}; // an instruction written in RAPID is the caller's statement
    CHECK(routeOfError(&builtin, 3).handler == &outer);
    CHECK(routeFromCall(&builtin, 3).handler == &outer);
    CHECK(routeFromCall(&selective, 7).longJump);
    Frame all{&outer, &any.desc, 0, 0};
    CHECK(routeOfError(&all, 1234).handler == &all);
    CHECK(routeFromCall(&all, 1234).longJump);
    selective.statement = 2; // within its own handler: no recovery, not even by the caller
    CHECK(routeOfError(&selective, 7).handler == nullptr);
    outer.statement = 3;
    CHECK(routeOfError(&inner, 3).handler == nullptr);
    outer.statement = 0;
    Frame boundary{&outer, &kTrapBoundary, -1, 0};
    Frame trap{&boundary, &middle.desc, 0, 0};
    CHECK(routeOfError(&trap, 3).handler == nullptr); // the system called it
    CHECK(routeOfError(nullptr, 3).handler == nullptr);
}

TEST_CASE("a handler with a list takes its numbers past others and out of traps", "[errors]") {
    const float booked = 10003;
    const int32_t whole = 77;
    const ErrorVariable variables[] = {{&booked, 1}, {&whole, 0}};
    Routine listing("listing", 3, 2, {5, kOtherErrors});
    const Routine plain("plain", 3, 2);
    listing.desc.errorVariables = variables;
    listing.desc.errorVariableCount = 2;
    Frame outer{nullptr, &listing.desc, 0, 0};
    Frame between{&outer, &plain.desc, 1, 0};
    CHECK(routeFromCall(&between, 5).handler == &outer);
    CHECK(routeFromCall(&between, 10003).handler == &outer);
    CHECK(routeFromCall(&between, 77).handler == &outer);
    CHECK(routeFromCall(&between, 6).handler == &between);
    CHECK(routeFromCall(&outer, 6).handler == &outer); // the clause without list, for its own calls only
    CHECK_FALSE(routeFromCall(&outer, 6).longJump);
    Frame boundary{&outer, &kTrapBoundary, -1, 0};
    Frame trap{&boundary, &plain.desc, 1, 0};
    CHECK(routeOfError(&trap, 5).handler == &trap);
    CHECK(routeFromCall(trap.caller, 5).handler == &outer);
    CHECK(routeFromCall(trap.caller, 6).handler == nullptr);
}

TEST_CASE("RaiseToUser finds the innermost routine that is not NOSTEPIN", "[errors]") {
    Routine hidden("hidden", 3, 2), nested("nested", 3, 2);
    hidden.desc.noStepIn = nested.desc.noStepIn = 1;
    const Routine user("user", 3, 2), bare("bare", 3);
    Frame outer{nullptr, &user.desc, 0, 0};
    Frame middle{&outer, &hidden.desc, 0, 0};
    Frame inner{&middle, &nested.desc, 0, 0};
    CHECK(userLevelHandler(&inner, 12) == &outer);
    Frame without{&outer, &bare.desc, 0, 0};
    middle.caller = &without; // the user's routine without handler: the system handler, not the caller's
    CHECK(userLevelHandler(&inner, 12) == nullptr);
}

TEST_CASE("an error without handler stops the program with an event that names place and chain", "[errors]") {
    static const Routine main("main", 9), helper("helper", 30);
    Run run;
    run.task("T_ROB1", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 4, 0};
        taskOf(core).setErrorDetail("the reason");
        const Status status = fails(core, &frame, helper, 16, 1003);
        CHECK(status == kUnwindSilent); // the run ends: no UNDO
        return status;
    });
    REQUIRE(run.prepare());
    run.controller->log().addErrorName(1003, "ERR_DIVZERO", "division by zero");
    CHECK(run.controller->run() == ExitStatus::StoppedByError);
    const Event* event = run.find(EventId::UnhandledError);
    REQUIRE(event != nullptr);
    CHECK(event->text == "ERR_DIVZERO (1003): the reason.");
    CHECK(event->errorName == "ERR_DIVZERO");
    CHECK(event->task == "T_ROB1");
    CHECK(event->place.module == "TestModule");
    CHECK(event->place.routine == "helper");
    CHECK(event->place.line == 17);
    REQUIRE(event->calls.size() == 1);
    CHECK(event->calls[0].routine == "main");
    CHECK(event->calls[0].line == 5);
}

TEST_CASE("a handled error leaves a warning, unless SkipWarn takes it back", "[errors]") {
    static const Routine main("main", 5, 3);
    static bool skip = false;
    const auto body = [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 1, 0};
        CHECK(rt_raise(core, &frame, 42) == 42);
        CHECK(core->errorNumber == 42);
        frame.statement = 3; // in the handler
        if (const Status status = taskOf(core).sleepFor(kMillisecond)) return status;
        if (skip) taskOf(core).skipWarn();
        return kOk;
    };
    for (const bool skipped : {false, true}) {
        skip = skipped;
        Run run;
        run.task("T", body);
        CHECK(run.run() == ExitStatus::Ended);
        CHECK(run.count(EventId::HandledError) == (skipped ? 0 : 1));
    }
}

TEST_CASE("RETRY is allowed four times for the same statement", "[errors]") {
    static const Routine main("main", 5, 3);
    static int attempts = 0;
    attempts = 0;
    Run run;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 1, 0};
        for (;;) {
            ++attempts;
            frame.statement = 1;
            if (const Status status = rt_raise(core, &frame, 42); status < 0) return status;
            CHECK(taskOf(core).remainingRetries() == 5 - attempts);
            frame.statement = 3;
            if (const Status status = rt_retry(core, &frame); status < 0) return status;
        }
    });
    CHECK(run.run() == ExitStatus::StoppedByError);
    CHECK(attempts == 5); // once, and four times more
    CHECK(run.count(EventId::RetryExceeded) == 1);
}

TEST_CASE("a new call of a routine counts its RETRYs again", "[errors]") {
    static const Routine main("main", 3), flaky("flaky", 5, 3);
    Run run;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 1, 0};
        for (int call = 0; call < 3; ++call) {
            Frame inner{&frame, &flaky.desc, 1, 0}; // at the same address each time
            for (int i = 0; i < 4; ++i) {
                inner.statement = 1;
                if (const Status status = rt_raise(core, &inner, 42); status < 0) return status;
                inner.statement = 3;
                if (const Status status = rt_retry(core, &inner); status < 0) return status;
            }
        }
        return kOk;
    });
    CHECK(run.run() == ExitStatus::Ended);
}

TEST_CASE("RAISE in a handler goes to the caller; without one there to the system handler", "[errors]") {
    static const Routine main("main", 5, 3), helper("helper", 5, 3);
    static bool covered = true;
    const auto body = [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, covered ? 1 : 4, 0};
        Frame inner{&frame, &helper.desc, 2, 0};
        CHECK(rt_raise(core, &inner, 9) == 9);
        inner.statement = 4;
        const Status status = rt_propagate(core, &inner);
        CHECK(status == (covered ? 9 : kUnwindSilent));
        return status < 0 ? status : kOk;
    };
    for (const bool caught : {true, false}) {
        covered = caught;
        Run run;
        run.task("T", body);
        CHECK(run.run() == (caught ? ExitStatus::Ended : ExitStatus::StoppedByError));
        const Event* event = run.find(EventId::UnhandledError);
        CHECK((event == nullptr) == caught);
        if (event != nullptr) CHECK(event->place.line == 3); // where it was raised first
    }
}

TEST_CASE("the end of an error handler calls the system handler", "[errors]") {
    static const Routine main("main", 5, 3);
    Run run;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 0, 0};
        rt_raise(core, &frame, 9);
        frame.statement = 4;
        return rt_handlerEnd(core, &frame);
    });
    CHECK(run.run() == ExitStatus::StoppedByError);
    CHECK(run.count(EventId::HandlerEnd) == 1);
    CHECK(run.count(EventId::HandledError) == 0);
}

TEST_CASE("endless recursion is an event, not a crash", "[errors]") {
    static const Routine main("main", 2, 1);
    Run run;
    run.options.stackBytes = 4u << 20;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status { return recurse(core, caller, &main.desc); });
    CHECK(run.run() == ExitStatus::StoppedByError);
    const Event* event = run.find(EventId::StackOverflow);
    REQUIRE(event != nullptr);
    CHECK(event->calls.size() < 40);
}

TEST_CASE("an error in a trap goes to the system handler even when main could handle it", "[errors]") {
    static const Routine main("main", 5, 3), trap("etrap", 3);
    Run run;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 1, 0};
        core->frame = &frame;
        InterruptTable& table = taskOf(core).interrupts();
        const int number = table.connect(
            {[](TaskCore* inner, Frame* boundary) -> Status { return fails(inner, boundary, trap, 1, 12); },
             &trap.desc,
             {}});
        table.order(number, {});
        table.post(number);
        return taskOf(core).sleepFor(kSecond);
    });
    CHECK(run.run() == ExitStatus::StoppedByError);
    const Event* event = run.find(EventId::UnhandledError);
    REQUIRE(event != nullptr);
    CHECK(event->place.routine == "etrap");
}

TEST_CASE("an error in one NORMAL task stops the others", "[errors]") {
    static const Routine main("main", 5);
    static bool reached = false;
    reached = false;
    Run run;
    run.task("A",
             [](TaskCore* core, Frame* caller) -> Status {
                 if (const Status status = taskOf(core).sleepFor(kSecond)) return status;
                 return fails(core, caller, main, 0, 3);
             })
        .task("B", [](TaskCore* core, Frame*) -> Status {
            const Status status = taskOf(core).sleepFor(2 * kSecond);
            reached = status == kOk;
            return status;
        });
    CHECK(run.run() == ExitStatus::StoppedByError);
    CHECK_FALSE(reached);
    CHECK(run.now() == kSecond);
}

TEST_CASE("TrustLevel decides what the failure of a background task does", "[errors]") {
    static const Routine main("main", 5);
    const auto front = [](TaskCore* core, Frame*) -> Status { return taskOf(core).sleepFor(2 * kSecond); };
    const auto back = [](TaskCore* core, Frame* caller) -> Status {
        if (const Status status = taskOf(core).sleepFor(kSecond)) return status;
        return fails(core, caller, main, 0, 3);
    };
    Run strict;
    strict.task("T", front).task("BACK", back, "STATIC");
    CHECK(strict.run() == ExitStatus::StoppedByError);
    CHECK(strict.now() == kSecond);

    const testing::TempFolder folder;
    Run lax;
    lax.options.configFiles = {folder.write("SYS.cfg",
                                            "SYS:CFG_1.0:7:0::\n\n#\n\nCAB_TASKS:\n\n      -Name \"BACK\" "
                                            "-Type \"STATIC\" -TrustLevel \"NoSafety\"\n")};
    lax.task("T", front).task("BACK", back, "STATIC");
    CHECK(lax.run() == ExitStatus::Ended);
    CHECK(lax.now() == 2 * kSecond);
}

TEST_CASE("an error is described by what was known when it was raised", "[errors]") {
    EventLog log;
    log.setHumanOutput(nullptr);
    log.addErrorName(1003, "ERR_DIVZERO", "division by zero");
    const Routine main("main", 5), other("other", 5);
    Frame frame{nullptr, &main.desc, 1, 0};
    CHECK(RaisedError().text(log).empty());
    CHECK(RaisedError().place().line == 0);
    const RaisedError plain(1003, &frame, "");
    RaisedError explained(7, &frame, "why not?");
    frame = {nullptr, &other.desc, 4, 0}; // the record is used for another routine
    CHECK(plain.text(log) == "ERR_DIVZERO (1003): division by zero.");
    CHECK(plain.place().reference() == "TestModule/main:2");
    CHECK(explained.text(log) == "Error 7: why not?");
    explained.renumber(8, "");
    CHECK(explained.text(log) == "Error 8.");
    CHECK(explained.place().routine == "main");
    CHECK_FALSE(explained.isLike(plain));

    RaisedError kept = RaisedError::described("as it was.", plain.place()); // by an earlier process
    CHECK(kept.text(log) == "as it was.");
    kept.renumber(1003, "");
    CHECK(kept.text(log) == "ERR_DIVZERO (1003): division by zero.");
    CHECK(kept.place().routine == "main");
}

TEST_CASE("an error that is handled again and again is one event with a count, another one ends it",
          "[errors]") {
    static const Routine main("main", 5, 3);
    Run run;
    run.task("T", [](TaskCore* core, Frame* caller) -> Status {
        Frame frame{caller, &main.desc, 1, 0};
        for (const int number : {42, 42, 42, 43, 43, 42}) {
            frame.statement = 1;
            if (number == 43) taskOf(core).setErrorDetail("the reason");
            CHECK(rt_raise(core, &frame, number) == number);
            frame.statement = 3; // in the handler, which is left by the next error
        }
        return kOk;
    });
    CHECK(run.run() == ExitStatus::Ended);
    std::vector<std::string> texts;
    for (const Event& event : run.controller->log().events())
        if (event.number == static_cast<int>(EventId::HandledError))
            texts.push_back(std::to_string(event.count) + " " + event.arguments[2]);
    CHECK(texts == std::vector<std::string>{"3 Error 42.", "2 Error 43: the reason.", "1 Error 42."});
}

TEST_CASE("RETRYs are counted for each error of a statement", "[errors]") {
    RetryCounts counts;
    CHECK(counts.of(7) == 0);
    counts.of(42) = 2;
    counts.of(7) = 1;
    ++counts.of(42);
    CHECK(counts.all() == std::map<int, int>{{7, 1}, {42, 3}});
    CHECK(RetryCounts(counts.all()).all() == counts.all());
    counts.clear();
    CHECK(counts.of(42) == 0);
    CHECK(counts.all().empty());
}
