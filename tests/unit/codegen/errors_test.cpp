// Errors in compiled code: handlers, retry, trynext, filters, propagation, undo. The module is tests/ir/handlers.rir.

#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"

using namespace codegen_testing;
using Events = std::vector<std::string>;

namespace {

struct Handlers {
    std::unique_ptr<codegen::JitProgram> program;
    Task task;

    explicit Handlers(bool optimise) : program(compile(ir_testing::corpusModule("handlers.rir"), optimise)) {}

    template <class... Args> rt::Status run(const std::string& name, Args... args) {
        using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*, Args...);
        return reinterpret_cast<Function>(entry(*program, name))(&task.core, nullptr, args...);
    }
};

} // namespace

TEST_CASE("retry executes the failing statement again", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {21, 22};
        float result = 0;
        CHECK(test.run("retry", &result) == rt::kOk);
        CHECK(result == 7.0f);
        CHECK(events == Events{"raise 21 at 0 in retry", "note 21 < retry", "retry at 3 in retry",
                               "raise 22 at 0 in retry", "note 22 < retry", "retry at 3 in retry"});
    }
}

TEST_CASE("trynext continues after the failing statement", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        float result = 0;
        CHECK(test.run("trynext", &result) == rt::kOk);
        CHECK(result == 11.0f); // statement 0 stopped at its check, statement 1 after its store
        CHECK(events == Events{"raise 11 at 0 in trynext", "note 11 < trynext", "raise 12 at 1 in trynext",
                               "note 12 < trynext"});
    }
}

TEST_CASE("a filter lets only its numbers in", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        float result = 0;
        CHECK(test.run("filtered", &result, 42) == rt::kOk);
        CHECK(result == 42.0f);
        CHECK(test.run("filtered", &result, 43) == 43);
        CHECK(events == Events{"raise 42 at 0 in raiser", "raise 43 at 0 in raiser"});
    }
}

TEST_CASE("an error propagates to the caller's handler without undo", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        CHECK(test.run("outer") == rt::kOk);
        CHECK(events == Events{"raise 77 at 0 in raiser", "propagate at 1 in middle", "note 77 < outer"});
    }
}

TEST_CASE("the end of a handler unwinds by way of undo", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        float result = 0;
        CHECK(test.run("ends", &result) == rt::kUnwind);
        CHECK(events == Events{"raise 5 at 0 in ends", "handlerEnd at 1 in ends", "note 1000 < ends"});
    }
}

TEST_CASE("undo runs when the stack is unwound and returns the original status", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {rt::kUnwind};
        CHECK(test.run("undoes", 5.0f) == rt::kUnwind);
        CHECK(events == Events{"note 1 < undoes", "note 2 < undoes"});
    }
}

TEST_CASE("silent unwinding skips undo", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {rt::kUnwindSilent};
        CHECK(test.run("undoes", 5.0f) == rt::kUnwindSilent);
        CHECK(events.empty());
    }
}

TEST_CASE("an error inside undo ends it early", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {rt::kUnwind, 9};
        CHECK(test.run("undoes", 5.0f) == rt::kUnwind);
        CHECK(events == Events{"note 1 < undoes", "raise 9 at 1 in undoes"});
        events.clear();
        fallibleStatuses = {rt::kUnwind, rt::kUnwindSilent}; // the runtime aborts all undo
        CHECK(test.run("undoes", 5.0f) == rt::kUnwindSilent);
        CHECK(events == Events{"note 1 < undoes"});
    }
}

TEST_CASE("undo does not run when an error leaves the routine", "[codegen]") {
    Handlers test(true);
    fallibleStatuses = {8};
    CHECK(test.run("undoes", 5.0f) == 8);
    CHECK(events == Events{"raise 8 at 0 in undoes"});
}

TEST_CASE("a long jump runs undo on its way", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {rt::kJump};
        CHECK(test.run("undoes", 5.0f) == rt::kJump);
        CHECK(events == Events{"note 1 < undoes", "note 2 < undoes"});
        events.clear();
        fallibleStatuses = {rt::kJumpPast}; // past this one only
        CHECK(test.run("undoes", 5.0f) == rt::kJump);
        fallibleStatuses = {rt::kJumpSilent};
        CHECK(test.run("undoes", 5.0f) == rt::kJumpSilent);
        CHECK(events.empty());
    }
}

TEST_CASE("a native that failed is called once more when the task has been started again", "[codegen]") {
    for (bool optimise : {false, true}) {
        Handlers test(optimise);
        fallibleStatuses = {500, 500};
        CHECK(test.run("undoes", 5.0f) == rt::kOk);
        CHECK(events == Events{"note 5 < undoes"});
    }
}

TEST_CASE("a long jump lands in the handler that it is meant for; a list may hold variables", "[codegen]") {
    for (bool optimise : {false, true}) {
        auto program = compile(ir_testing::parse(R"(
native @"rt_note" plain void (f32)
native @"rt_fallible" plain f32 (f32)
global @"booked" "booked" in "M" f32 var = { f32 10003 }
routine @"target" "target" in "M" exported void () {
  stmt 0 plain 1:1 1:2 handled next b2
  stmt 1 plain 2:1 2:2
  errorhandler b1 [5, @"booked"]
  b0:
    stmt 0
    %0 = const f32 1
    %1 = native @"rt_fallible" (%0)
    native @"rt_note" (%1)
    br b2
  b1:
    stmt 1
    %n = sysvar error
    %2 = sitof f32 %n
    native @"rt_note" (%2)
    trynext
  b2:
    ret !0
}
)"),
                               optimise);
        Task task;
        const auto run = [&] {
            using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*);
            return reinterpret_cast<Function>(entry(*program, "target"))(&task.core, nullptr);
        };
        task.core.errorNumber = 5;
        fallibleStatuses = {rt::kJump};
        CHECK(run() == rt::kOk);
        CHECK(events == Events{"land at 0 in target", "note 5 < target"});
        events.clear();
        fallibleStatuses = {10003};
        CHECK(run() == rt::kOk);
        fallibleStatuses = {6};
        CHECK(run() == 6);
        CHECK(events ==
              Events{"raise 10003 at 0 in target", "note 10003 < target", "raise 6 at 0 in target"});
    }
}

TEST_CASE("frames form the chain of callers", "[codegen]") {
    auto program = compile(ir_testing::parse(R"(
native @"rt_note" plain void (f32)
routine @"a" "a" in "M" exported void () {
  stmt 0 call 1:1 1:2
  b0:
    stmt 0
    %0 = const bool 1
    call @"b" (%0)
    %1 = const bool 0
    call @"b" (%1)
    ret
}
routine @"b" "b" in "M" void (bool "deep") {
  stmt 0 control 1:1 1:2
  stmt 1 call 2:1 2:2
  stmt 2 plain 3:1 3:2
  b0:
    stmt 0
    %0 = param 0
    condbr %0, b1, b2
  b1:
    stmt 1
    %1 = const bool 0
    call @"b" (%1)
    br b2
  b2:
    stmt 2
    %2 = const f32 1
    native @"rt_note" (%2)
    ret
})"));
    Task task;
    using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*);
    CHECK(reinterpret_cast<Function>(entry(*program, "a"))(&task.core, nullptr) == rt::kOk);
    CHECK(events == Events{"note 1 < b < b < a", "note 1 < b < a", "note 1 < b < a"});
}
