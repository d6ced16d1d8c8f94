// How many instructions a program can execute at most: the sum over the routines called, without bound when anything repeats.

#include <cmath>

#include "ir/core/execution_bound.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;

namespace {

/// A program whose main has `body`, its block b0 first; further routines and natives before it.
ir::Module program(const std::string& body, const std::string& others = "") {
    return parse(others +
                 "routine @\"main\" \"main\" in \"M\" exported void () {\n"
                 "  stmt 0 plain 1:1 1:2 handled start b0\n" +
                 body + "}\ntask \"T\" \"NORMAL\" entry @\"main\"\n");
}

const std::string kHelper = "routine @\"helper\" \"helper\" in \"M\" void () {\n  b0:\n    %0 = const i32 1\n"
                            "    ret\n}\n";

} // namespace

TEST_CASE("straight programs have a bound, which counts calls", "[ir]") {
    CHECK(ir::mostExecuted(program("  b0:\n    ret\n")) == 1);
    // two calls of a routine of two instructions, and ret
    const std::string twice =
        "  b0:\n    stmt 0\n    call @\"helper\" ()\n    call @\"helper\" ()\n    ret\n";
    CHECK(ir::mostExecuted(program(twice, kHelper)) == 1 + 2 * (1 + 2) + 1);
}

TEST_CASE("loops, retries, recursion and calls from outside have no bound", "[ir]") {
    const auto isBounded = [](const ir::Module& module) { return std::isfinite(ir::mostExecuted(module)); };
    CHECK_FALSE(isBounded(program("  b0:\n    br b1\n  b1:\n    br b1\n")));
    CHECK_FALSE(isBounded(program("  errorhandler b1\n  b0:\n    stmt 0\n    %0 = const i32 5\n    raise %0\n"
                                  "  b1:\n    stmt 0\n    retry\n")));
    CHECK_FALSE(isBounded(program("  b0:\n    stmt 0\n    call @\"main\" ()\n    ret\n")));
    std::string fromOutside = kHelper;
    fromOutside.insert(fromOutside.find(" void"), " exported");
    CHECK_FALSE(isBounded(program("  b0:\n    ret\n", fromOutside)));
    ir::Module two = program("  b0:\n    ret\n");
    two.tasks.push_back(two.tasks[0]);
    CHECK_FALSE(isBounded(two));
}
