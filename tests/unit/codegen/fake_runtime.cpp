#include "tests/unit/codegen/fake_runtime.h"

#include "runtime/abi/interpreted.h"

#include <catch2/catch.hpp>

#include "ir/passes/passes.h"

namespace codegen_testing {

std::vector<std::string> events;
std::vector<rt::Status> fallibleStatuses;

namespace {

std::string place(const rt::Frame* frame) {
    return " at " + std::to_string(frame->statement) + " in " + frame->routine->name;
}

void note(const std::string& text) {
    events.push_back(text);
}

rt::Status safepoint(rt::TaskCore* task, rt::Frame* frame) {
    note("safepoint" + place(frame));
    task->budget = 1000;
    return rt::kOk;
}

/// Every error is taken by somebody: the chain is not searched.
rt::Status raise(rt::TaskCore* task, rt::Frame* frame, rt::Status number) {
    task->errorNumber = number;
    note("raise " + std::to_string(number) + place(frame));
    return number;
}

/// An unhandled error; the task is started again at once.
constexpr rt::Status kStoppedAndStarted = 500;

rt::Status nativeFailed(rt::TaskCore* task, rt::Frame* frame, rt::Status status) {
    if (status == kStoppedAndStarted) return rt::kAgain;
    return status > 0 ? raise(task, frame, status) : status;
}

/// A long jump ends in the first routine with an error handler that is called "target".
rt::Status land(rt::TaskCore* task, rt::Frame* frame, rt::Status status) {
    note("land" + place(frame));
    if (std::string(frame->routine->name) == "target") return task->errorNumber;
    return status == rt::kJumpPast && !frame->routine->hasUndo ? rt::kJump : status;
}

rt::Status takesError(rt::TaskCore*, rt::Frame* frame, rt::Status number) {
    const rt::ErrorVariable& variable = *frame->routine->errorVariables;
    return *static_cast<const float*>(variable.address) == static_cast<float>(number) ? 1 : 0;
}

rt::Status propagate(rt::TaskCore* task, rt::Frame* frame) {
    note("propagate" + place(frame));
    return task->errorNumber;
}

rt::Status handlerEnd(rt::TaskCore*, rt::Frame* frame) {
    note("handlerEnd" + place(frame));
    return rt::kUnwind;
}

rt::Status retry(rt::TaskCore*, rt::Frame* frame) {
    note("retry" + place(frame));
    return rt::kOk;
}

rt::Status stackOverflow(rt::TaskCore*, rt::Frame* frame) {
    note(std::string("overflow in ") + frame->routine->name);
    return rt::kUnwind;
}

void chargeLater(rt::TaskCore* task, int64_t cost) {
    task->budget -= cost;
}

rt::Status noteNumber(rt::TaskCore* task, float number) {
    std::string chain;
    for (const rt::Frame* f = task->frame; f; f = f->caller)
        chain += std::string(" < ") + f->routine->name;
    note("note " + std::to_string(static_cast<int>(number)) + chain);
    return rt::kOk;
}

rt::Status fallible(rt::TaskCore*, float* result, float argument) {
    *result = argument;
    if (fallibleStatuses.empty()) return rt::kOk;
    rt::Status status = fallibleStatuses.front();
    fallibleStatuses.erase(fallibleStatuses.begin());
    return status;
}

double hypotenuse(double a, double b) {
    return a * a + b * b;
}
bool both(bool a, int32_t b) {
    return a && b != 0;
}

rt::Status everything(rt::TaskCore*, float* result, float number, bool flag, void* pointer, int64_t wide) {
    *result = number + (flag ? 100.0f : 0.0f) + (pointer ? 1000.0f : 0.0f) + static_cast<float>(wide);
    return rt::kOk;
}

rt::Status text(rt::TaskCore*, rt::String* result, float number) {
    result->assign("number " + std::to_string(static_cast<int>(number)));
    return rt::kOk;
}

rt::Status nothing(rt::TaskCore*) {
    return rt::kOk;
}

template <class Function> codegen::NativeSymbol symbol(const char* name, Function* function) {
    return {name, reinterpret_cast<const void*>(function)};
}

} // namespace

Task::Task() {
    constexpr size_t kStack = 1 << 20;
    core.budget = 1000000;
    core.stackLimit = static_cast<char*>(__builtin_frame_address(0)) - kStack;
    events.clear();
    fallibleStatuses.clear();
}

std::vector<codegen::NativeSymbol> symbols() {
    return {symbol("rt_safepoint", safepoint),
            symbol("rt_raise", raise),
            symbol("rt_propagate", propagate),
            symbol("rt_handlerEnd", handlerEnd),
            symbol("rt_nativeFailed", nativeFailed),
            symbol("rt_land", land),
            symbol("rt_takesError", takesError),
            symbol("rt_retry", retry),
            symbol("rt_stackOverflow", stackOverflow),
            symbol("rt_chargeLater", chargeLater),
            symbol("rt_interpret", rt_interpret),
            symbol("rt_note", noteNumber),
            symbol("rt_fallible", fallible),
            symbol("rt_pure", hypotenuse),
            symbol("rt_truth", both),
            symbol("rt_everything", everything),
            symbol("rt_text", text),
            symbol("rt_void", nothing),
            symbol("rt_plain", nothing)};
}

std::unique_ptr<codegen::JitProgram> compile(ir::Module module, bool optimise, bool interpreted) {
    for (const std::string& finding : ir::runPasses(module, {}))
        FAIL(finding);
    codegen::CodegenOptions options;
    options.optimise = optimise;
    options.interpretsAll = interpreted;
    std::string error;
    auto program = codegen::jit(module, options, symbols(), error);
    INFO(error);
    REQUIRE(program);
    return program;
}

void* entry(const codegen::JitProgram& program, const std::string& name) {
    const rt::ProgramDesc* desc = program.program();
    for (uint32_t i = 0; i < desc->routineCount; ++i)
        if (name == desc->routines[i].name) return desc->routines[i].address;
    FAIL("no exported routine " << name);
    return nullptr;
}

void* global(const codegen::JitProgram& program, const std::string& name) {
    const rt::ProgramDesc* desc = program.program();
    for (uint32_t i = 0; i < desc->globalCount; ++i)
        if (name == desc->globals[i].name) return desc->globals[i].address;
    FAIL("no global " << name);
    return nullptr;
}

} // namespace codegen_testing
