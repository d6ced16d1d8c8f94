// The passes, on small routines whose outcome follows from the rules in ir/LANGREF.md and decision 7.

#include <functional>
#include <limits>

#include "ir/core/cfg.h"
#include "ir/passes/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;
using ir::Op;

namespace {

ir::Module run(ir::Module module, std::vector<std::string_view> passes,
               ir::Profile profile = ir::Profile::Release) {
    ir::PassOptions options;
    options.profile = profile;
    for (const std::string& finding : ir::runPasses(module, options, passes))
        FAIL_CHECK(finding);
    return module;
}

struct Found {
    ir::BlockId block;
    size_t place;
    int32_t cost;
    bool computed; ///< has an operand
};

std::vector<Found> safepoints(const ir::Routine& routine) {
    std::vector<Found> result;
    for (ir::BlockId b = 0; b < routine.blocks.size(); ++b)
        for (size_t i = 0; i < routine.blocks[b].insts.size(); ++i) {
            const ir::Inst& inst = routine.insts[routine.blocks[b].insts[i]];
            if (inst.op == Op::Safepoint) result.push_back({b, i, inst.extra, !inst.operands.empty()});
        }
    return result;
}

size_t count(const ir::Routine& routine, Op op) {
    size_t result = 0;
    for (const ir::Block& block : routine.blocks)
        for (ir::ValueId id : block.insts)
            result += routine.insts[id].op == op;
    return result;
}

/// A routine around a few lines of one block; `result` is its type.
ir::Module body(const std::string& result, const std::string& lines) {
    return parse("routine @\"r\" \"r\" in \"M\" " + result +
                 " (f32 \"x\") {\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n" + lines + "}\n");
}

/// The constant that the routine returns after folding; fails when it is not one.
ir::Inst foldedConstant(const std::string& result, const std::string& lines) {
    ir::Module module = run(body(result, lines), {"fold-constants"});
    const ir::Routine& r = module.routines[0];
    const ir::Inst& ret = r.insts[r.blocks[0].insts.back()];
    REQUIRE(ret.op == Op::Ret);
    const ir::Inst& value = r.insts[ret.operands[0]];
    REQUIRE(value.op == Op::Const);
    return value;
}
double foldedResult(const std::string& result, const std::string& lines) {
    return foldedConstant(result, lines).number();
}
int64_t foldedInteger(const std::string& result, const std::string& lines) {
    return foldedConstant(result, lines).integer();
}
/// Of an instruction on two integers of a type.
int64_t foldedPair(const std::string& op, const std::string& type, int64_t a, int64_t b,
                   const std::string& result = {}) {
    return foldedInteger(result.empty() ? type : result,
                         "%0 = const " + type + " " + std::to_string(a) + "\n%1 = const " + type + " " +
                             std::to_string(b) + "\n%2 = " + op + " %0, %1\nret %2\n");
}

} // namespace

TEST_CASE("charges become safepoints with the same cost", "[ir]") {
    ir::Module module = run(corpusModule("charges.rir"), {"place-safepoints"});
    const ir::Routine& r = routine(module, "charged");
    CHECK(count(r, Op::Charge) == 0);
    auto found = safepoints(r);
    REQUIRE(found.size() == 3);
    CHECK(found[0].block == 0);
    CHECK(found[0].place == 0);
    CHECK(found[0].cost == 4);
    CHECK_FALSE(found[0].computed);
    CHECK(found[1].block == 0); // before the loop, for all its rounds
    CHECK(found[1].cost == 0);
    CHECK(found[1].computed);
    CHECK(found[2].cost == 2); // each round of the second loop
}

TEST_CASE("a counted loop without calls has no safepoint and cannot wrap", "[ir]") {
    ir::Module module = run(corpusModule("loops.rir"), {"place-safepoints"});
    const ir::Routine& r = routine(module, "counted");
    auto found = safepoints(r);
    REQUIRE(found.size() == 1);
    CHECK(found[0].block == 0);
    CHECK(found[0].cost == 1);
    ir::BlockId latch = 3;
    bool marked = false;
    for (ir::ValueId id : r.blocks[latch].insts)
        marked = marked || (r.insts[id].op == Op::IAdd && r.insts[id].extra == 1);
    CHECK(marked);
}

TEST_CASE("other loops cost one at the back edge when nothing is charged", "[ir]") {
    ir::Module module = run(corpusModule("loops.rir"), {"place-safepoints"});
    auto calling = safepoints(routine(module, "calling"));
    REQUIRE(calling.size() == 3);
    CHECK(calling[0].cost == 1);
    CHECK(calling[1].block == 2);
    CHECK(calling[1].cost == 0); // the native may have caused an interrupt
    CHECK(calling[2].block == 2);
    CHECK(calling[2].cost == 1);

    // The entry was the header of the loop: it gets a block of its own in front, otherwise it would pay each round.
    const ir::Routine& loop = routine(module, "while");
    auto whileLoop = safepoints(loop);
    REQUIRE(whileLoop.size() == 2);
    CHECK(whileLoop[0].block == 0);
    CHECK(ir::successors(loop, 0).size() == 1);
    CHECK(whileLoop[1].block == 1);
    CHECK(whileLoop[1].cost == 1);
}

TEST_CASE("a loop that is entered in the middle pays on the edge back", "[ir]") {
    ir::Module module = run(corpusModule("loops.rir"), {"place-safepoints"});
    const ir::Routine& r = routine(module, "irreducible");
    auto found = safepoints(r);
    REQUIRE(found.size() >= 2);
    // Without the blocks that hold a safepoint no cycle is left.
    std::vector<int> state(r.blocks.size(), 0);
    std::vector<bool> paying(r.blocks.size(), false);
    for (const Found& f : found)
        paying[f.block] = f.block != 0;
    bool cycle = false;
    std::function<void(ir::BlockId)> visit = [&](ir::BlockId b) {
        state[b] = 1;
        for (ir::BlockId succ : ir::successors(r, b)) {
            if (paying[succ]) continue;
            if (state[succ] == 1) cycle = true;
            if (state[succ] == 0) visit(succ);
        }
        state[b] = 2;
    };
    visit(0);
    CHECK_FALSE(cycle);
}

namespace {

/// A native without result, then a store to a persistent and one to a variable; `native` ends the line of the native.
ir::Module causes(const std::string& native) {
    return parse(
        "file 0 \"m.modx\"\ndesc 0 \"num\" base \"num\" float f32\n"
        "global @\"p\" \"p\" in \"M\" f32 persistent desc 0 at 0:1\n"
        "global @\"v\" \"v\" in \"M\" f32 var desc 0 at 0:2\n"
        "native @\"rt_do\" plain void ()" +
        native +
        "\nroutine @\"r\" \"r\" in \"M\" at 0:3 void () {\n  stmt 0 plain 1:1 1:2\n  stmt 1 plain 2:1 2:2\n"
        "  stmt 2 plain 3:1 3:2\n  b0 \"entry\":\n    stmt 0\n    native @\"rt_do\" ()\n    stmt 1\n"
        "    %0 = const f32 1\n    %1 = global @\"p\"\n    store f32 %0, %1\n    stmt 2\n"
        "    %2 = global @\"v\"\n    store f32 %0, %2\n    ret\n}\n");
}

} // namespace

TEST_CASE("what may cause an interrupt is followed by a safepoint without cost", "[ir]") {
    const ir::Module plain = run(causes(""), {"place-safepoints"});
    auto found = safepoints(plain.routines[0]);
    REQUIRE(found.size() == 2);
    CHECK(found[0].cost == 1);
    CHECK(found[1].cost == 0);
    CHECK(plain.routines[0].insts[plain.routines[0].blocks[0].insts[found[1].place - 1]].op ==
          Op::CallNative);

    // Stores to persistents count only when a native of the program watches them.
    const ir::Module watching = run(causes(" watches"), {"place-safepoints"});
    found = safepoints(watching.routines[0]);
    REQUIRE(found.size() == 3);
    CHECK(found[2].cost == 0);
    const ir::Routine& r = watching.routines[0];
    CHECK(r.insts[r.blocks[0].insts[found[2].place - 1]].op == Op::Store);
    CHECK(r.insts[r.blocks[0].insts[found[2].place]].stmt == 1);
}

TEST_CASE("the stepping profile has a safepoint before every statement", "[ir]") {
    ir::Module module = run(corpusModule("loops.rir"), {"place-safepoints"}, ir::Profile::Stepping);
    for (const ir::Routine& r : module.routines) {
        CHECK(count(r, Op::Safepoint) >= count(r, Op::Stmt));
        for (const ir::Block& block : r.blocks)
            for (size_t i = 0; i < block.insts.size(); ++i) {
                const ir::Inst& inst = r.insts[block.insts[i]];
                if (inst.op != Op::Stmt) continue;
                const ir::Inst& next = r.insts[block.insts[i + 1]];
                CHECK(next.op == Op::Safepoint);
                CHECK(next.stmt == inst.index);
            }
    }
}

TEST_CASE("the stepping profile pays the charges of the front end and nothing more", "[ir]") {
    ir::Module module = run(corpusModule("charges.rir"), {"place-safepoints"}, ir::Profile::Stepping);
    const ir::Routine& r = routine(module, "charged");
    CHECK(count(r, Op::Charge) == 3);
    for (const Found& found : safepoints(r))
        CHECK(found.cost == 0);
}

TEST_CASE("the stepping profile looks at statements only, and in cycles without one", "[ir]") {
    ir::Module loops = run(corpusModule("loops.rir"), {"place-safepoints"}, ir::Profile::Stepping);
    for (const char* name : {"counted", "while", "irreducible"})
        CHECK(count(routine(loops, name), Op::Safepoint) == count(routine(loops, name), Op::Stmt));
    ir::Module silent = run(parse(R"(
routine @"r" "r" in "M" void (bool "more") {
  b0:
    br b1
  b1:
    %0 = param 0
    condbr %0, b1, b2
  b2:
    ret
})"),
                            {"place-safepoints"}, ir::Profile::Stepping);
    CHECK(count(silent.routines[0], Op::Safepoint) == 1);
}

TEST_CASE("constants are folded as compiled code would compute them", "[ir]") {
    // 16777216 + 1 is not representable in binary32
    CHECK(foldedResult("f32", "%0 = const f32 16777216\n%1 = const f32 1\n%2 = fadd %0, %1\nret %2\n") ==
          16777216);
    CHECK(foldedResult("f64", "%0 = const f64 16777216\n%1 = const f64 1\n%2 = fadd %0, %1\nret %2\n") ==
          16777217);
    CHECK(foldedResult("f32", "%0 = const f64 0.1\n%1 = fnarrow f32 %0\nret %1\n") == 0.1f);
    CHECK(foldedInteger("i32", "%0 = const f32 1e20\n%1 = ftosi i32 %0\nret %1\n") == 2147483647);
    CHECK(foldedInteger("i32", "%0 = const f32 -2.75\n%1 = ftosi i32 %0\nret %1\n") == -2);
    CHECK(foldedInteger("i32", "%0 = const f32 nan\n%1 = ftosi i32 %0\nret %1\n") == 0);
    CHECK(foldedInteger("i32", "%0 = const i32 2147483647\n%1 = const i32 1\n%2 = iadd %0, %1\nret %2\n") ==
          -2147483648LL);
    CHECK(foldedInteger("i32", "%0 = const i32 -7\n%1 = const i32 2\n%2 = idiv %0, %1\nret %2\n") == -3);
    CHECK(foldedInteger("i32", "%0 = const i32 -7\n%1 = const i32 2\n%2 = irem %0, %1\nret %2\n") == -1);
    CHECK(foldedInteger("bool", "%0 = const i32 -1\n%1 = const i32 1\n%2 = iult %0, %1\nret %2\n") == 0);
    CHECK(foldedResult(
              "f32",
              "%0 = const bool 0\n%1 = const f32 1\n%2 = const f32 2\n%3 = select %0, %1, %2\nret %3\n") ==
          2);
}

TEST_CASE("integers are folded in their width, bit by bit", "[ir]") {
    const int64_t least = std::numeric_limits<int64_t>::min(), most = std::numeric_limits<int64_t>::max();
    CHECK(foldedPair("iadd", "i64", 9007199254740992, 1) == 9007199254740993); // not a binary64 number
    CHECK(foldedPair("iadd", "i64", most, 1) == least);
    CHECK(foldedPair("imul", "i64", 4294967296, 4294967296) == 0);
    CHECK(foldedPair("idiv", "i64", least, -1) == least);
    CHECK(foldedPair("irem", "i64", least, -1) == 0);
    CHECK(foldedPair("iadd", "i8", 127, 1) == -128);
    CHECK(foldedPair("isub", "i16", -32768, 1) == 32767);
    CHECK(foldedPair("udiv", "i8", -1, 2) == 127); // 255 / 2
    CHECK(foldedPair("urem", "i8", -1, 16) == 15);
    CHECK(foldedPair("idiv", "i8", -128, -1) == -128);
    CHECK(foldedPair("shl", "i8", 3, 7) == -128);
    CHECK(foldedPair("shl", "i8", 3, 9) == 6); // the count modulo 8
    CHECK(foldedPair("shr", "i8", -128, 7) == 1);
    CHECK(foldedPair("sar", "i8", -128, 7) == -1);
    CHECK(foldedPair("shr", "i64", -1, 63) == 1);
    CHECK(foldedPair("and", "i16", 0x0ff0, 0x00ff) == 0x00f0);
    CHECK(foldedPair("or", "i16", 0x0ff0, 0x00ff) == 0x0fff);
    CHECK(foldedPair("xor", "i16", 0x0ff0, 0x00ff) == 0x0f0f);
    CHECK(foldedPair("iugt", "i8", -1, 1, "bool") == 1); // 255 > 1
    CHECK(foldedPair("iule", "i64", least, most, "bool") == 0);
    CHECK(foldedPair("ilt", "i64", most - 1, most, "bool") == 1); // equal as binary64
    CHECK(foldedInteger("i32", "%0 = const i32 5\n%1 = not %0\nret %1\n") == -6);
    CHECK(foldedInteger("bool", "%0 = const bool 1\n%1 = not %0\nret %1\n") == 0);
    CHECK(foldedInteger("i64", "%0 = const i8 -1\n%1 = zext i64 %0\nret %1\n") == 255);
    CHECK(foldedInteger("i64", "%0 = const i8 255\n%1 = sext i64 %0\nret %1\n") == -1);
    CHECK(foldedInteger("i8", "%0 = const i32 384\n%1 = trunc i8 %0\nret %1\n") == -128);
    CHECK(foldedInteger("i8", "%0 = const f32 300\n%1 = ftoui i8 %0\nret %1\n") == -1); // 255
    CHECK(foldedInteger("i8", "%0 = const f32 -300\n%1 = ftosi i8 %0\nret %1\n") == -128);
    CHECK(foldedInteger("i64", "%0 = const f64 -1\n%1 = ftoui i64 %0\nret %1\n") == 0);
    CHECK(foldedInteger("i64", "%0 = const f64 1e30\n%1 = ftosi i64 %0\nret %1\n") == most);
    CHECK(foldedResult("f64", "%0 = const i64 -1\n%1 = uitof f64 %0\nret %1\n") == 18446744073709551616.0);
    CHECK(foldedResult("f32", "%0 = const i8 -1\n%1 = sitof f32 %0\nret %1\n") == -1);
}

TEST_CASE("a division by a constant 0 is left alone", "[ir]") {
    for (const char* op : {"idiv", "irem", "udiv", "urem"}) {
        ir::Module module = run(
            body("i32", std::string("%0 = const i32 1\n%1 = const i32 0\n%2 = ") + op + " %0, %1\nret %2\n"),
            {"fold-constants"});
        const ir::Routine& r = module.routines[0];
        CHECK(r.insts[r.insts[r.blocks[0].insts.back()].operands[0]].op != Op::Const);
    }
}

TEST_CASE("checks that hold go, checks that fail stay", "[ir]") {
    ir::Module module =
        run(body("void", "%0 = const bool 1\ncheck %0, 5\n%1 = const bool 0\ncheck %1, 6\nret\n"),
            {"fold-constants"});
    CHECK(count(module.routines[0], Op::Check) == 1);
}

TEST_CASE("unreachable and empty blocks go, markers of statements stay", "[ir]") {
    ir::Module module = parse(R"(
routine @"r" "r" in "M" f32 () {
  stmt 0 control 1:1 1:9
  b0:
    %0 = const bool 1
    condbr %0, b1, b2
  b1:
    br b3
  b2:
    %1 = const f32 2
    ret %1
  b3:
    stmt 0
    br b4
  b4:
    %2 = const f32 4
    ret %2
})");
    ir::Module simple = run(module, {"simplify-cfg", "fold-constants", "simplify-cfg"});
    const ir::Routine& r = simple.routines[0];
    CHECK(r.blocks.size() == 1);
    CHECK(count(r, Op::Stmt) == 1);
    CHECK(count(r, Op::Ret) == 1);
}

TEST_CASE("blocks that only a handler reaches stay", "[ir]") {
    ir::Module module = run(corpusModule("handlers.rir"), {"simplify-cfg"});
    const ir::Routine& r = routine(module, "trynext");
    CHECK(count(r, Op::TryNext) == 1);
    CHECK(r.statements[0].next != ir::kNone);
    CHECK(r.statements[1].next != ir::kNone);
    CHECK(routine(module, "undoes").undoHandler != ir::kNone);
}

TEST_CASE("all passes leave the corpus well formed", "[ir]") {
    for (const auto& path : rirFiles(corpusFolder())) {
        for (ir::Profile profile : {ir::Profile::Release, ir::Profile::Stepping}) {
            INFO(path);
            ir::Module module = parse(readText(path));
            if (path.filename() == "everything.rir") continue; // holds safepoints already
            ir::PassOptions options;
            options.profile = profile;
            CHECK(ir::runPasses(module, options).empty());
        }
    }
}

TEST_CASE("a broken module is reported, not transformed", "[ir]") {
    ir::Module module = parse("routine @\"r\" \"r\" in \"M\" void () {\n  b0:\n    %0 = const f32 1\n}\n");
    auto findings = ir::runPasses(module, {});
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].rfind("input: ", 0) == 0);
}

namespace {

size_t finiteChecks(const std::string& result, const std::string& lines) {
    ir::Module module = body(result, lines);
    module.overflowError = 17;
    module = run(std::move(module), {"check-overflow"});
    return count(module.routines[0], Op::CheckFinite);
}

} // namespace

TEST_CASE("a result out of range is found where it leaves its expression", "[ir]") {
    const std::string x = "    %0 = param 0\n";
    // Inner results show in the outer one: one check.
    CHECK(finiteChecks("f32", x + "    %1 = fmul %0, %0\n    %2 = fadd %1, %0\n    ret %2\n") == 1);
    // A divisor and the operands of a comparison hide it.
    CHECK(finiteChecks("f32", x + "    %1 = fmul %0, %0\n    %2 = fdiv %0, %1\n    ret %2\n") == 2);
    CHECK(finiteChecks("bool", x + "    %1 = fmul %0, %0\n    %2 = flt %1, %0\n    ret %2\n") == 1);
    // Bounded: no sum with 1 is out of range, nor a quotient by 2; the product of two halves may be.
    CHECK(finiteChecks("f32", x + "    %1 = const f32 1\n    %2 = fadd %0, %1\n    ret %2\n") == 0);
    CHECK(finiteChecks("f32", x + "    %1 = const f32 2\n    %2 = fdiv %0, %1\n    ret %2\n") == 0);
    CHECK(finiteChecks("f32", x + "    %1 = const f32 2\n    %2 = fdiv %1, %0\n    ret %2\n") == 1);
    CHECK(finiteChecks("f64", x + "    %1 = fwiden f64 %0\n    %2 = fmul %1, %1\n    ret %2\n") == 0);
    CHECK(finiteChecks("f32", x + "    %1 = fwiden f64 %0\n    %2 = fmul %1, %1\n    %3 = fnarrow f32 %2\n"
                                  "    ret %3\n") == 1);
}

TEST_CASE("checks with nothing but stores between them become one look", "[ir]") {
    const std::string lines =
        "    %0 = param 0\n    %1 = fmul %0, %0\n    checkfinite %1, 17\n    %2 = global @\"g\"\n"
        "    store f32 %1, %2\n    %3 = fadd %0, %0\n    checkfinite %3, 17\n    ret %3\n";
    const std::string global = "global @\"g\" \"g\" in \"M\" f32 var\n";
    ir::Module module =
        parse(global +
              "routine @\"r\" \"r\" in \"M\" f32 (f32 \"x\") {\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n" +
              lines + "}\n");
    module = run(std::move(module), {"merge-checks"});
    const ir::Routine& r = module.routines[0];
    REQUIRE(r.blocks.size() == 3);
    CHECK(count(r, Op::IsFinite) == 1);
    CHECK(count(r, Op::CheckFinite) == 2);
    // The way that is seldom taken: undo the store, check, store, check.
    std::vector<Op> again;
    for (const ir::ValueId id : r.blocks[2].insts)
        again.push_back(r.insts[id].op);
    CHECK(again == std::vector<Op>{Op::Store, Op::CheckFinite, Op::Store, Op::CheckFinite, Op::Br});
}

TEST_CASE("the checks of a huge routine stay where they are: no value waits for a later look", "[ir]") {
    std::string lines = "    %0 = param 0\n";
    for (int i = 1; i <= 30'000; ++i)
        lines +=
            "    %" + std::to_string(i) + " = fmul %0, %0\n    checkfinite %" + std::to_string(i) + ", 17\n";
    const ir::Module module = run(body("f32", lines + "    ret %0\n"), {"merge-checks"});
    CHECK(module.routines[0].blocks.size() == 1);
}

TEST_CASE("a module without overflow keeps infinities", "[ir]") {
    ir::Module module =
        run(body("f32", "    %0 = param 0\n    %1 = fmul %0, %0\n    ret %1\n"), {"check-overflow"});
    CHECK(count(module.routines[0], Op::CheckFinite) == 0);
}

namespace {

/// A loop that stores `lines` (whose result is %9) to a local that begins with 1; %5 is what it holds, %6 the parameter.
size_t checksInLoop(const std::string& lines, const std::string& natives = {}) {
    ir::Module module =
        parse(natives +
              "routine @\"r\" \"r\" in \"M\" f32 (f32 \"x\") {\n  local 0 f32 \"n\"\n"
              "  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n    %0 = const f32 1\n    %1 = local 0\n"
              "    store f32 %0, %1\n    br b1\n  b1:\n    %4 = local 0 !0\n    %5 = load f32 %4\n"
              "    %6 = param 0\n" +
              lines +
              "    store f32 %9, %4\n    %10 = flt %6, %0\n    condbr %10, b1, b2\n  b2:\n"
              "    %11 = local 0\n    %12 = load f32 %11\n    ret %12\n}\n");
    module.overflowError = 17;
    module = run(std::move(module), {"check-overflow"});
    return count(module.routines[0], Op::CheckFinite);
}

} // namespace

TEST_CASE("what a local can hold decides whether sums and products of it are checked", "[ir]") {
    CHECK(checksInLoop("    %7 = const f32 1\n    %9 = fadd %5, %7\n") == 0);
    CHECK(checksInLoop("    %9 = fadd %5, %5\n") == 1);
    CHECK(checksInLoop("    %7 = const f32 2\n    %9 = fmul %5, %7\n") == 1);
    // Divided again by more than it grew: bounded.
    CHECK(checksInLoop(
              "    %7 = const f32 2\n    %8 = fmul %5, %7\n    %13 = const f32 4\n    %9 = fdiv %8, %13\n") ==
          0);
    CHECK(checksInLoop("    %9 = fmul %5, %6\n") == 1);
}

TEST_CASE("a quotient by a number without fraction is not larger", "[ir]") {
    const std::string zero = "    %7 = const f32 0\n", check = "    %8 = fne %5, %7\n    check %8, 3\n";
    const std::string back = "    %9 = ftrunc %6\n";
    const auto checks = [&](const std::string& lines) { return checksInLoop(zero + lines + back); };
    CHECK(checks(check + "    %13 = fdiv %6, %5\n    %14 = feq %13, %6\n") == 0);
    // It may be 0, or have a fraction.
    CHECK(checks("    %13 = fdiv %6, %5\n    %14 = feq %13, %6\n") == 1);
    CHECK(checksInLoop(zero + check +
                       "    %13 = fdiv %6, %5\n    %14 = feq %13, %6\n    %15 = const f32 2\n" +
                       "    %9 = fdiv %5, %15\n") == 1);
}

TEST_CASE("a remainder is as small as the divisor", "[ir]") {
    const std::string product = "    %7 = const f32 1000\n    %8 = fmul %5, %7\n    %13 = const f32 7\n";
    CHECK(checksInLoop(product + "    %9 = frem %8, %13\n") == 0); // (n * 1000) MOD 7
    CHECK(checksInLoop(product + "    %14 = frem %8, %13\n    %9 = fadd %8, %14\n") > 0);
    // x MOD c of any x, and of any c.
    CHECK(checksInLoop("    %13 = const f32 7\n    %9 = frem %6, %13\n") == 0);
    CHECK(checksInLoop("    %13 = const f32 7\n    %9 = frem %13, %6\n") == 0);
}

TEST_CASE("DIV and MOD of constants are computed where the constants are exact", "[ir]") {
    const auto left = [](const std::string& a, const std::string& b) {
        ir::Module module = run(body("f32", "    %0 = const f32 " + a + "\n    %1 = const f32 " + b +
                                                "\n    %2 = fquot %0, %1\n    %3 = frem %0, %1\n"
                                                "    %4 = fadd %2, %3\n    ret %4\n"),
                                {"fold-constants"});
        return count(module.routines[0], Op::FQuot) + count(module.routines[0], Op::FRem);
    };
    CHECK(left("17", "5") == 0);
    CHECK(left("33554432", "3") == 1); // 2^25: the ratio would be rounded to the next whole number
    CHECK(left("17", "0") == 2);
}

TEST_CASE("natives are bounded as their declaration says", "[ir]") {
    const auto checks = [](const std::string& attributes) {
        return checksInLoop("    %7 = native @\"rt_f\" (%5)\n    %9 = fadd %7, %5\n",
                            "native @\"rt_f\" plain f32 (f32)" + attributes + "\n");
    };
    const std::string passed = "    %7 = native @\"rt_f\" (%6)\n    %8 = ftrunc %7\n    %9 = ftrunc %5\n";
    const auto checksOfResult = [&](const std::string& attributes) {
        return checksInLoop(passed, "native @\"rt_f\" plain f32 (f32)" + attributes + "\n");
    };
    CHECK(checks("") == 1); // the sum shows an infinity of the result
    CHECK(checks(" bounded") == 1);
    CHECK(checksOfResult("") == 1);
    CHECK(checksOfResult(" finite") == 0);
    CHECK(checksOfResult(" bounded") == 0);
    // The square of a number of 52 bits is in range, its cube is not.
    const auto checksOfPower = [](const std::string& attributes, const std::string& power) {
        return checksInLoop("    %7 = native @\"rt_f\" (%5)\n    %8 = fmul %7, %7\n" + power,
                            "native @\"rt_f\" plain f32 (f32)" + attributes + "\n");
    };
    const std::string square = "    %9 = ftrunc %8\n", cube = "    %9 = fmul %8, %7\n";
    CHECK(checksOfPower("", square) == 1);
    CHECK(checksOfPower(" whole", square) == 0);
    CHECK(checksOfPower(" whole", cube) == 1);
}

TEST_CASE("locals that others may store to are not bounded", "[ir]") {
    const auto checks = [](const std::string& more) {
        ir::Module module =
            parse("routine @\"r\" \"r\" in \"M\" f32 () {\n  local 0 f32 \"n\"" + more +
                  "\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n    %0 = const f32 1\n"
                  "    %1 = local 0\n    store f32 %0, %1\n    %2 = load f32 %1\n    %3 = fadd %2, %2\n"
                  "    ret %3\n}\n");
        module.overflowError = 17;
        module.routines[0].sharedLocals = more.empty() ? std::vector<uint32_t>{} : std::vector<uint32_t>{0};
        module = run(std::move(module), {});
        ir::checkOverflow(module, module.routines[0]);
        return count(module.routines[0], Op::CheckFinite);
    };
    CHECK(checks("") == 0);
    CHECK(checks(" ") == 1); // a detached handler gets its address
}
