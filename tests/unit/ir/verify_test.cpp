// Each file of tests/ir/verify breaks rules; its lines "; finding: TEXT" say which findings it must give, all of them.

#include "ir/verify/verify.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;

TEST_CASE("broken modules give exactly the findings they announce", "[ir]") {
    for (const auto& path : rirFiles(corpusFolder() / "verify")) {
        INFO(path);
        std::string text = readText(path);
        std::vector<std::string> expected;
        std::istringstream lines(text);
        const std::string mark = "; finding: ";
        for (std::string line; std::getline(lines, line);)
            if (line.rfind(mark, 0) == 0) expected.push_back(line.substr(mark.size()));
        REQUIRE_FALSE(expected.empty());
        std::vector<std::string> findings = ir::verify(parse(text));
        std::string all;
        for (const std::string& finding : findings)
            all += finding + "\n";
        INFO(all);
        CHECK(findings.size() == expected.size());
        for (const std::string& wanted : expected) {
            INFO(wanted);
            CHECK(all.find(wanted) != std::string::npos);
        }
    }
}

TEST_CASE("damage that the text cannot express is found", "[ir]") {
    ir::Module good = corpusModule("loops.rir");
    REQUIRE(ir::verify(good).empty());
    SECTION("an instruction that is in two blocks") {
        ir::Module bad = good;
        ir::Routine& r = bad.routines[0];
        r.blocks[2].insts.insert(r.blocks[2].insts.begin(), r.blocks[0].insts[0]);
        CHECK_FALSE(ir::verify(bad).empty());
    }
    SECTION("an operand out of range") {
        ir::Module bad = good;
        for (ir::Inst& inst : bad.routines[0].insts)
            if (inst.op == ir::Op::Store) inst.operands[0] = 100000;
        CHECK_FALSE(ir::verify(bad).empty());
    }
    SECTION("a block without instructions") {
        ir::Module bad = good;
        bad.routines[0].blocks[3].insts.clear();
        CHECK_FALSE(ir::verify(bad).empty());
    }
    SECTION("a type made of itself") {
        ir::Module bad = good;
        bad.addRecord("loop", {{"self", static_cast<ir::TypeId>(bad.types.size())}});
        CHECK_FALSE(ir::verify(bad).empty());
    }
    SECTION("a type that is too large") {
        ir::Module bad = good;
        bad.arrayOf(ir::kF64, {100000, 100000, 100000});
        CHECK_FALSE(ir::verify(bad).empty());
    }
}
