// Parameters that get the same constant from every call (ir/passes/constant_parameters.cpp).

#include <string>

#include "ir/passes/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;
using ir::Op;

namespace {

/// The operation that takes the place of parameter `index` of the routine "callee".
Op parameterBecomes(const std::string& callers, uint32_t index, const std::string& callee = "") {
    ir::Module module =
        parse("global @\"T/M/list\" \"list\" in \"M\" f32 var\n"
              "global @\"T/M/other\" \"other\" in \"M\" f32 var\n" +
              (callee.empty() ? R"(routine @"callee" "callee" in "M" f32 (f32 "x", i32 "count", ptr "list") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %count = param 1
    %list = param 2
    ret %x
}
)"
                              : callee) +
              callers);
    ir::foldParameters(module);
    for (const std::string& finding : ir::verify(module))
        FAIL_CHECK(finding);
    const ir::Routine& routine = module.routines[0];
    return routine.insts[routine.blocks[0].insts[1 + index]].op; // the first one is the statement
}

std::string caller(const std::string& name, const std::string& number, const std::string& count,
                   const std::string& global) {
    return "routine @\"" + name + "\" \"" + name +
           "\" in \"M\" exported f32 () {\n  stmt 0 plain 1:1 1:2\n  b0:\n" +
           "    stmt 0\n    %x = const f32 " + number + "\n    %count = const i32 " + count +
           "\n    %list = global @\"T/M/" + global +
           "\"\n    %r = call @\"callee\" (%x, %count, %list)\n    ret %r\n}\n";
}

} // namespace

TEST_CASE("a parameter that gets the same constant from every call becomes that constant", "[ir]") {
    const std::string two = caller("a", "1", "20", "list") + caller("b", "2", "20", "list");
    CHECK(parameterBecomes(two, 0) == Op::ParamVal); // 1 and 2
    CHECK(parameterBecomes(two, 1) == Op::Const);
    CHECK(parameterBecomes(two, 2) == Op::GlobalAddr);
    const std::string different = two + caller("c", "1", "21", "other");
    CHECK(parameterBecomes(different, 1) == Op::ParamVal);
    CHECK(parameterBecomes(different, 2) == Op::ParamVal);
    // 0 and -0 are equal, but not the same.
    CHECK(parameterBecomes(caller("a", "0", "1", "list") + caller("b", "-0", "1", "list"), 0) ==
          Op::ParamVal);
}

TEST_CASE("a parameter that a routine passes on to itself is as constant as its other calls", "[ir]") {
    const std::string recursive =
        R"(routine @"callee" "callee" in "M" f32 (f32 "x", i32 "count", ptr "list") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %count = param 1
    %list = param 2
    %more = fadd %x, %x
    %r = call @"callee" (%more, %count, %list)
    ret %r
}
)";
    const std::string one = caller("a", "1", "20", "list");
    CHECK(parameterBecomes(one, 0, recursive) == Op::ParamVal);
    CHECK(parameterBecomes(one, 1, recursive) == Op::Const);
    CHECK(parameterBecomes(one + caller("b", "1", "21", "list"), 1, recursive) == Op::ParamVal);
}

TEST_CASE("parameters of routines that are reached from outside stay", "[ir]") {
    const std::string exported =
        R"(routine @"callee" "callee" in "M" exported f32 (f32 "x", i32 "count", ptr "list") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %count = param 1
    %list = param 2
    ret %x
}
)";
    for (uint32_t p = 0; p < 3; ++p)
        CHECK(parameterBecomes(caller("a", "1", "20", "list"), p, exported) == Op::ParamVal);
}
