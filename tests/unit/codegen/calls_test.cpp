// Calls of natives and the passes for routines (decision 57), as they show in the LLVM module.

#include <string>
#include <string_view>

#include "ir/passes/passes.h"
#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"

using namespace codegen_testing;

namespace {

size_t count(const std::string& text, std::string_view wanted) {
    size_t found = 0;
    for (size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1))
        ++found;
    return found;
}

std::string llvmOf(const std::string& text, bool optimise = false) {
    ir::Module module = ir_testing::parse(text);
    REQUIRE(ir::runPasses(module, {}).empty());
    codegen::CodegenOptions options;
    options.optimise = optimise;
    options.debugInfo = false;
    std::string error;
    std::string result = codegen::emitLlvm(module, options, error);
    INFO(error);
    REQUIRE(!result.empty());
    return result;
}

/// A routine with `body` in its only block but the last.
std::string routineOf(const std::string& body) {
    return R"(
native @"rt_note" plain void (f32)
native @"rt_wait" plain void (ptr, f32, ptr)
routine @"r" "r" in "M" exported void () {
  local 0 f32 "x"
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = local 0
    %none = const ptr 0
    %one = const f32 1
)" + body + "    ret\n}\n";
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i)
        result += text;
    return result;
}

} // namespace

TEST_CASE("a native is called by a function of the module, one for each pattern of absent arguments",
          "[codegen]") {
    const std::string text = llvmOf(routineOf("    native @\"rt_wait\" (%none, %one, %none)\n"
                                              "    native @\"rt_wait\" (%none, %one, %none)\n"
                                              "    native @\"rt_wait\" (%x, %one, %none)\n"));
    CHECK(count(text, "call i32 @rt_wait(") == 2);
    CHECK(count(text, "(ptr %task, i32 0, float 1.000000e+00)") == 2);
    CHECK(count(text, "(ptr %task, i32 0, ptr %x, float 1.000000e+00)") == 1);
    CHECK(count(text, "@rt_nativeFailed(") == 3); // the declaration and one call in each function
}

/// 110 instructions of the robot, then a loop that counts to `bound` (an i32) and calls nothing.
std::string routineWithLoop(const std::string& bound) {
    return R"(
native @"rt_note" plain void (f32)
routine @"r" "r" in "M" exported void (f32 "to") {
  local 0 f32 "to" param
  local 1 i32 "k"
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %one = const f32 1
)" + repeated("    native @\"rt_note\" (%one)\n", 110) +
           R"(    %k = local 1
    %first = const i32 1
    store i32 %first, %k
    br b1
  b1:
    %now = load i32 %k
    %to = local 0
    %limit = load f32 %to
)" + bound +
           R"(    %more = ile %now, %bound
    condbr %more, b2, b3
  b2:
    %again = load i32 %k
    %step = const i32 1
    %next = iadd %again, %step
    store i32 %next, %k
    br b1
  b3:
    ret
}
)";
}

TEST_CASE("routines that are paced by natives get few passes, others all", "[codegen]") {
    const auto isPaced = [](const std::string& text) {
        return count(llvmOf(text, true), "\"rapidc-paced\"") > 0;
    };
    const std::string note = "    native @\"rt_note\" (%one)\n";
    CHECK(isPaced(routineOf(repeated(note, 110))));
    CHECK_FALSE(isPaced(routineOf(repeated(note, 20)))); // short
    CHECK(isPaced(routineWithLoop("    %bound = const i32 16\n")));
    CHECK_FALSE(isPaced(routineWithLoop("    %bound = const i32 17\n")));
    const std::string unknown = "    %bound = ftosi i32 %limit\n";
    CHECK_FALSE(isPaced(routineWithLoop(unknown)));
    // An instruction of the robot in each round paces a loop, one in some rounds does not.
    const std::string noteInLoop = "    native @\"rt_note\" (%one) !0\n";
    CHECK(isPaced(routineWithLoop(unknown + noteInLoop)));
    std::string sometimes = routineWithLoop(unknown);
    const auto change = [&](const std::string& from, const std::string& to) {
        sometimes.replace(sometimes.find(from), from.size(), to);
    };
    change("condbr %more, b2, b3", "condbr %more, b2, b5");
    change("b3:\n    ret", "b5:\n    ret");
    change("    %again = load i32 %k\n", "    %rare = ieq %now, %first\n    condbr %rare, b3, b4\n  b3:\n" +
                                             noteInLoop + "    br b4\n  b4:\n    %again = load i32 %k\n");
    CHECK_FALSE(isPaced(sometimes));
}

TEST_CASE("routines of many basic blocks get few passes: LLVM's time grows with the square of their number",
          "[codegen]") {
    const auto isPaced = [](int branches) {
        std::string text = R"(routine @"r" "r" in "M" exported f32 (f32 "x") {
  local 0 f32 "x" param
  local 1 f32 "sum"
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %place = local 0
    %x = load f32 %place
    %whole = ftosi i32 %x
    %sum = local 1
    store f32 %x, %sum
    br b1
)";
        for (int i = 1; i <= branches; ++i) {
            const std::string n = std::to_string(i), next = "b" + std::to_string(2 * i + 1);
            text += "  b" + std::to_string(2 * i - 1) + ":\n    %bound" + n + " = const i32 " + n +
                    "\n    %less" + n + " = ile %whole, %bound" + n + "\n    condbr %less" + n + ", b" +
                    std::to_string(2 * i) + ", " + next + "\n  b" + std::to_string(2 * i) + ":\n    %old" +
                    n + " = load f32 %sum\n    %new" + n + " = fmul %old" + n + ", %x\n    store f32 %new" +
                    n + ", %sum\n    br " + next + "\n";
        }
        text += "  b" + std::to_string(2 * branches + 1) + ":\n    %all = load f32 %sum\n    ret %all\n}\n";
        return count(llvmOf(text, true), "\"rapidc-paced\"") > 0;
    };
    CHECK_FALSE(isPaced(300));
    CHECK(isPaced(600)); // two blocks each
}

TEST_CASE(
    "variables of a routine with many ways back from its handler stay in memory: no phi for each at each way",
    "[codegen]") {
    constexpr int kVariables = 10;
    // Statement n changes one of the variables, may fail, and the handler goes back to it or to the next one.
    const auto phiNodes = [](int statements, const std::string& lastOfHandler) {
        std::string locals, first, rows, blocks;
        for (int v = 0; v < kVariables; ++v) {
            const std::string n = std::to_string(v);
            locals += "  local " + n + " f32 \"v" + n + "\"\n";
            first += "    %v" + n + " = local " + n + "\n    store f32 %one, %v" + n + "\n";
        }
        for (int i = 0; i < statements; ++i) {
            const std::string n = std::to_string(i), next = "b" + std::to_string(i + 2);
            rows += "  stmt " + n + " plain 1:1 1:2 handled start b" + std::to_string(i + 1) + " next " +
                    next + "\n";
            blocks += "  b" + std::to_string(i + 1) + ":\n    stmt " + n + "\n    %place" + n + " = local " +
                      std::to_string(i % kVariables) + "\n    %old" + n + " = load f32 %place" + n +
                      "\n    %got" + n + " = native @\"rt_fallible\" (%old" + n + ")\n    store f32 %got" +
                      n + ", %place" + n + "\n    br " + next + "\n";
        }
        const std::string last = std::to_string(statements + 1), handler = std::to_string(statements + 2);
        std::string text =
            "native @\"rt_fallible\" plain f32 (f32)\nroutine @\"r\" \"r\" in \"M\" exported f32 () {\n";
        text += locals + rows + "  errorhandler b" + handler + "\n  b0:\n    %one = const f32 1\n" + first +
                "    br b1\n";
        text += blocks + "  b" + last + ":\n    %end = local 0\n    %all = load f32 %end\n    ret %all\n";
        text += "  b" + handler + ":\n    stmt 0\n    " + lastOfHandler + "\n}\n";
        return static_cast<int>(count(llvmOf(text, true), " = phi float "));
    };
    for (const std::string back : {"retry", "trynext"}) {
        CHECK(phiNodes(90, back) >= 90 * kVariables / 2);
        CHECK(phiNodes(120, back) <= 120 * 2); // what a statement reads is known after the one before it
    }
}

TEST_CASE("long routines are not inlined where a long routine calls them outside of loops", "[codegen]") {
    const auto program = [](int callerLength, int calleeLength) {
        const auto sum = [](int length) {
            std::string text = "    %s0 = param 0\n    %one = const f32 1\n";
            for (int i = 1; i <= length; ++i)
                text += "    %s" + std::to_string(i) + " = fadd %s" + std::to_string(i - 1) + ", %one\n";
            return text;
        };
        return "routine @\"callee\" \"callee\" in \"M\" f32 (f32 \"x\") {\n  stmt 0 plain 1:1 1:2\n  b0:\n   "
               " stmt 0\n" +
               sum(calleeLength) + "    ret %s" + std::to_string(calleeLength) +
               "\n}\nroutine @\"caller\" \"caller\" in \"M\" exported f32 (f32 \"x\") {\n  stmt 0 plain 1:1 "
               "1:2\n"
               "  b0:\n    stmt 0\n" +
               sum(callerLength) + "    %r = call @\"callee\" (%s" + std::to_string(callerLength) +
               ")\n    ret %r\n}\n";
    };
    const auto calls = [&](int callerLength, int calleeLength) {
        return count(llvmOf(program(callerLength, calleeLength), true),
                     "call fastcc { i32, float } @\"callee$\"(");
    };
    CHECK(calls(200, 60) == 1);
    CHECK(calls(200, 20) == 0); // short enough to be inlined anywhere
    CHECK(calls(100, 60) == 0); // the caller may itself be called in a loop
}
