// The textual form: print -> parse -> print, and the errors of the parser.

#include <set>

#include "ir/core/op_info.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir/ir_testing.h"

using namespace ir_testing;

namespace {

std::string parseError(const std::string& text) {
    ir::Module module;
    std::string error;
    REQUIRE_FALSE(ir::parseModule(text, module, error));
    return error;
}

} // namespace

TEST_CASE("every module of the corpus survives print, parse, print", "[ir]") {
    for (const auto& path : rirFiles(corpusFolder())) {
        INFO(path);
        ir::Module first = parse(readText(path));
        CHECK(ir::verify(first) == std::vector<std::string>{});
        std::string printed = ir::printModule(first);
        ir::Module second = parse(printed);
        CHECK(ir::printModule(second) == printed);
    }
}

TEST_CASE("the corpus holds every instruction", "[ir]") {
    std::set<std::string_view> seen;
    for (const auto& path : rirFiles(corpusFolder())) {
        ir::Module module = parse(readText(path));
        for (const ir::Routine& routine : module.routines)
            for (const ir::Inst& inst : routine.insts)
                seen.insert(ir::opInfo(inst.op).name);
    }
    std::vector<std::string_view> all = {
#define INST(family, name, text, form, operands, result, flags) #name,
#include "ir/core/instructions.def"
    };
    for (std::string_view name : all) {
        INFO(name);
        CHECK(seen.count(name) == 1);
    }
}

TEST_CASE("printing keeps what the text said", "[ir]") {
    ir::Module module = corpusModule("everything.rir");
    CHECK(module.name == "every \"thing\"");
    CHECK(module.files == std::vector<std::string>{"dir/every.modx", "other.sysx"});
    CHECK(module.types[11].dims == std::vector<int32_t>{2, 3});
    const ir::Global& constant = module.globals[2];
    REQUIRE(constant.init.size() == 7);
    CHECK(constant.init[2].text == "a\"b\n");
    CHECK(constant.init[5].kind == ir::TypeKind::F32);
    CHECK(constant.init[6].kind == ir::TypeKind::I64);
    CHECK(module.globals[8].init[2].integer == -9007199254740993); // not a binary64 number
    const ir::Routine& main = routine(module, "T/M/main");
    CHECK(main.noStepIn);
    CHECK(main.errorFilter == std::vector<int32_t>{11, -12, ir::kEveryError, ir::kOwnErrors});
    CHECK(main.statements[0].handled);
    CHECK(main.statements[0].next == 2);
    CHECK(main.statements[2].kind == ir::StmtKind::Motion);
    CHECK(module.externals[0].global == 5);
    CHECK(module.externals[0].column == 3);
    CHECK(module.tasks[1].kind == "SEMISTATIC");
    CHECK(module.tasks[1].reset == module.findRoutine("T/M/main"));
    CHECK(module.configTexts[0] == "EIO:CFG_1.0\n# text\n");
}

TEST_CASE("a module made by the builder survives print, parse, print", "[ir]") {
    ir::Module module;
    module.name = "built";
    ir::TypeId pos = module.addRecord("pos", {{"x", ir::kF32}, {"y", ir::kF32}});
    ir::TypeId array = module.arrayOf(pos, {4});
    CHECK(module.arrayOf(pos, {4}) == array);
    module.routines.emplace_back();
    ir::Routine& made = module.routines.back();
    made.name = made.displayName = "sum";
    made.result = ir::kF32;
    made.params = {{"data", ir::kPtr}, {"index", ir::kI32}};
    ir::Builder b(module, made);
    b.setBlock(b.addBlock("entry"));
    ir::Statement statement;
    statement.line = 3;
    b.setStatement(b.addStatement(statement));
    ir::ValueId inRange = b.binary(ir::Op::IULt, b.param(1), b.constI32(4));
    b.check(inRange, 12);
    ir::ValueId element = b.elemAddr(pos, b.param(0), b.param(1));
    ir::ValueId x = b.load(ir::kF32, b.fieldAddr(pos, element, 0));
    ir::ValueId y = b.load(ir::kF32, b.fieldAddr(pos, element, 1));
    b.ret(b.binary(ir::Op::FAdd, x, y));
    CHECK(b.terminated());
    CHECK(ir::verify(module).empty());
    std::string printed = ir::printModule(module);
    CHECK(ir::printModule(parse(printed)) == printed);
}

TEST_CASE("sizes and offsets are those of C", "[ir]") {
    ir::Module module;
    struct Mixed {
        bool flag;
        double wide;
        struct {
            uint32_t length;
            char bytes[80];
        } text;
        float x;
    };
    ir::TypeId mixed = module.addRecord(
        "mixed", {{"flag", ir::kBool}, {"wide", ir::kF64}, {"text", module.stringOf(80)}, {"x", ir::kF32}});
    CHECK(module.size(mixed) == sizeof(Mixed));
    CHECK(module.align(mixed) == alignof(Mixed));
    CHECK(module.fieldOffset(mixed, 1) == offsetof(Mixed, wide));
    CHECK(module.fieldOffset(mixed, 2) == offsetof(Mixed, text));
    CHECK(module.fieldOffset(mixed, 3) == offsetof(Mixed, x));
    CHECK(module.size(module.arrayOf(mixed, {2, 3})) == 6 * sizeof(Mixed));
    CHECK(module.size(module.stringOf(80)) == 84);
    CHECK(module.size(module.stringOf(5)) == 12); // 4 + 5, to a multiple of 4
    CHECK(module.align(module.stringOf(5)) == 4);
    CHECK(module.stringOf(80) == module.stringOf(80));
}

TEST_CASE("errors of the parser name the place and what was expected", "[ir]") {
    CHECK(
        parseError("nonsense") ==
        "1:1: 'nonsense' where module, file, folder, sources, overflow, type, desc, global, native, routine, "
        "external, alias, task, source, search, within, named or config is expected");
    CHECK(parseError("module \"open\n") == "1:8: string without closing quote");
    CHECK(parseError("module \"a\\q\"") == "1:8: '\\' in a string must be followed by two hex digits");
    CHECK(parseError("file 3 \"x\"") == "1:6: file 0 is expected here");
    CHECK(parseError("type 9 array f32 [0]") == "1:19: '0' is outside 1 to 2147483647");
    CHECK(parseError("type 9 array %10 [1]") == "1:14: there is no type %10 so far");
    std::string head = "routine @\"r\" \"r\" in \"M\" void () {\n";
    CHECK(parseError(head + "  b0:\n    fadd %0, %1\n}\n") == "3:10: %0 is not defined in this routine");
    CHECK(parseError(head + "  b0:\n    bogus\n}\n") == "3:5: 'bogus' where an instruction is expected");
    CHECK(parseError(head + "  b1:\n    ret\n}\n") == "2:3: block b0 is expected here");
    CHECK(parseError(head + "  b0:\n    call @\"x\" ()\n    ret\n}\n") == "3:10: there is no routine @\"x\"");
    CHECK(parseError(head + "  b0:\n    %0 = const f32 1\n    %0 = const f32 1\n    ret\n}\n") ==
          "4:5: %0 has been defined before");
    CHECK(parseError(head + "  b0:\n    ret\n") == "4:1: end of text where '}' is expected");
    CHECK(parseError(head + "  b0:\n    %0 = const f32\n") == "3:19: end of line where a number is expected");
    CHECK(parseError(head + "  b0:\n    %0 = const i8 256\n") == "3:19: '256' does not fit in 8 bits");
    CHECK(parseError(head + "  b0:\n    %0 = const i8 -129\n") == "3:19: '-129' does not fit in 8 bits");
    CHECK(parseError(head + "  b0:\n    %0 = const i64 1.5\n") == "3:20: '1.5' where an integer is expected");
    CHECK(parseError(head + "  b0:\n    %0 = const i64 18446744073709551616\n") ==
          "3:20: '18446744073709551616' does not fit in 64 bits");
}

TEST_CASE("no prefix of a text makes the parser crash", "[ir]") {
    std::string text = readText(corpusFolder() / "everything.rir");
    for (size_t length = 0; length < text.size(); length += 7) {
        ir::Module module;
        std::string error;
        bool ok = ir::parseModule(std::string_view(text).substr(0, length), module, error);
        CHECK(ok == error.empty());
    }
}
