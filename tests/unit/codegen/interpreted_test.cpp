// Interpreted routines compute what machine code computes (ir/LANGREF.md: integers wrap, conversions saturate, NaN gives 0). The
// operations are compared with those of compiled code, which have tests of their own.

#include <cstring>
#include <limits>

#include "codegen/routine_words.h"
#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"

using namespace codegen_testing;
using ir_testing::corpusModule;
using ir_testing::parse;

namespace {

template <class T, class R> using Binary = rt::Status (*)(rt::TaskCore*, rt::Frame*, R* result, T a, T b);

std::string binary(const std::string& type, const std::string& result, const std::string& lines) {
    return "routine @\"r\" \"r\" in \"M\" exported " + result + " (" + type + " \"a\", " + type +
           " \"b\") {\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n    %a = param 0\n    %b = param 1\n" +
           lines + "    ret %r\n}\n";
}

template <class T, class R> R call(const codegen::JitProgram& program, T a, T b) {
    Task task;
    R result{};
    CHECK(reinterpret_cast<Binary<T, R>>(entry(program, "r"))(&task.core, nullptr, &result, a, b) == rt::kOk);
    return result;
}

template <class R> bool sameBits(R a, R b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

template <class T, class R = T>
void compare(const std::string& type, const std::string& result, const std::string& lines,
             const std::vector<T>& values) {
    const std::string text = binary(type, result, lines);
    const auto compiled = compile(parse(text)), interpreted = compile(parse(text), true, true);
    for (const T a : values)
        for (const T b : values) {
            INFO(lines << " of " << a << " and " << b);
            CHECK(sameBits(call<T, R>(*interpreted, a, b), call<T, R>(*compiled, a, b)));
        }
}

template <class T> std::vector<T> integers() {
    using Limits = std::numeric_limits<T>;
    return {0, 1, -1, 7, -9, 33, Limits::max(), Limits::min(), Limits::max() - 1};
}

} // namespace

TEST_CASE("interpreted integers wrap as compiled ones do", "[codegen][interpreted]") {
    const std::string safe = "%one = const TYPE 1\n%nonzero = or %b, %one\n";
    for (const char* op :
         {"iadd", "isub", "imul", "and", "or", "xor", "shl", "shr", "sar", "idiv", "irem", "udiv", "urem"}) {
        const std::string lines = safe + "%r = " + op + " %a, %nonzero\n";
        std::string narrow = lines, wide = lines;
        narrow.replace(narrow.find("TYPE"), 4, "i32");
        wide.replace(wide.find("TYPE"), 4, "i64");
        compare<int32_t>("i32", "i32", narrow, integers<int32_t>());
        compare<int64_t>("i64", "i64", wide, integers<int64_t>());
    }
    compare<int32_t>("i32", "i32", "%c = ineg %a\n%d = not %b\n%r = iadd %c, %d\n", integers<int32_t>());
}

TEST_CASE("interpreted comparisons and choices", "[codegen][interpreted]") {
    for (const char* op : {"ieq", "ine", "ilt", "ile", "igt", "ige", "iult", "iule", "iugt", "iuge"})
        compare<int32_t, uint8_t>("i32", "bool", std::string("%r = ") + op + " %a, %b\n",
                                  integers<int32_t>());
    const std::vector<float> numbers{0.0f, -0.0f, 1.5f, -2.25f, 1e30f, 3e9f, -3e9f};
    for (const char* op : {"feq", "fne", "flt", "fle", "fgt", "fge"})
        compare<float, uint8_t>("f32", "bool", std::string("%r = ") + op + " %a, %b\n", numbers);
    compare<float>("f32", "f32", "%c = flt %a, %b\n%n = not %c\n%r = select %n, %a, %b\n", numbers);
}

TEST_CASE("interpreted numbers and conversions", "[codegen][interpreted]") {
    const float infinite = std::numeric_limits<float>::infinity();
    const std::vector<float> numbers{0.0f,   -0.0f, 1.5f,        -2.75f,   1e30f,
                                     -1e30f, 3e9f,  16777217.0f, infinite, -infinite};
    for (const char* op : {"fadd", "fsub", "fmul", "fdiv"})
        compare<float>("f32", "f32", std::string("%r = ") + op + " %a, %b\n", numbers);
    compare<float>("f32", "f32", "%c = fneg %a\n%d = ftrunc %b\n%r = fadd %c, %d\n", numbers);
    compare<float, uint8_t>("f32", "bool", "%c = fsub %a, %b\n%r = isfinite %c\n", numbers);
    for (const char* to : {"i8", "i16", "i32", "i64"})
        for (const char* op : {"ftosi", "ftoui"}) {
            const std::string narrow = std::string("%c = fsub %a, %b\n%d = ") + op + " " + to + " %c\n";
            const bool isWide = std::string(to) == "i64";
            compare<float, int64_t>(
                "f32", "i64",
                narrow + (isWide ? "%z = const i64 0\n%r = iadd %d, %z\n" : "%r = zext i64 %d\n"), numbers);
        }
    compare<double, double>("f64", "f64", "%c = fnarrow f32 %a\n%d = fwiden f64 %c\n%r = fmul %d, %b\n",
                            {0.1, -7.25, 1e-40, 1e300});
    for (const char* op : {"sitof", "uitof"})
        compare<int64_t, float>("i64", "f32", std::string("%c = isub %a, %b\n%r = ") + op + " f32 %c\n",
                                integers<int64_t>());
    compare<int32_t, int64_t>("i32", "i64",
                              "%c = trunc i8 %a\n%d = sext i64 %c\n%e = zext i64 %b\n%r = iadd %d, %e\n",
                              integers<int32_t>());
}

TEST_CASE("interpreted routines call each other, loop, and use memory", "[codegen][interpreted]") {
    auto program = compile(corpusModule("fib.rir"), true, true);
    auto compiled = compile(corpusModule("fib.rir"));
    CHECK(program->program()->routineCount == compiled->program()->routineCount);
}

TEST_CASE("values of one block share slots: a long routine needs no more memory than a short one",
          "[codegen][interpreted]") {
    const auto bytes = [](int additions) {
        std::string lines = "%v0 = iadd %a, %b\n";
        for (int i = 0; i < additions; ++i)
            lines += "%v" + std::to_string(i + 1) + " = iadd %v" + std::to_string(i) + ", %v0\n";
        const ir::Module module = parse(binary("i32", "i32", lines + "%r = iadd %v0, %v0\n"));
        return codegen::WordWriter(module, module.routines[0], 0).run().bytes;
    };
    CHECK(bytes(1000) == bytes(3));
}
