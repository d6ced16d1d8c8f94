// Manual 1.10: texts for the operator.

#include "runtime/host/controller.h"
#include "stdlib/impl/operator/question.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/written_value.h"

#include "natives/operator.h"
#include "natives/operator_dialogs.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

constexpr int kErrWriteEvent = 80001; // domain 8, user events
constexpr int kWarnWriteEvent = 80002;
constexpr int kInfoWriteEvent = 80003;

} // namespace

extern "C" {

Status rt_TPErase(TaskCore* task) {
    taskOf(task).controller().panel().erase();
    return kOk;
}

Status rt_TPWrite(TaskCore* task, const String* String, const float* Num, const bool* Bool,
                  const data::Pos* Pos, const data::Orient* Orient, const double* Dnum) {
    if (const Status status = lib::checkConnected(task)) return status;
    taskOf(task).controller().panel().writeLine(lib::withValue(*String, Num, Bool, Pos, Orient, Dnum));
    return kOk;
}

Status rt_ErrWrite(TaskCore* task, bool W, bool I, const String* Header, const String* Reason,
                   const String* RL2, const String* RL3, const String* RL4) {
    std::string text;
    // Five arguments, of which a line that is left out is empty: published clients read the header and all lines by their places.
    std::vector<std::string> arguments{std::string(Header->view())};
    for (const String* line : {Reason, RL2, RL3, RL4}) {
        arguments.emplace_back(line ? line->view() : std::string_view());
        if (line) text += (line == Reason ? "" : "\n") + arguments.back();
    }
    const EventType type = W ? EventType::Warning : I ? EventType::Information : EventType::Error;
    const int number = W ? kWarnWriteEvent : I ? kInfoWriteEvent : kErrWriteEvent;
    Controller& controller = taskOf(task).controller();
    controller.log().write(type, number, std::string(Header->view()), text, &taskOf(task), arguments);
    return kOk;
}

/// A terminal has one window; the number is not looked at.
Status rt_TPShow(TaskCore*, float) {
    return kOk;
}

/// RobotWare 7 has no views of the old FlexPendant, and this controller is one of it. That the display is full comes from the
/// stimulus.
rt::Status rt_UIShow(TaskCore* task, const String* AssemblyName, const String* TypeName, const String*,
                     float* InstanceId, float* Status, bool) {
    constexpr float kNoRoom = -1, kNoAssembly = -2;
    const bool isFull = !taskOf(task).controller().panel().hasRoomForViews();
    if (InstanceId) *InstanceId = 0;
    if (Status) {
        *Status = isFull ? kNoRoom : kNoAssembly;
        return kOk;
    }
    if (isFull) return lib::fail(task, err::ERR_UISHOW_FULL, "the display has no room for a further view");
    return lib::fail(task, err::ERR_UISHOW_FATAL,
                     "view " + std::string(TypeName->view()) + " of " + std::string(AssemblyName->view()) +
                         " cannot be shown: RobotWare 7 has no such views");
}

Status rt_UIClientExist(TaskCore* task, bool* result) {
    *result = taskOf(task).controller().panel().canAnswer();
    return kOk;
}
}
