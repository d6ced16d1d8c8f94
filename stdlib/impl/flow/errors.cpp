// Manual 1.12: what programs ask about errors.

#include "config/json_text.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/controller.h"
#include "runtime/sched/error_search.h"
#include "stdlib/impl/flow/booked_numbers.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "runtime/abi/support_natives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "natives/errors.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

/// Numbers given to BookErrNo: after all predefined ones.
struct BookedNumbers {
    static constexpr int kFirst = 10000;
    int next = kFirst;
};

/// 1 to 90 are the program's, the others must be predefined or booked.
bool mayBeRaised(Controller& controller, float number) {
    if (!(std::abs(number) < 1e6F)) return false;
    const auto whole = static_cast<int>(number);
    if (static_cast<float>(whole) != number) return false;
    if (whole >= 1 && whole <= 90) return true;
    if (whole >= BookedNumbers::kFirst) return whole < controller.service<BookedNumbers>().next;
    return !controller.log().errorName(whole).empty() && whole != err::LONG_JMP_ALL_ERR;
}

constexpr const char* kEventNumbers = "the number must be 4800 to 4814 or 5000 to 9999";

bool isEventNumber(float id) {
    return (id >= 4800 && id <= 4814) || (id >= 5000 && id <= 9999);
}

/// ERRSTR_TASK and ERRSTR_CONTEXT are filled in.
std::string argumentText(const Task& owner, std::string_view text) {
    if (text == "\\task") return owner.name();
    return text == "\\context" ? owner.place().reference() : std::string(text);
}

/// The first argument is the title, the others are lines of the text.
void writeEvent(Task& owner, EventType type, float id, std::array<const String*, 5> arguments) {
    std::string text;
    std::vector<std::string> texts; // what ReadErrData gives
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        texts.push_back(argumentText(owner, arguments[i]->view()));
        if (i > 0 && !texts.back().empty()) text += (text.empty() ? "" : "\n") + texts.back();
    }
    const int number = (id < 5000 ? 40000 : 110000) + static_cast<int>(id);
    owner.controller().log().write(type, number, std::string(texts[0]), text, &owner, texts);
}

/// Value of the num in module data with this name, that of the module at work first; 0 when there is none.
float numberOf(const Task& owner, std::string_view name) {
    Controller& controller = owner.controller();
    const GlobalDesc* global = controller.findGlobal(name, owner.place().module, owner);
    if (global == nullptr) global = controller.findGlobal(name, "", owner);
    if (global == nullptr || global->type->kind != DescKind::Num) return 0;
    float number = 0;
    std::memcpy(&number, global->address, sizeof number);
    return number;
}

} // namespace

namespace rt::lib {

void keepBookedNumbers(Controller& controller, StateKeepers& kept) {
    kept.keepers["bookedErrors"] = {
        [&controller] { return nlohmann::json(controller.service<BookedNumbers>().next); },
        [&controller](const nlohmann::json& json) {
            controller.service<BookedNumbers>().next = std::max(json.get<int>(), BookedNumbers::kFirst);
        }};
}

} // namespace rt::lib

extern "C" {

Status rt_raiseNumber(TaskCore* task, int32_t* result, float number) {
    if (!mayBeRaised(taskOf(task).controller(), number))
        return lib::fail(
            task, err::ERR_ILLRAISE,
            fmt::format("RAISE {}: the number must be 1 to 90, an error constant, or a number booked "
                        "by BookErrNo",
                        number));
    *result = static_cast<int32_t>(number);
    return kOk;
}

Status rt_raiseToCaller(TaskCore* task, int32_t number) {
    return taskOf(task).raiseToCaller(number);
}

Status rt_errorNotListed(TaskCore* task) {
    return taskOf(task).errorNotListed();
}

Status rt_ignoredInUndo(TaskCore* task, const String* instruction) {
    (void)taskOf(task).ignoredInUndo(std::string(instruction->view()).c_str());
    return kOk;
}

Status rt_SkipWarn(TaskCore* task) {
    taskOf(task).skipWarn();
    return kOk;
}

Status rt_ResetRetryCount(TaskCore* task) {
    taskOf(task).resetRetryCount();
    return kOk;
}

Status rt_RemainingRetries(TaskCore* task, float* result) {
    *result = static_cast<float>(taskOf(task).remainingRetries());
    return kOk;
}

/// The variable must hold -1 for a new number to be booked; booked again it keeps its number. Events call the error by the
/// name of the variable.
Status rt_BookErrNo(TaskCore* task, float* ErrorName) {
    Controller& controller = taskOf(task).controller();
    if (*ErrorName == -1) *ErrorName = static_cast<float>(controller.service<BookedNumbers>().next++);
    const GlobalDesc* data = lib::dataAt(controller, ErrorName);
    const int number = *ErrorName >= 0 && *ErrorName < 1e6F ? static_cast<int>(*ErrorName) : 0;
    if (data != nullptr && data->type->kind == DescKind::Num && number >= BookedNumbers::kFirst)
        controller.log().addErrorName(number, data->name, "booked by the program");
    return kOk;
}

Status rt_ErrLog(TaskCore* task, float ErrorId, bool W, bool I, const String* Argument1,
                 const String* Argument2, const String* Argument3, const String* Argument4,
                 const String* Argument5) {
    if (!isEventNumber(ErrorId))
        return lib::fail(task, err::ERR_ARGVALERR, std::string("ErrLog: ") + kEventNumbers);
    const EventType type = W ? EventType::Warning : I ? EventType::Information : EventType::Error;
    writeEvent(taskOf(task), type, ErrorId, {Argument1, Argument2, Argument3, Argument4, Argument5});
    return kOk;
}

/// A warning in the log; then as RAISE with the number that the variable named ErrorName holds.
Status rt_ErrRaise(TaskCore* task, const String* ErrorName, float ErrorId, const String* Argument1,
                   const String* Argument2, const String* Argument3, const String* Argument4,
                   const String* Argument5) {
    Task& owner = taskOf(task);
    if (!isEventNumber(ErrorId))
        return lib::fail(task, err::ERR_ARGVALERR, std::string("ErrRaise: ") + kEventNumbers);
    const float number = numberOf(owner, ErrorName->view());
    if (!mayBeRaised(owner.controller(), number))
        return lib::fail(
            task, err::ERR_ILLRAISE,
            fmt::format("ErrRaise: \"{}\" is not the name of module data with an error number; declare it "
                        "(VAR errnum {} := -1;) and book it with BookErrNo",
                        ErrorName->view(), ErrorName->view()));
    writeEvent(owner, EventType::Warning, ErrorId, {Argument1, Argument2, Argument3, Argument4, Argument5});
    owner.setErrorDetail(std::string(Argument1->view()));
    const auto raised = static_cast<int>(number);
    return owner.frame != nullptr && inErrorHandler(*owner.frame) ? owner.raiseToCaller(raised) : raised;
}

/// \Continue outside an error handler, \BreakOff, or neither: never 0.
Status rt_RaiseToUser(TaskCore* task, bool Continue, bool BreakOff, const float* ErrorNumber) {
    int32_t decision = kNotDecided;
    return rt_raiseToUser(task, &decision, Continue, BreakOff, ErrorNumber);
}

Status rt_raiseToUser(TaskCore* task, int32_t* result, bool Continue, bool BreakOff,
                      const float* ErrorNumber) {
    Task& owner = taskOf(task);
    // Errors of the instruction itself go to the system handler: it is in an error handler.
    if (Continue == BreakOff)
        return lib::fail(task, err::ERR_ARGVALERR, "RaiseToUser needs \\BreakOff or \\Continue");
    const float number = ErrorNumber ? *ErrorNumber : static_cast<float>(owner.errorNumber);
    if (!mayBeRaised(owner.controller(), number))
        return lib::fail(
            task, err::ERR_ILLRAISE,
            fmt::format("RaiseToUser: {} is not an error number; use 1 to 90 or a number booked by "
                        "BookErrNo",
                        number));
    if (BreakOff) return owner.breakOffToUser(static_cast<int>(number));
    HandlerDecision decision{};
    const Status status = owner.continueAtUser(static_cast<int>(number), decision);
    *result = decision;
    return status;
}

Status rt_endDetached(TaskCore* task, int32_t decision) {
    taskOf(task).endDetached(static_cast<HandlerDecision>(decision));
    return kOk;
}

Status rt_takeDecision(TaskCore* task, int32_t* result) {
    *result = taskOf(task).takeDecision();
    return kOk;
}
}
