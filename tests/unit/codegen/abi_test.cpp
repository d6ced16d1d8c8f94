// The types that codegen derives from rt_abi.h, and that a difference between the two cannot stay unnoticed.

#include <catch2/catch.hpp>
#include <llvm/IR/DataLayout.h>
#include <sys/wait.h>
#include <unistd.h>

#include "codegen/abi_kinds.h"
#include "codegen/abi_row.h"
#include "codegen/compile.h"

using namespace codegen;

namespace {

/// The offset that C++ gives a member, taken from an object and not from the derivation.
template <auto member> size_t placeOf() {
    static const abi::StructOf<member> object{};
    return static_cast<size_t>(reinterpret_cast<const char*>(&(object.*member)) -
                               reinterpret_cast<const char*>(&object));
}

llvm::DataLayout targetLayout() {
    std::string error;
    const auto machine = makeTargetMachine({}, error);
    REQUIRE(machine);
    return machine->createDataLayout();
}

/// Compares LLVM's layout of T with that of C++: all fields, and those named besides by their members.
template <class T, auto... members> void checkLayout() {
    llvm::LLVMContext context;
    const llvm::DataLayout target = targetLayout();
    llvm::StructType* type = abi::structType<T>(context);
    INFO(type->getName().str());
    const llvm::StructLayout& layout = *target.getStructLayout(type);
    CHECK(layout.getSizeInBytes() == sizeof(T));
    CHECK(layout.getAlignment().value() == alignof(T));
    REQUIRE(type->getNumElements() == abi::kFields<T>.size());
    const auto checkField = [&](size_t i, size_t offset, size_t size) {
        CHECK(abi::kFields<T>[i].offset == offset);
        CHECK(layout.getElementOffset(static_cast<unsigned>(i)) == offset);
        CHECK(target.getTypeAllocSize(type->getElementType(static_cast<unsigned>(i))) == size);
    };
    if constexpr (!abi::detail::kHasBase<T>) {
        const auto* begin = reinterpret_cast<const char*>(&abi::detail::kSample<T>);
        size_t i = 0;
        std::apply(
            [&](const auto*... field) {
                (checkField(i++, static_cast<size_t>(reinterpret_cast<const char*>(field) - begin),
                            sizeof(*field)),
                 ...);
            },
            abi::detail::fieldAddresses<T>());
    }
    (checkField(abi::indexOf<members>(), placeOf<members>(), sizeof(abi::TypeOf<members>)), ...);
}

/// In another process: whether `work` ends it with a message that holds `text`.
template <class Work> bool endsWith(const char* text, Work&& work) {
    int channel[2] = {};
    REQUIRE(pipe(channel) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        dup2(channel[1], STDERR_FILENO);
        close(channel[0]);
        close(channel[1]);
        work();
        _exit(0);
    }
    close(channel[1]);
    std::string said;
    char buffer[512];
    for (ssize_t count = 0; (count = read(channel[0], buffer, sizeof buffer)) > 0;)
        said.append(buffer, static_cast<size_t>(count));
    close(channel[0]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    INFO(said);
    CHECK(said.find(text) != std::string::npos);
    return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

// rt::ModuleDesc with the same fields in a different order, and with one more.
struct Reordered {
    const char* name;
    int32_t task;
    const char* file;
    int32_t* gone;
};
struct Extended {
    const char* name;
    const char* file;
    int32_t task;
    int32_t* gone;
    uint32_t line;
};
struct Nested {
    float number;
    rt::AnyRef any;
    double large;
    int16_t halves[2][4];
};
struct Derived : Nested {
    rt::StartMark mark;
    const char* text;
    bool last;
};
/// C++ puts `after` into the gap at the end of the base: not the layout of a plain C struct.
struct Gap {
    int64_t number = 0;
    char letter = 0;
};
struct AfterGap : Gap {
    char after;
};
struct Padded {
    int32_t number;
    alignas(8) int32_t further;
    int32_t last;
};
struct Aligned { // its fields lie where LLVM puts them, but there is room after them
    int64_t number, further;
    alignas(16) int32_t last;
};

using llvm::Constant;
using llvm::Function;

template <class Row, auto member, class V>
concept CanSet = requires(Row row, V value) { std::move(row).template set<member>(value); };
template <class Callee, class... V>
concept CanCall = requires(const Callee& callee, llvm::IRBuilderBase& b, V*... v) { callee.call(b, v...); };
template <class Row>
concept CanFinish = requires(Row row) { std::move(row).finish(); };

using ModuleRow = abi::Row<rt::ModuleDesc>;
constexpr uint64_t kAllOfModuleDesc = (uint64_t{1} << abi::kFields<rt::ModuleDesc>.size()) - 1;

} // namespace

TEST_CASE("the structures of compiled programs have the layout of rt_abi.h", "[codegen][abi]") {
    using namespace rt;
    checkLayout<String>();
    checkLayout<AnyRef>();
    checkLayout<TypeDesc, &TypeDesc::dims, &TypeDesc::offsets>();
    checkLayout<StmtDesc, &StmtDesc::line, &StmtDesc::canStart>();
    checkLayout<LocalDesc>();
    checkLayout<RoutineDesc, &RoutineDesc::hasUndo, &RoutineDesc::detachedHandler>();
    checkLayout<TaskDesc>();
    checkLayout<GlobalDesc>();
    checkLayout<RoutineDataDesc>();
    checkLayout<ModuleDesc>();
    checkLayout<ExternalDesc>();
    checkLayout<ParamDesc>();
    checkLayout<LateArg>();
    checkLayout<RoutineEntry>();
    checkLayout<ProgramDesc, &ProgramDesc::name, &ProgramDesc::sourcesSize>();
    checkLayout<Frame, &Frame::caller, &Frame::routine, &Frame::statement, &Frame::reserved>();
    checkLayout<SteppingFrame, &SteppingFrame::addresses, &SteppingFrame::failed>();
    checkLayout<TaskCore, &TaskCore::budget, &TaskCore::askSteps>();
}

TEST_CASE("sizes that the IR knows are those of the runtime's values", "[codegen][abi]") {
    ir::Module module;
    CHECK(module.size(module.stringOf(rt::kStringCapacity)) == sizeof(rt::String));
    CHECK(module.align(module.stringOf(rt::kStringCapacity)) == alignof(rt::String));
    CHECK(module.size(ir::kI64) == sizeof(rt::Handle));
    CHECK(module.size(ir::kI32) == sizeof(rt::Status));
    CHECK(module.size(ir::kPtr) == sizeof(void*));
}

TEST_CASE("arrays, structs in structs, and derived structs keep their fields", "[codegen][abi]") {
    checkLayout<Nested, &Nested::halves>();
    checkLayout<Derived, &Derived::mark, &Derived::text, &Derived::last>();
    static_assert(abi::kFields<Derived>.size() == 4 && abi::kFields<Derived>[0].size == sizeof(Nested));
    static_assert(std::is_same_v<abi::StructOf<&rt::SteppingFrame::statement>, rt::Frame>);
    llvm::LLVMContext context;
    CHECK(abi::structType<rt::SteppingFrame>(context)->getElementType(0) ==
          abi::structType<rt::Frame>(context));
    CHECK(abi::structType<rt::Frame>(context)->getName() == "rt.Frame");
    static_assert(!abi::LaidOutNaturally<Padded> && !abi::LaidOutNaturally<Aligned>,
                  "attributes of layout are refused");
    static_assert(!abi::LaidOutNaturally<AfterGap>, "so are bases with gaps that C++ fills");
}

TEST_CASE("an altered structure gives another type", "[codegen][abi]") {
    llvm::LLVMContext context;
    llvm::StructType* known = abi::structType<rt::ModuleDesc>(context);
    CHECK(known == abi::structType<rt::ModuleDesc>(context));
    CHECK_FALSE(known->isLayoutIdentical(abi::structType<Reordered>(context)));
    CHECK_FALSE(known->isLayoutIdentical(abi::structType<Extended>(context)));
    CHECK(abi::indexOf<&Reordered::task>() == 1);
    CHECK(abi::indexOf<&rt::ModuleDesc::task>() == 2);
}

TEST_CASE("a row takes values of the right kind only, each field once", "[codegen][abi]") {
    using rt::LocalDesc, rt::ModuleDesc, rt::TaskDesc, rt::TypeDesc;
    static_assert(CanSet<ModuleRow, &ModuleDesc::task, int>);
    static_assert(CanSet<ModuleRow, &ModuleDesc::task, bool>);
    static_assert(CanSet<ModuleRow, &ModuleDesc::name, Constant*>);
    static_assert(CanSet<ModuleRow, &ModuleDesc::name, std::nullptr_t>);
    static_assert(!CanSet<ModuleRow, &ModuleDesc::name, int>, "a pointer field takes no integer");
    static_assert(!CanSet<ModuleRow, &ModuleDesc::task, Constant*>, "an integer field takes no address");
    static_assert(!CanSet<ModuleRow, &ModuleDesc::task, double>);
    static_assert(!CanSet<ModuleRow, &ModuleDesc::task, ir::GlobalKind>, "enums of the IR are translated");
    static_assert(!CanSet<ModuleRow, &TaskDesc::name, Constant*>, "a field of another struct");
    static_assert(!CanSet<abi::Row<ModuleDesc, 1>, &ModuleDesc::name, Constant*>, "set already");
    using LocalRow = abi::Row<LocalDesc>;
    static_assert(CanSet<LocalRow, &LocalDesc::kind, LocalDesc::Kind>);
    static_assert(!CanSet<LocalRow, &LocalDesc::kind, int>, "an enum takes its own values only");
    using TaskRow = abi::Row<TaskDesc>;
    static_assert(CanSet<TaskRow, &TaskDesc::entry, Function*>);
    static_assert(!CanSet<TaskRow, &TaskDesc::entry, Constant*>, "no function");
    using TypeRow = abi::Row<TypeDesc>;
    static_assert(CanSet<TypeRow, &TypeDesc::dims, std::array<int64_t, 3>>);
    static_assert(!CanSet<TypeRow, &TypeDesc::dims, std::array<int64_t, 2>>,
                  "a different number of elements");
    SUCCEED("the compiler has checked it");
}

TEST_CASE("a row with a field missing cannot be finished", "[codegen][abi]") {
    static_assert(CanFinish<abi::Row<rt::ModuleDesc, kAllOfModuleDesc>>);
    static_assert(!CanFinish<ModuleRow>);
    for (size_t i = 0; i < abi::kFields<rt::ModuleDesc>.size(); ++i)
        CHECK(abi::detail::firstUnset<rt::ModuleDesc>(kAllOfModuleDesc & ~(uint64_t{1} << i)) == i);
    static_assert(!CanFinish<abi::Row<rt::ModuleDesc, kAllOfModuleDesc & ~uint64_t{8}>>);
    static_assert(!CanFinish<abi::Row<Extended, kAllOfModuleDesc>>, "a field was added");
    SUCCEED("the compiler has checked it");
}

TEST_CASE("a finished row holds its values at the places of the members", "[codegen][abi]") {
    llvm::LLVMContext context;
    Constant* address = llvm::ConstantExpr::getIntToPtr(
        llvm::ConstantInt::get(llvm::Type::getInt64Ty(context), 4096), llvm::PointerType::getUnqual(context));
    Constant* row = abi::Row<rt::ModuleDesc>(context)
                        .set<&rt::ModuleDesc::gone>(address)
                        .set<&rt::ModuleDesc::task>(-1)
                        .set<&rt::ModuleDesc::file>(nullptr)
                        .set<&rt::ModuleDesc::name>(address)
                        .finish();
    CHECK(row->getType() == abi::structType<rt::ModuleDesc>(context));
    CHECK(row->getAggregateElement(0u) == address);
    CHECK(row->getAggregateElement(1u)->isNullValue());
    CHECK(llvm::cast<llvm::ConstantInt>(row->getAggregateElement(2u))->getSExtValue() == -1);
    CHECK(row->getAggregateElement(3u) == address);
}

TEST_CASE("function types are those of the declarations", "[codegen][abi]") {
    llvm::LLVMContext context;
    llvm::Module module("", context);
    llvm::FunctionType* raise = abi::functionType<decltype(rt_raise)>(context);
    CHECK(raise == abi::functionType<rt::Status (*)(rt::TaskCore*, rt::Frame*, rt::Status)>(context));
    CHECK(raise == abi::functionType<decltype(rt_land)>(context));
    CHECK(raise != abi::functionType<decltype(rt_propagate)>(context));
    CHECK(raise != abi::functionType<rt::Status(rt::TaskCore*, rt::Frame*, int64_t)>(context));
    CHECK(abi::functionType<rt::LateEntry>(context)->getNumParams() == 4);
    const auto callee = RAPIDC_DECLARE_RUNTIME(module, rt_raise);
    CHECK(callee.function()->getName() == "rt_raise");
    CHECK(callee.function()->getFunctionType() == raise);
    static_assert(std::is_same_v<decltype(callee), const abi::Callee<decltype(rt_raise)>>);
    using llvm::Value;
    static_assert(CanCall<decltype(callee), Value, Value, Value>);
    static_assert(!CanCall<decltype(callee), Value, Value>, "an argument is missing");
    static_assert(!abi::PassedPlainly<rt::AnyRef> && !abi::PassedPlainly<bool>);
    CHECK(std::string(kProgramSymbol) == "rapidc_program");
}

TEST_CASE("what only shows while code is made ends the compiler", "[codegen][abi]") {
    llvm::LLVMContext context;
    llvm::Module module("", context);
    CHECK(endsWith("a field of 8 bits cannot hold 256",
                   [&] { abi::Row<rt::ParamDesc>(context).set<&rt::ParamDesc::group>(256); }));
    const auto other =
        RAPIDC_DECLARE_RUNTIME(module, rt_raise); // one parameter more than rt::EntryFunction has
    CHECK(endsWith("a field of rt::TaskDesc",
                   [&] { abi::Row<rt::TaskDesc>(context).set<&rt::TaskDesc::entry>(other.function()); }));
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(context, "", other.function()));
    CHECK(endsWith("a field of rt::Frame has the type i32, not i64", [&] {
        abi::storeField<&rt::Frame::statement>(b, other.function()->getArg(1), b.getInt64(1));
    }));
}

TEST_CASE("kinds of the IR have their counterparts in the runtime", "[codegen][abi]") {
    // That every name has one is checked by the compiler (abi_kinds.h); these are the values that both sides count by.
    CHECK(abi::kindOf(ir::DescKind::Other) == rt::DescKind::Other);
    CHECK(abi::kindOf(ir::DescKind::Bytes) == rt::DescKind::Bytes);
    CHECK(abi::kindOf(ir::StmtKind::Handler) == rt::kStmtHandler);
    CHECK(abi::kindOf(ir::GlobalKind::External) == rt::kGlobalPersistent);
    CHECK(abi::kindOf(ir::RoutineKind::Interrupt) == rt::kRoutineTrap);
    CHECK(abi::modeOf(ir::ParamMode::Either) == rt::kParamInOut);
    CHECK(abi::flagOf(ir::kStmtReenterable) == rt::kStmtReenterable);
}
