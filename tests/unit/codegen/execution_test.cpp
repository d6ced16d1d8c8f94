// Compiled code, executed: values, memory, calls, safepoints.

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"

using namespace codegen_testing;
using ir_testing::corpusModule;
using ir_testing::parse;

namespace {

template <class T> using Unary = rt::Status (*)(rt::TaskCore*, rt::Frame*, T* result, T argument);

/// A module with one exported routine `r` that computes from one parameter; both have type `type`.
std::string unary(const std::string& type, const std::string& lines) {
    return "routine @\"r\" \"r\" in \"M\" exported " + type + " (" + type +
           " \"x\") {\n  stmt 0 plain 1:1 1:2\n  b0:\n    stmt 0\n    %x = param 0\n" + lines + "}\n";
}

template <class T>
T evaluate(const std::string& type, const std::string& lines, T argument, bool optimise = true) {
    auto program = compile(parse(unary(type, lines)), optimise);
    Task task;
    T result{};
    rt::Status status =
        reinterpret_cast<Unary<T>>(entry(*program, "r"))(&task.core, nullptr, &result, argument);
    CHECK(status == rt::kOk);
    return result;
}

} // namespace

TEST_CASE("recursion on num gives the same with and without optimisation", "[codegen]") {
    for (bool optimise : {false, true}) {
        auto program = compile(corpusModule("fib.rir"), optimise);
        REQUIRE(program->program()->taskCount == 1);
        Task task;
        task.core.budget = std::numeric_limits<int64_t>::max();
        CHECK(program->program()->tasks[0].entry(&task.core, nullptr) == rt::kOk);
        CHECK(*static_cast<float*>(global(*program, "answer")) == 832040.0f);
        CHECK(events.empty());
    }
}

TEST_CASE("arrays are computed in place and bounds are checked", "[codegen]") {
    auto program = compile(corpusModule("float_array.rir"));
    auto* a = static_cast<float*>(global(*program, "a"));
    auto* b = static_cast<float*>(global(*program, "b"));
    for (int i = 0; i < 1000; ++i)
        b[i] = static_cast<float>(i);
    Task task;
    task.core.budget = std::numeric_limits<int64_t>::max();
    CHECK(program->program()->tasks[0].entry(&task.core, nullptr) == rt::kOk);
    // a := a / 2 + b converges to 2 b
    CHECK(a[0] == 0.0f);
    CHECK(a[500] == Approx(1000.0f));
    CHECK(a[999] == Approx(1998.0f));

    *static_cast<float*>(global(*program, "n")) = 1001;
    CHECK(program->program()->tasks[0].entry(&task.core, nullptr) == 55);
    REQUIRE(events.size() == 1);
    CHECK(events[0] == "raise 55 at 2 in main");
}

TEST_CASE("integer arithmetic is defined for every operand", "[codegen]") {
    const int32_t least = std::numeric_limits<int32_t>::min();
    std::string divide = "%a = const i32 -1\n%b = ineg %a\n%c = isub %a, %b\n%d = iadd %c, %b\n";
    for (bool optimise : {false, true}) {
        CHECK(evaluate<int32_t>("i32", divide + "%q = idiv %x, %d\nret %q\n", least, optimise) == least);
        CHECK(evaluate<int32_t>("i32", "%q = idiv %x, %x\nret %q\n", -9, optimise) == 1);
        CHECK(evaluate<int32_t>("i32", "%m = const i32 -1\n%q = irem %x, %m\nret %q\n", least, optimise) ==
              0);
        CHECK(evaluate<int32_t>("i32", "%m = const i32 4\n%q = irem %x, %m\nret %q\n", -7, optimise) == -3);
        CHECK(evaluate<int32_t>("i32", "%m = const i32 1\n%q = isub %x, %m\nret %q\n", least, optimise) ==
              std::numeric_limits<int32_t>::max());
    }
}

TEST_CASE("integers of every width compute the same with and without optimisation", "[codegen]") {
    const auto pair = [](const std::string& op, int64_t b) {
        return "%b = const i64 " + std::to_string(b) + "\n%q = " + op + " %x, %b\nret %q\n";
    };
    const auto narrow = [](const std::string& type, const std::string& op, int64_t b,
                           const std::string& back) {
        return "%a = trunc " + type + " %x\n%b = const " + type + " " + std::to_string(b) + "\n%c = " + op +
               " %a, %b\n%q = " + back + " i64 %c\nret %q\n";
    };
    const int64_t least = std::numeric_limits<int64_t>::min(), most = std::numeric_limits<int64_t>::max();
    for (bool optimise : {false, true}) {
        const auto value = [&](const std::string& lines, int64_t x) {
            return evaluate<int64_t>("i64", lines, x, optimise);
        };
        CHECK(value(pair("iadd", 9007199254740993), 0) == 9007199254740993);
        CHECK(value(pair("iadd", 1), most) == least);
        CHECK(value(pair("udiv", 10), -1) == 1844674407370955161);
        CHECK(value(pair("urem", 10), -1) == 5);
        CHECK(value(pair("shl", 65), 3) == 6); // the count modulo 64
        CHECK(value(pair("shr", 60), least) == 8);
        CHECK(value(pair("sar", 60), least) == -8);
        CHECK(value(pair("and", 0xff00), 0x1234) == 0x1200);
        CHECK(value(pair("or", 0xff00), 0x1234) == 0xff34);
        CHECK(value(pair("xor", -1), 5) == -6);
        CHECK(value("%q = not %x\nret %q\n", 5) == -6);
        CHECK(value(narrow("i8", "iadd", 1, "sext"), 127) == -128);
        CHECK(value(narrow("i8", "iadd", 1, "zext"), 127) == 128);
        CHECK(value(narrow("i8", "udiv", 2, "zext"), 255) == 127);
        CHECK(value(narrow("i8", "idiv", -1, "sext"), -128) == -128);
        CHECK(value(narrow("i16", "shr", 15, "zext"), 0x8000) == 1);
        CHECK(value(narrow("i16", "sar", 15, "sext"), 0x8000) == -1);
        CHECK(value(narrow("i16", "shl", 17, "zext"), 0x4001) == 0x8002);
        CHECK(value("%b = const i64 1\n%c = iugt %x, %b\n%q = select %c, %x, %b\nret %q\n", -1) == -1);
        CHECK(value("%b = const i64 -1\n%c = iuge %x, %b\n%q = select %c, %x, %b\nret %q\n", 7) == -1);
        CHECK(value("%b = const i64 -1\n%c = iule %x, %b\n%q = select %c, %x, %b\nret %q\n", 7) == 7);
        CHECK(value("%f = uitof f64 %x\n%q = ftoui i64 %f\nret %q\n", least) == least);
        CHECK(value("%f = sitof f32 %x\n%n = ftoui i8 %f\n%q = zext i64 %n\nret %q\n", 300) == 255);
        CHECK(value("%f = sitof f32 %x\n%n = ftosi i16 %f\n%q = sext i64 %n\nret %q\n", -40000) == -32768);
    }
}

TEST_CASE("integers of every width lie in memory as in C", "[codegen]") {
    auto program = compile(parse(R"(
type 9 record "ints" { i8 "small", i16 "middle", i64 "large" }
desc 0 "ints" base "ints" other %9
global @"g" "g" in "M" %9 var desc 0 = { i8 200, i16 -32768, i64 -9007199254740993 }
routine @"r" "r" in "M" exported i64 (i64 "x") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %g = global @"g"
    %small = field %9 %g, 0
    %a = load i8 %small
    %middle = field %9 %g, 1
    %b = load i16 %middle
    %c = zext i64 %a
    %d = sext i64 %b
    %e = iadd %c, %d
    %x = param 0
    %n = trunc i16 %x
    store i16 %n, %middle
    ret %e
})"));
    struct Ints {
        int8_t small;
        int16_t middle;
        int64_t large;
    };
    REQUIRE(program->program()->globals[0].type->size == sizeof(Ints));
    const auto* g = static_cast<const Ints*>(program->program()->globals[0].address);
    CHECK(g->large == -9007199254740993);
    Task task;
    int64_t result = 0;
    CHECK(reinterpret_cast<Unary<int64_t>>(entry(*program, "r"))(&task.core, nullptr, &result, 0x12345) ==
          rt::kOk);
    CHECK(result == 200 - 32768);
    CHECK(g->small == int8_t(200));
    CHECK(g->middle == 0x2345);
}

TEST_CASE("conversions go toward zero and saturate", "[codegen]") {
    std::string lines = "%i = ftosi i32 %x\n%f = sitof f32 %i\nret %f\n";
    CHECK(evaluate<float>("f32", lines, 2.75f) == 2.0f);
    CHECK(evaluate<float>("f32", lines, -2.75f) == -2.0f);
    CHECK(evaluate<float>("f32", lines, 1e20f) == 2147483648.0f);
    CHECK(evaluate<float>("f32", lines, -1e20f) == -2147483648.0f);
    CHECK(evaluate<float>("f32", lines, std::nanf("")) == 0.0f);
    CHECK(evaluate<double>("f64", "%t = ftrunc %x\nret %t\n", -3.9) == -3.0);
    CHECK(evaluate<double>("f64", "%n = fnarrow f32 %x\n%w = fwiden f64 %n\nret %w\n", 0.1) == double(0.1f));
}

TEST_CASE("multiplication and addition are not contracted", "[codegen]") {
    // x * x + c with a fused operation keeps the bits that rounding x * x drops.
    float x = 1.0f + 1.0f / 4096;
    volatile float square = x * x;
    std::string lines = "%c = const f32 -1.00048828125\n%s = fmul %x, %x\n%r = fadd %s, %c\nret %r\n";
    CHECK(evaluate<float>("f32", lines, x) == square - 1.00048828125f);
}

TEST_CASE("NaN compares as IEEE 754 says", "[codegen]") {
    std::string lines =
        "%e = feq %x, %x\n%n = fne %x, %x\n%l = fle %x, %x\n%one = const f32 1\n%two = const f32 2\n"
        "%four = const f32 4\n%zero = const f32 0\n%a = select %e, %one, %zero\n"
        "%b = select %n, %two, %zero\n%c = select %l, %four, %zero\n%ab = fadd %a, %b\n"
        "%abc = fadd %ab, %c\nret %abc\n";
    CHECK(evaluate<float>("f32", lines, std::nanf("")) == 2.0f);
    CHECK(evaluate<float>("f32", lines, 1.0f) == 5.0f);
}

TEST_CASE("natives get and return values of every kind", "[codegen]") {
    auto program = compile(parse(R"(
type 9 string 80
native @"rt_everything" plain f32 (f32, bool, ptr, i64)
native @"rt_pure" const f64 (f64, f64)
native @"rt_truth" const bool (bool, i32)
native @"rt_text" plain %9 (f32)
native @"sqrtf" const f32 (f32)
routine @"r" "r" in "M" exported %9 (f32 "x", bool "flag") {
  local 0 f32 "out"
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %root = native @"sqrtf" (%x)
    %flag = param 1
    %i = const i32 1
    %truth = native @"rt_truth" (%flag, %i)
    %p = local 0
    %wide = const i64 40000
    %sum = native @"rt_everything" (%root, %truth, %p, %wide)
    %d = fwiden f64 %root
    %h = native @"rt_pure" (%d, %d)
    %hf = fnarrow f32 %h
    %all = fadd %sum, %hf
    %result = result
    native @"rt_text" (%result, %all)
    ret
})"));
    using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*, rt::String*, float, bool);
    auto function = reinterpret_cast<Function>(entry(*program, "r"));
    Task task;
    rt::String result;
    CHECK(function(&task.core, nullptr, &result, 16.0f, true) == rt::kOk);
    CHECK(result.view() == "number 41136"); // 4 + 100 + 1000 + 40000 + 32
    CHECK(function(&task.core, nullptr, &result, 16.0f, false) == rt::kOk);
    CHECK(result.view() == "number 41036");
}

TEST_CASE("records, strings and arrays lie in memory as in C", "[codegen]") {
    auto program = compile(corpusModule("everything.rir").tasks.empty() ? ir::Module() : parse(R"(
type 9 string 80
type 10 record "mixed" { bool "flag", f64 "wide", %9 "text", f32 "x" }
type 11 array %10 [3]
desc 0 "num" base "num" float f32
desc 1 "bool" base "bool" bool bool
desc 2 "dnum" base "dnum" double f64
desc 3 "string" base "string" string %9
desc 4 "mixed" base "mixed" record %10 { "flag": 1, "wide": 2, "text": 3, "x": 0 }
desc 5 "mixed{3}" base "mixed{3}" array %11 of 4
global @"g" "g" in "M" %11 var desc 5 = { bool 1, f64 0.5, str "one", f32 1, bool 0, f64 1.5, str "two", f32 2, zero 1 bool, zero 1 f64, str "", f32 3 }
routine @"r" "r" in "M" exported void () {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %g = global @"g"
    %zero = const i32 0
    %two = const i32 2
    %first = elem %10 %g, %zero
    %third = elem %10 %g, %two
    copy %10 %third, %first
    %text = field %10 %first, 2
    zero %9 %text
    %flag = field %10 %third, 0
    %f = load bool %flag
    %n = not %f
    store bool %n, %flag
    ret
})"));
    struct Mixed {
        bool flag;
        double wide;
        rt::String text;
        float x;
    };
    const rt::GlobalDesc& desc = program->program()->globals[0];
    REQUIRE(desc.type->size == 3 * sizeof(Mixed));
    CHECK(desc.type->count == 3);
    CHECK(desc.type->dims[0] == 3);
    CHECK(desc.type->dims[1] == 0);
    const rt::TypeDesc& record = *desc.type->fields[0];
    CHECK(record.count == 4);
    CHECK(record.offsets[2] == offsetof(Mixed, text));
    CHECK(std::string(record.fieldNames[3]) == "x");
    CHECK(std::string(record.fields[1]->name) == "dnum");
    auto* g = static_cast<Mixed*>(desc.address);
    CHECK(g[0].text.view() == "one");
    CHECK(g[1].wide == 1.5);
    CHECK(g[2].x == 3.0f);
    Task task;
    using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*);
    CHECK(reinterpret_cast<Function>(entry(*program, "r"))(&task.core, nullptr) == rt::kOk);
    CHECK(g[0].text.view().empty());
    CHECK(g[2].text.view() == "one");
    CHECK(g[2].wide == 0.5);
    CHECK_FALSE(g[2].flag);
}

TEST_CASE("the budget is charged and refilled at safepoints", "[codegen]") {
    auto program = compile(parse(R"(
global @"sum" "sum" in "M" f32 var desc 0
desc 0 "num" base "num" float f32
routine @"loop" "loop" in "M" exported void (f32 "limit") {
  local 0 f32 "x"
  stmt 0 plain 1:1 1:2
  stmt 1 control 2:1 2:2
  stmt 2 plain 3:1 3:2
  b0:
    stmt 0
    charge 1
    %zero = const f32 0
    %x = local 0
    store f32 %zero, %x
    br b1
  b1:
    stmt 1
    %a = local 0
    %b = load f32 %a
    %c = param 0
    %d = flt %b, %c
    condbr %d, b2, b3
  b2:
    stmt 2
    %e = const f32 1
    %f = fadd %b, %e
    store f32 %f, %a
    charge 2
    br b1
  b3:
    %g = global @"sum"
    store f32 %b, %g
    ret
})"));
    using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*, float);
    auto loop = reinterpret_cast<Function>(entry(*program, "loop"));
    Task task;
    task.core.budget = 100000;
    CHECK(loop(&task.core, nullptr, 100.0f) == rt::kOk);
    CHECK(*static_cast<float*>(global(*program, "sum")) == 100.0f);
    CHECK(task.core.budget == 100000 - 1 - 2 * 100); // entry: statement 0; rounds: statements 1 and 2
    CHECK(events.empty());

    task.core.budget = 0;
    CHECK(loop(&task.core, nullptr, 1000.0f) == rt::kOk);
    CHECK(*static_cast<float*>(global(*program, "sum")) == 1000.0f);
    REQUIRE(events.size() == 2); // at the entry, and when the refill of 1000 is used up
    CHECK(events[0] == "safepoint at 0 in loop");
    CHECK(events[1] == "safepoint at 2 in loop");
}

TEST_CASE("a charge with an operand takes both from the budget", "[codegen]") {
    ir::Module module = corpusModule("charges.rir");
    for (ir::Routine& r : module.routines)
        r.exported = true;
    auto program = compile(module);
    using Function = rt::Status (*)(rt::TaskCore*, rt::Frame*, int32_t, bool);
    auto charged = reinterpret_cast<Function>(entry(*program, "charged"));
    Task task;
    task.core.budget = 1000;
    CHECK(charged(&task.core, nullptr, 12, false) == rt::kOk);
    CHECK(task.core.budget == 1000 - 4 - 12);
    task.core.budget = 1000;
    CHECK(charged(&task.core, nullptr, 0, false) == rt::kOk);
    CHECK(task.core.budget == 1000 - 4);
    CHECK(events.empty());
}

TEST_CASE("recursion without end stops at the limit of the stack", "[codegen]") {
    for (bool optimise : {false, true}) {
        auto program = compile(parse(R"(
routine @"deep" "deep" in "M" exported f32 (f32 "x") {
  stmt 0 call 1:1 1:2
  b0:
    stmt 0
    %x = param 0
    %one = const f32 1
    %y = fadd %x, %one
    %r = call @"deep" (%y)
    %s = fadd %r, %y
    ret %s
})"),
                               optimise);
        Task task;
        float result = 0;
        CHECK(reinterpret_cast<Unary<float>>(entry(*program, "deep"))(&task.core, nullptr, &result, 0.0f) ==
              rt::kUnwind);
        REQUIRE(events.size() == 1);
        CHECK(events[0] == "overflow in deep");
    }
}

TEST_CASE("large locals and allocations of unknown size respect the limit of the stack", "[codegen]") {
    auto program = compile(parse(R"(
type 9 array f64 [1000000]
routine @"large" "large" in "M" exported f64 (f64 "x") {
  local 0 %9 "big"
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %big = local 0
    zero %9 %big
    %r = load f64 %big
    ret %r
}
routine @"variable" "variable" in "M" exported i64 (i64 "bytes") {
  stmt 0 plain 1:1 1:2
  b0:
    stmt 0
    %n = param 0
    %p = stackalloc %n
    %seven = const i64 7
    store i64 %seven, %p
    %r = load i64 %p
    ret %r
})"));
    Task task;
    double wide = 0;
    CHECK(reinterpret_cast<Unary<double>>(entry(*program, "large"))(&task.core, nullptr, &wide, 0.0) ==
          rt::kUnwind);
    CHECK(events == std::vector<std::string>{"overflow in large"});
    events.clear();
    auto variable = reinterpret_cast<Unary<int64_t>>(entry(*program, "variable"));
    int64_t result = 0;
    CHECK(variable(&task.core, nullptr, &result, 4096) == rt::kOk);
    CHECK(result == 7);
    CHECK(events.empty());
    CHECK(variable(&task.core, nullptr, &result, int64_t{1} << 40) == rt::kUnwind);
    CHECK(variable(&task.core, nullptr, &result, -8) == rt::kUnwind);
    CHECK(events.size() == 2);
}
