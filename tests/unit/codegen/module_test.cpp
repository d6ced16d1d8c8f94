// The self-description of a compiled module: the program description, symbols, debug lines, objects.

#include <cstring>
#include <filesystem>

#include "ir/passes/passes.h"
#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"
#include "tests/unit/temporary_folder.h"

using namespace codegen_testing;
using ir_testing::corpusModule;
using ir_testing::readText;

namespace {

ir::Module prepared(const std::string& name) {
    ir::Module module = corpusModule(name);
    REQUIRE(ir::runPasses(module, {}).empty());
    return module;
}

} // namespace

TEST_CASE("the program description lists the contents of the module", "[codegen]") {
    ir::Module module = corpusModule("everything.rir");
    // External data come from outside; the test supplies them.
    static int32_t external = 5;
    codegen::CodegenOptions options;
    std::vector<codegen::NativeSymbol> table = symbols();
    table.push_back({"ext", &external});
    std::string error;
    auto program = codegen::jit(module, options, table, error);
    INFO(error);
    REQUIRE(program);
    const rt::ProgramDesc& desc = *program->program();
    CHECK(std::string(desc.name) == "every \"thing\"");
    REQUIRE(desc.taskCount == 2);
    CHECK(std::string(desc.tasks[0].name) == "T");
    CHECK(desc.tasks[0].motionTask == 1);
    CHECK(desc.tasks[0].reset == nullptr);
    CHECK(std::string(desc.tasks[1].type) == "SEMISTATIC");
    CHECK(desc.tasks[1].reset != nullptr);
    REQUIRE(desc.externalCount == 1);
    CHECK(std::string(desc.externals[0].kind) == "signaldo");
    CHECK(desc.externals[0].slot == global(*program, "do1"));
    CHECK(desc.externals[0].column == 3);
    CHECK(std::string_view(desc.sources, desc.sourcesSize) == std::string_view("\xa2\0\xff, any bytes", 14));
    REQUIRE(desc.moduleCount == 1);
    REQUIRE(desc.modules[0].gone);
    CHECK(*desc.modules[0].gone == 0);
    REQUIRE(desc.configCount == 1);
    CHECK(std::string(desc.configNames[0]) == "EIO");
    CHECK(std::string(desc.configTexts[0]) == "EIO:CFG_1.0\n# text\n");
    REQUIRE(desc.routineCount == 1);
    const rt::RoutineDesc& main = *desc.routines[0].desc;
    CHECK(desc.routines[0].task == 0);
    CHECK(std::string(main.name) == "main");
    CHECK(std::string(main.file) == "dir/every.modx");
    CHECK(main.hasErrorHandler == 1);
    CHECK(main.hasUndo == 1);
    CHECK(main.noStepIn == 1);
    REQUIRE(main.errorFilterCount == 4);
    CHECK(main.errorFilter[1] == -12);
    CHECK(main.errorFilter[2] == rt::kAllErrors);
    CHECK(main.errorFilter[3] == rt::kOtherErrors);
    REQUIRE(main.statementCount == 6);
    CHECK(main.statements[2].line == 13);
    CHECK(main.statements[2].kind == static_cast<uint8_t>(ir::StmtKind::Motion));
    CHECK(main.statements[0].handled == 1);
    const auto* p = static_cast<const float*>(global(*program, "p"));
    CHECK(p[1] == -2.0f);
    for (uint32_t i = 0; i < desc.globalCount; ++i) {
        if (std::string(desc.globals[i].name) != "p") continue;
        CHECK(desc.globals[i].kind == static_cast<uint8_t>(ir::GlobalKind::Persistent));
        CHECK(desc.globals[i].task == -1);
        CHECK(std::string(desc.globals[i].file) == "other.sysx");
        CHECK(desc.globals[i].line == 4);
        CHECK(std::string(desc.globals[i].type->name) == "pos");
    }
}

TEST_CASE("data of other modules are reached by name, and names of C functions do no harm", "[codegen]") {
    ir::Module module = ir_testing::parse(R"(
type 9 array f32 [100]
global @"elsewhere" "elsewhere" in "" f32 external
global @"memcpy" "memcpy" in "M" %9 var = { f32 1, zero 98 f32, f32 5 }
global @"rt_raise" "x" in "M" %9 var
native @"rt_void" plain void ()
routine @"memset" "r" in "M" exported f32 () {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %to = global @"rt_raise"
    %from = global @"memcpy"
    native @"rt_void" ()
    copy %9 %to, %from
    %i = const i32 99
    %last = elem f32 %to, %i
    %x = load f32 %last
    %there = global @"elsewhere"
    %y = load f32 %there
    %z = fadd %x, %y
    store f32 %z, %there
    ret %z
})");
    REQUIRE(ir::runPasses(module, {}).empty());
    static float elsewhere = 37;
    for (bool optimise : {false, true}) {
        elsewhere = 37;
        std::vector<codegen::NativeSymbol> table = symbols();
        std::string error;
        codegen::CodegenOptions options;
        options.optimise = optimise;
        CHECK(codegen::jit(module, options, table, error) == nullptr);
        CHECK(error.find("elsewhere") != std::string::npos);
        table.push_back({"elsewhere", &elsewhere});
        auto program = codegen::jit(module, options, table, error);
        REQUIRE(program);
        using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*, float*);
        float result = 0;
        Task task;
        CHECK(reinterpret_cast<Function>(entry(*program, "r"))(&task.core, nullptr, &result) == rt::kOk);
        CHECK(result == 42.0f);
        CHECK(elsewhere == 42.0f);
    }
}

TEST_CASE("symbols that nobody supplies are named", "[codegen]") {
    ir::Module module = prepared("handlers.rir");
    std::vector<codegen::NativeSymbol> table;
    for (const codegen::NativeSymbol& symbol : symbols())
        if (symbol.name != "rt_note" && symbol.name != "rt_retry") table.push_back(symbol);
    std::string error;
    CHECK(codegen::jit(module, {}, table, error) == nullptr);
    CHECK(error.find("rt_note") != std::string::npos);
    CHECK(error.find("rt_retry") != std::string::npos);
    CHECK(error.find("rt_fallible") == std::string::npos);
}

TEST_CASE("objects are written, the same bytes each time, with lines of the source", "[codegen]") {
    TemporaryFolder folder;
    ir::Module module = prepared("fib.rir");
    std::string first = folder.path / "a.o", second = folder.path / "b.o", error;
    REQUIRE(codegen::emitObject(module, first, {}, error));
    REQUIRE(codegen::emitObject(module, second, {}, error));
    std::string bytes = readText(first);
    CHECK(bytes.substr(0, 4) == "\177ELF");
    CHECK(bytes == readText(second));
    CHECK(bytes.find(".debug_line") != std::string::npos);
    CHECK(bytes.find("rapidc_program") != std::string::npos);
    CHECK_FALSE(codegen::emitObject(module, folder.path / "missing" / "a.o", {}, error));
    CHECK(error.find("cannot write") == 0);
}

TEST_CASE("a linked executable runs", "[codegen]") {
    TemporaryFolder folder;
    ir::Module module = prepared("fib.rir");
    std::string object = folder.path / "fib.o", host = folder.path / "host.cpp",
                executable = folder.path / "fib", error;
    REQUIRE(codegen::emitObject(module, object, {}, error));
    {
        std::ofstream source(host);
        source << R"(#include "runtime/abi/rt_abi.h"
#include <cstdio>
extern "C" {
extern const rt::ProgramDesc rapidc_program;
rt::Status rt_safepoint(rt::TaskCore* task, rt::Frame*) { task->budget = 1 << 20; return 0; }
rt::Status rt_stackOverflow(rt::TaskCore*, rt::Frame*) { return -1; }
}
int main() {
    rt::TaskCore task{};
    char here;
    task.stackLimit = &here - (1 << 20);
    if (rapidc_program.tasks[0].entry(&task, nullptr) != 0) return 1;
    std::printf("%g\n", *static_cast<float*>(rapidc_program.globals[0].address));
    return *static_cast<float*>(rapidc_program.globals[0].address) == 832040.0f ? 0 : 2;
}
)";
    }
    codegen::LinkOptions options;
    options.extraArguments = {"-x", "c++", host, std::string("-I") + RAPIDC_SOURCE_DIR};
    REQUIRE(codegen::linkExecutable({object}, executable, options, error));
    CHECK(std::system((executable + " > " + (folder.path / "out").string()).c_str()) == 0);
    CHECK(readText(folder.path / "out") == "832040\n");
}

TEST_CASE("linking says what is missing", "[codegen]") {
    std::string error;
    codegen::LinkOptions options;
    options.driver = "no-such-driver-anywhere";
    CHECK_FALSE(codegen::linkExecutable({"a.o"}, "a", options, error));
    CHECK(error == "the linker driver 'no-such-driver-anywhere' was not found");
    options.driver.clear();
    options.libraries = {"/no/such/library.a"};
    CHECK_FALSE(codegen::linkExecutable({"a.o"}, "a", options, error));
    CHECK(error.find("/no/such/library.a") != std::string::npos);
    options.libraries.clear();
    CHECK_FALSE(codegen::linkExecutable({"/no/such/object.o"}, "/tmp/never", options, error));
    CHECK(error.find("linking failed") == 0);
}

TEST_CASE("LLVM IR and assembly can be shown", "[codegen]") {
    ir::Module module = prepared("float_array.rir");
    std::string error;
    std::string text = codegen::emitLlvm(module, {}, error);
    CHECK(text.find("rapidc_program") != std::string::npos);
    CHECK(text.find("<4 x float>") != std::string::npos); // the checked inner loop is vectorised
    CHECK(text.find("DILocation(line: 8") != std::string::npos);
    std::string assembly = codegen::emitAsm(module, {}, error);
    CHECK(assembly.find("mulps") != std::string::npos);
    CHECK(assembly.find("vfmadd") == std::string::npos);
    CHECK(error.empty());
}
