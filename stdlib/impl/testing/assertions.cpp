// Assertions of unit tests (decl/testing.sysx). A failed one stops the program with an event, as an error that no handler may
// take: in a test the one who runs it (tools/testing) continues with TearDown.

#include "runtime/log/event_log.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/testing/differences.h"
#include "stdlib/impl/testing/test_record.h"

#include "natives/testing.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

using namespace rt;

namespace {

constexpr double kNearDistance = 0.1; // mm
constexpr double kNearAngle = 0.1;    // degrees
constexpr double kAnalogTolerance = 0.001;

lib::TestRecord& recordOf(TaskCore* task) {
    return taskOf(task).controller().service<lib::TestRecord>();
}

struct Verdict {
    std::string expected, actual; ///< "" when there are no two values
    std::string text;             ///< instead of "expected ..., actual ..."
    std::string detail;           ///< after it
};

Status failWithVerdict(TaskCore* core, Verdict verdict, const String* message) {
    Task& task = taskOf(core);
    std::string text = verdict.text.empty()
                           ? fmt::format("expected {}, actual {}", verdict.expected, verdict.actual)
                           : std::move(verdict.text);
    if (!verdict.detail.empty()) text += " (" + verdict.detail + ")";
    if (message != nullptr && message->length > 0) text += ": " + std::string(message->view());
    lib::TestRecord& record = recordOf(core);
    if (!record.failure)
        record.failure = {task.place(), text, std::move(verdict.expected), std::move(verdict.actual)};
    return task.fatal(static_cast<int>(EventId::AssertionFailed), std::move(text));
}

Status failWithText(TaskCore* core, std::string text, const String* message) {
    Verdict verdict;
    verdict.text = std::move(text);
    return failWithVerdict(core, std::move(verdict), message);
}

/// "ERR_DIVZERO (1003)"
std::string errorText(TaskCore* task, double number) {
    const auto whole = static_cast<int>(number);
    const std::string name = taskOf(task).controller().log().errorName(whole);
    return name.empty() ? formatDnum(number) : fmt::format("{} ({})", name, whole);
}

bool isErrorNumber(const TypeDesc& type) {
    return std::string_view(type.name) == "errnum";
}

void nameErrors(TaskCore* task, const void* expected, const void* actual, const TypeDesc& type,
                Verdict& verdict) {
    if (!isErrorNumber(type)) return;
    float first = 0, second = 0;
    std::memcpy(&first, expected, sizeof first);
    std::memcpy(&second, actual, sizeof second);
    verdict.expected = errorText(task, first);
    verdict.actual = errorText(task, second);
}

std::string describe(const lib::Difference& difference, const Verdict& verdict) {
    std::string detail;
    if (!difference.part.empty()) {
        detail = difference.part;
        if (difference.expected != verdict.expected)
            detail += fmt::format(": expected {}, actual {}", difference.expected, difference.actual);
    }
    if (!difference.measured.empty()) detail += (detail.empty() ? "" : ", ") + difference.measured;
    return detail;
}

Status badTolerance(TaskCore* task, const char* name) {
    return failWithText(task, fmt::format("\\{} must not be negative", name), nullptr);
}

/// A signal, or its name. Null handle when the name is not that of a signal.
Handle signalHandle(TaskCore* task, const void* signal, const TypeDesc& type) {
    if (type.kind == DescKind::String)
        return lib::signalNamed(taskOf(task).controller().io(),
                                std::string(static_cast<const String*>(signal)->view()));
    Handle handle = 0;
    std::memcpy(&handle, signal, sizeof handle);
    return handle;
}

/// Waits until the condition is true, `maxTime` seconds at most.
Status waitForSignal(Task& task, SignalId id, const float* maxTime, const std::function<bool()>& isReached) {
    if (maxTime == nullptr || isReached()) return kOk;
    WaitSpec spec;
    spec.queues = {&task.controller().io().changed(id)};
    spec.condition = isReached;
    spec.deadline = addTime(task.now(), fromSeconds(std::max(*maxTime, 0.0f)));
    WaitResult result = WaitResult::Done;
    return task.waitFor(spec, result);
}

} // namespace

extern "C" {

Status rt_AssertTrue(TaskCore* task, bool Condition, const String* Message) {
    ++recordOf(task).assertions;
    return Condition ? kOk : failWithVerdict(task, {"TRUE", "FALSE", "", ""}, Message);
}

Status rt_AssertFalse(TaskCore* task, bool Condition, const String* Message) {
    ++recordOf(task).assertions;
    return Condition ? failWithVerdict(task, {"FALSE", "TRUE", "", ""}, Message) : kOk;
}

Status rt_AssertEqual(TaskCore* task, const void* Expected, const TypeDesc* ExpectedType, const void* Actual,
                      const TypeDesc* ActualType, const float* Tolerance, const String* Message) {
    ++recordOf(task).assertions;
    if (Tolerance != nullptr && !(*Tolerance >= 0)) return badTolerance(task, "Tolerance");
    const double tolerance = Tolerance != nullptr ? static_cast<double>(*Tolerance) : 0;
    const lib::Difference difference =
        lib::compareValues(Expected, *ExpectedType, Actual, *ActualType, tolerance);
    if (!difference.found) return kOk;
    Verdict verdict;
    lib::describeValues(Expected, *ExpectedType, Actual, *ActualType, verdict.expected, verdict.actual);
    nameErrors(task, Expected, Actual, *ExpectedType, verdict);
    verdict.detail = describe(difference, verdict);
    if (tolerance > 0)
        verdict.detail += fmt::format("{}tolerance {:g}", verdict.detail.empty() ? "" : ", ", tolerance);
    return failWithVerdict(task, std::move(verdict), Message);
}

Status rt_AssertNotEqual(TaskCore* task, const void* Unexpected, const TypeDesc* UnexpectedType,
                         const void* Actual, const TypeDesc* ActualType, const float* Tolerance,
                         const String* Message) {
    ++recordOf(task).assertions;
    if (Tolerance != nullptr && !(*Tolerance >= 0)) return badTolerance(task, "Tolerance");
    const double tolerance = Tolerance != nullptr ? static_cast<double>(*Tolerance) : 0;
    if (lib::compareValues(Unexpected, *UnexpectedType, Actual, *ActualType, tolerance).found) return kOk;
    Verdict verdict;
    verdict.actual = valueToText(Actual, *ActualType);
    verdict.expected = "a value other than " + valueToText(Unexpected, *UnexpectedType);
    return failWithVerdict(task, std::move(verdict), Message);
}

Status rt_AssertNear(TaskCore* task, const void* Expected, const TypeDesc* ExpectedType, const void* Actual,
                     const TypeDesc*, const float* Distance, const float* Angle, const String* Message) {
    ++recordOf(task).assertions;
    if (Distance != nullptr && !(*Distance >= 0)) return badTolerance(task, "Distance");
    if (Angle != nullptr && !(*Angle >= 0)) return badTolerance(task, "Angle");
    lib::Difference difference;
    const double distance = Distance != nullptr ? static_cast<double>(*Distance) : kNearDistance;
    const double angle = Angle != nullptr ? static_cast<double>(*Angle) : kNearAngle;
    if (!lib::compareNear(Expected, Actual, *ExpectedType, distance, angle, difference))
        return failWithText(task,
                            fmt::format("AssertNear compares robtarget, pose, pos, orient, jointtarget and "
                                        "robjoint, not {}; use AssertEqual with \\Tolerance",
                                        ExpectedType->name),
                            Message);
    if (!difference.found) return kOk;
    Verdict verdict;
    lib::describeValues(Expected, *ExpectedType, Actual, *ExpectedType, verdict.expected, verdict.actual);
    verdict.detail = describe(difference, verdict);
    return failWithVerdict(task, std::move(verdict), Message);
}

Status rt_AssertBetween(TaskCore* task, const void* Actual, const TypeDesc* ActualType, const void* Low,
                        const TypeDesc* LowType, const void* High, const TypeDesc* HighType,
                        const String* Message) {
    ++recordOf(task).assertions;
    const double actual = lib::numberOf(Actual, *ActualType);
    if (actual >= lib::numberOf(Low, *LowType) && actual <= lib::numberOf(High, *HighType)) return kOk;
    Verdict verdict;
    verdict.expected = valueToText(Low, *LowType) + " to " + valueToText(High, *HighType);
    verdict.actual = valueToText(Actual, *ActualType);
    return failWithVerdict(task, std::move(verdict), Message);
}

Status rt_AssertSignal(TaskCore* core, void* Signal, const TypeDesc* SignalType, double Value,
                       const float* MaxTime, const float* Tolerance, const String* Message) {
    Task& task = taskOf(core);
    ++recordOf(core).assertions;
    if (Tolerance != nullptr && !(*Tolerance >= 0)) return badTolerance(core, "Tolerance");
    const Handle handle = signalHandle(core, Signal, *SignalType);
    if (handle == 0 && SignalType->kind == DescKind::String)
        return failWithText(core,
                            fmt::format("there is no signal '{}' in the configuration",
                                        static_cast<const String*>(Signal)->view()),
                            Message);
    Status status = kOk;
    const SignalId id = lib::usableSignal(core, handle, status);
    if (status != kOk) return status;
    IoSystem& io = task.controller().io();
    const double tolerance = Tolerance != nullptr           ? static_cast<double>(*Tolerance)
                             : isAnalog(io.config(id).type) ? kAnalogTolerance
                                                            : 0;
    const auto isReached = [&] { return std::fabs(io.value(id) - Value) <= tolerance; };
    if (status = waitForSignal(task, id, MaxTime, isReached); status != kOk) return status;
    if (isReached()) return kOk;
    Verdict verdict{formatDnum(Value), formatDnum(io.value(id)), "", "signal " + io.config(id).name};
    if (MaxTime != nullptr) verdict.detail += fmt::format(" after {:g} s", *MaxTime);
    return failWithVerdict(core, std::move(verdict), Message);
}

Status rt_AssertErrorNumber(TaskCore* task, float Expected, float Actual, const String* Message) {
    ++recordOf(task).assertions;
    if (Expected == Actual) return kOk;
    const std::string expected = errorText(task, static_cast<double>(Expected));
    if (Actual == 0) return failWithVerdict(task, {expected, "no error", "", ""}, Message);
    Verdict verdict{expected, errorText(task, static_cast<double>(Actual)), "", ""};
    if (taskOf(task).errorNumber == static_cast<int32_t>(Actual)) {
        const std::string text = taskOf(task).errorText(); // "ERR_DIVZERO (1003): Division by zero."
        verdict.detail = text.substr(text.find(": ") == std::string::npos ? 0 : text.find(": ") + 2);
    }
    return failWithVerdict(task, std::move(verdict), Message);
}

Status rt_ExpectError(TaskCore* task, float Expected) {
    lib::TestRecord& record = recordOf(task);
    record.expectedError = static_cast<int32_t>(Expected);
    record.expectedAt = taskOf(task).place();
    return kOk;
}

Status rt_AssertEvent(TaskCore* task, float Number, const String* Message) {
    ++recordOf(task).assertions;
    const auto& events = taskOf(task).controller().log().events();
    const auto number = static_cast<int>(Number);
    for (const Event& event : events)
        if (event.number == number) return kOk;
    return failWithText(task, fmt::format("expected an event {}, and the log has none", number), Message);
}

Status rt_AssertDisplay(TaskCore* task, const String* Text, const String* Message) {
    ++recordOf(task).assertions;
    const auto& lines = taskOf(task).controller().panel().display();
    for (const std::string& line : lines)
        if (line.find(Text->view()) != std::string::npos) return kOk;
    const std::string last = lines.empty() ? "nothing" : fmt::format("\"{}\" last", lines.back());
    return failWithVerdict(task, {fmt::format("a line with \"{}\"", Text->view()), last, "", ""}, Message);
}

Status rt_Fail(TaskCore* task, const String* Message) {
    ++recordOf(task).assertions;
    return failWithText(task, Message->length > 0 ? std::string(Message->view()) : "Fail", nullptr);
}

Status rt_SkipTest(TaskCore* task, const String* Reason) {
    lib::TestRecord& record = recordOf(task);
    if (!record.skip) record.skip = {taskOf(task).place(), std::string(Reason->view())};
    return taskOf(task).stopHere("SkipTest");
}
}
