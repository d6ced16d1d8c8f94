// Manual 1.17: what a program asks about its own execution: event, handler, level, moves of the program pointer.

#include "runtime/host/controller.h"
#include "runtime/sched/error_search.h"

#include "natives/support.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

/// The handler a routine is in at the moment; HANDLER_NONE in its body.
float handlerOf(const Frame& frame) {
    if (frame.routine->hasUndo != 0 && frame.reserved == kFrameInUndo) return k::HANDLER_UNDO;
    if (inErrorHandler(frame)) return k::HANDLER_ERR;
    const StmtDesc* statement = statementOf(frame);
    const bool backward = statement != nullptr && (statement->flags & kStmtInBackward) != 0;
    return backward ? k::HANDLER_BWD : k::HANDLER_NONE;
}

} // namespace

extern "C" {

Status rt_EventType(TaskCore* task, float* result) {
    *result = static_cast<float>(taskOf(task).events().running());
    return kOk;
}

/// Routines that a handler calls belong to it; traps and event routines have handlers of their own.
Status rt_ExecHandler(TaskCore* task, float* result) {
    *result = k::HANDLER_NONE;
    for (const Frame* at = taskOf(task).frame; at != nullptr && !isBoundary(*at); at = at->caller) {
        if (at->routine == nullptr) continue;
        *result = handlerOf(*at);
        if (*result != k::HANDLER_NONE) break;
    }
    return kOk;
}

Status rt_ExecLevel(TaskCore* task, float* result) {
    const Frame* at = taskOf(task).frame;
    while (at != nullptr && !isBoundary(*at))
        at = at->caller;
    *result = at != nullptr && at->routine == &kTrapBoundary ? k::LEVEL_TRAP : k::LEVEL_NORMAL;
    return kOk;
}

/// Since the latest stop; without an argument both kinds of moves count.
Status rt_IsStopStateEvent(TaskCore* task, bool* result, bool, bool PPToMain) {
    const Task& owner = taskOf(task);
    *result = PPToMain ? owner.pointerMovedToMain() : owner.pointerMoved();
    return kOk;
}

/// A virtual controller is in automatic mode: nothing happens in manual mode.
Status rt_PPMovedInManMode(TaskCore*, bool* result) {
    *result = false;
    return kOk;
}
Status rt_ResetPPMoved(TaskCore*) {
    return kOk;
}
}
