// Parameters that get the same constant from every call (ir/passes/constant_parameters.cpp).

#include <string>

#include "ir/passes/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;
using ir::Op;

namespace {

/// The routine whose parameters are looked at: `linkage` is "exported " or "", `end` follows what reads the parameters.
std::string callee(const std::string& linkage = "", const std::string& end = "    ret %x\n") {
    return "routine @\"callee\" \"callee\" in \"M\" " + linkage + R"(f32 (f32 "x", i32 "count", ptr "list") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %count = param 1
    %list = param 2
)" + end + "}\n";
}

std::string caller(const std::string& name, const std::string& number, const std::string& count,
                   const std::string& global) {
    return "routine @\"" + name + "\" \"" + name +
           "\" in \"M\" exported f32 () {\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n    %x = const f32 " +
           number + "\n    %count = const i32 " + count + "\n    %list = global @\"T/M/" + global +
           "\"\n    %r = call @\"callee\" (%x, %count, %list)\n    ret %r\n}\n";
}

/// The operation that takes the place of parameter `index` of the routine in `callee`.
Op becomes(uint32_t index, const std::string& callee, const std::string& callers) {
    ir::Module module = parse("global @\"T/M/list\" \"list\" in \"M\" f32 var\n"
                              "global @\"T/M/other\" \"other\" in \"M\" f32 var\n" +
                              callee + callers);
    ir::foldParameters(module);
    for (const std::string& finding : ir::verify(module))
        FAIL_CHECK(finding);
    const ir::Routine& routine = module.routines[0];
    return routine.insts[routine.blocks[0].insts[1 + index]].op; // the first one is the statement
}

} // namespace

TEST_CASE("a parameter that gets the same constant from every call becomes that constant", "[ir]") {
    const std::string two = caller("a", "1", "20", "list") + caller("b", "2", "20", "list");
    CHECK(becomes(0, callee(), two) == Op::ParamVal); // 1 and 2
    CHECK(becomes(1, callee(), two) == Op::Const);
    CHECK(becomes(2, callee(), two) == Op::GlobalAddr);
    const std::string different = two + caller("c", "1", "21", "other");
    CHECK(becomes(1, callee(), different) == Op::ParamVal);
    CHECK(becomes(2, callee(), different) == Op::ParamVal);
    // 0 and -0 are equal, but not the same.
    CHECK(becomes(0, callee(), caller("a", "0", "1", "list") + caller("b", "-0", "1", "list")) ==
          Op::ParamVal);
}

TEST_CASE("a parameter that a routine passes on to itself is as constant as its other calls", "[ir]") {
    const std::string recursive =
        callee("", "    %more = fadd %x, %x\n"
                   "    %r = call @\"callee\" (%more, %count, %list)\n    ret %r\n");
    const std::string one = caller("a", "1", "20", "list");
    CHECK(becomes(0, recursive, one) == Op::ParamVal);
    CHECK(becomes(1, recursive, one) == Op::Const);
    CHECK(becomes(1, recursive, one + caller("b", "1", "21", "list")) == Op::ParamVal);
}

TEST_CASE("parameters of routines that are reached from outside stay", "[ir]") {
    for (uint32_t p = 0; p < 3; ++p)
        CHECK(becomes(p, callee("exported "), caller("a", "1", "20", "list")) == Op::ParamVal);
}
