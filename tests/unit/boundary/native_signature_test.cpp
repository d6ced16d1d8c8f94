// Compiled code and the natives agree (stdlib/README.md): one rule makes the C++ prototypes and the IR signatures, and a
// signature or layout that is altered is another one.

#include "frontend/sema/checker.h"
#include "ir/lower/lower.h"
#include "runtime/abi/support_natives.h"
#include "stdlib/gen/emit.h"
#include "stdlib/stdlib_text.h"
#include "tests/unit/stdlib/declaration_files.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <type_traits>

namespace {

using rt::AbiType;
using rt::Slot;

/// The program lowered, which has no errors.
ir::Module lower(const std::string& text) {
    std::vector<rapid::sema::LibraryText> library;
    for (const auto& source : rapid::stdlib::sources())
        library.push_back({source.name, source.text});
    rapid::sema::CheckOptions options;
    options.library = library;
    rapid::sema::TaskInput task;
    task.files.push_back(std::make_shared<const rapid::SourceFile>("boundary.modx", text));
    rapid::diag::Sink sink;
    const auto program = rapid::sema::check({task}, options, sink);
    REQUIRE_FALSE(sink.hasErrors());
    ir::Module module;
    REQUIRE(rapid::lower::lowerProgram(*program, {}, sink, module));
    return module;
}

std::vector<Slot> slotsOf(const rt::ParamShape& shape) {
    std::vector<Slot> slots;
    rt::forEachSlot(shape, [&](Slot slot) { slots.push_back(slot); });
    return slots;
}

// An altered prototype is another type, so that a definition which differs from support_natives.def does not compile, ...
using rt::support::Prototype;
static_assert(std::is_same_v<decltype(rt_unresolved), Prototype<void(int32_t, const rt::String*)>::Type>);
static_assert(!std::is_same_v<decltype(rt_unresolved), Prototype<void(int64_t, const rt::String*)>::Type>);
static_assert(!std::is_same_v<decltype(rt_unresolved), Prototype<void(const rt::String*, int32_t)>::Type>);
static_assert(!std::is_same_v<decltype(rt_raiseNumber), Prototype<float(float)>::Type>);
// ... and compiled code gets its signature from the same list.
static_assert(rt::support::signatureOf(rt::support::Native::rt_unresolved).params[0] == AbiType::I32);
static_assert(rt::support::signatureOf(rt::support::Native::rt_raiseNumber).result == AbiType::I32);
static_assert(rt::SignatureOf<void(int64_t)>::params != rt::SignatureOf<void(int32_t)>::params);
static_assert(rt::SignatureOf<bool(float)>::result != rt::SignatureOf<float(float)>::result);

} // namespace

TEST_CASE("each parameter takes the machine arguments that stdlib/README.md lists", "[boundary]") {
    rt::ParamShape number;
    number.isScalar = number.isIn = true;
    CHECK(slotsOf(number) == std::vector{Slot::Value});
    rt::ParamShape optional = number;
    optional.optional = true;
    CHECK(slotsOf(optional) == std::vector{Slot::Address});
    rt::ParamShape variable = number;
    variable.isIn = false;
    CHECK(slotsOf(variable) == std::vector{Slot::Address});
    rt::ParamShape matrix = number;
    matrix.rank = 2;
    CHECK(slotsOf(matrix) == std::vector{Slot::Address, Slot::Dimension, Slot::Dimension});
    rt::ParamShape any = number;
    any.isAny = true;
    CHECK(slotsOf(any) == std::vector{Slot::Address, Slot::Type});
    rt::ParamShape isSwitch = optional;
    isSwitch.isSwitch = true;
    CHECK(slotsOf(isSwitch) == std::vector{Slot::Switch});
}

TEST_CASE("a native is called with the types of its prototype", "[boundary]") {
    const ir::Module module = lower("MODULE m\n"
                                    "  VAR string s;\n  VAR num n;\n  VAR dnum d;\n  VAR byte b{4};\n"
                                    "  PROC main()\n"
                                    "    n:=Abs(2);\n    s:=StrPart(s,1,2);\n    Add d,4294967295;\n"
                                    "    ValToBytes n,b;\n    s:=s+\"x\";\n"
                                    "  ENDPROC\nENDMODULE\n");
    ir::TypeId string = ir::kVoid;
    for (ir::TypeId type = 0; type < module.types.size(); ++type)
        if (module.types[type].kind == ir::TypeKind::Str) string = type;
    REQUIRE(module.types[string].capacity == sizeof(rt::String::bytes));
    const auto signature = [&](std::string_view symbol) {
        for (const ir::Native& native : module.natives) {
            if (native.symbol != symbol) continue;
            std::string text = native.nativeClass == ir::NativeClass::Const ? "value" : "status";
            text += fmt::format(" {}:", native.result);
            for (const ir::TypeId type : native.params)
                text += fmt::format(" {}", type);
            return text;
        }
        return std::string("missing");
    };
    // float rt_Abs(float)
    CHECK(signature("rt_Abs") == fmt::format("value {}: {}", ir::kF32, ir::kF32));
    // Status rt_StrPart(TaskCore*, String*, const String*, float, float)
    CHECK(signature("rt_StrPart") ==
          fmt::format("status {}: {} {} {}", string, ir::kPtr, ir::kF32, ir::kF32));
    // Status rt_ValToBytes(TaskCore*, const float*, const double*, float*, int32_t)
    CHECK(signature("rt_ValToBytes") ==
          fmt::format("status {}: {} {} {} {}", ir::kVoid, ir::kPtr, ir::kPtr, ir::kPtr, ir::kI32));
    // Status rt_strConcat(TaskCore*, String*, const String*, const String*)
    CHECK(signature("rt_strConcat") == fmt::format("status {}: {} {}", string, ir::kPtr, ir::kPtr));
}

TEST_CASE("programs lay every predefined record out as its C++ structure", "[boundary]") {
    const stdlibgen::Model model = projectDeclarations();
    std::string program = "MODULE m\n";
    size_t records = 0;
    for (const stdlibgen::TypeInfo& type : model.types)
        if (type.repr == stdlibgen::Repr::Record && type.aliasOf.empty())
            program += fmt::format("  VAR {} v{};\n", type.name, ++records);
    const ir::Module lowered = lower(program + "  PROC main()\n  ENDPROC\nENDMODULE\n");
    CHECK(records > 40);
    size_t compared = 0;
    for (const ir::Type& type : lowered.types) {
        if (type.kind != ir::TypeKind::Record || !model.findType(type.name)) continue;
        INFO(type.name);
        ir::Module own; // what the assertions on the C++ structures were made from
        const ir::TypeId expected = stdlibgen::layoutOf(model, type.name, own);
        const auto id = static_cast<ir::TypeId>(&type - lowered.types.data());
        CHECK(lowered.size(id) == own.size(expected));
        REQUIRE(type.fields.size() == own.type(expected).fields.size());
        for (uint32_t field = 0; field < type.fields.size(); ++field)
            CHECK(lowered.fieldOffset(id, field) == own.fieldOffset(expected, field));
        ++compared;
    }
    CHECK(compared == records);
}

TEST_CASE("an altered declaration gives another prototype and another layout check", "[boundary]") {
    const stdlibgen::Model model = projectDeclarations();
    stdlibgen::Model altered = projectDeclarations();
    for (stdlibgen::Routine& routine : altered.routines)
        if (routine.name == "StrPart") routine.params[1].type = "dnum";
    for (stdlibgen::TypeInfo& type : altered.types)
        if (type.name == "pose") std::swap(type.fields[0], type.fields[1]);
    for (const stdlibgen::SourceText& source : model.sources) {
        INFO(source.name);
        const bool same = stdlibgen::emitNatives(model, source) == stdlibgen::emitNatives(altered, source);
        CHECK(same == (source.name != "decl/strings.sysx")); // other subjects are not compiled again
    }
    const std::string checks = stdlibgen::emitLayoutChecks(model);
    CHECK(checks.find(
              "static_assert(offsetof(rt::data::Pose, rot) == 12 && sizeof(rt::data::Pose::rot) == 16);") !=
          std::string::npos);
    CHECK(checks != stdlibgen::emitLayoutChecks(altered));
}
