// Entry points of compiled code into the runtime; the work is done by Task.

#include "runtime/abi/rt_abi.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/task.h"

extern "C" {

rt::Status rt_safepoint(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).safepoint(frame);
}

int32_t rt_step(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).step(frame);
}

void rt_chargeLater(rt::TaskCore* task, int64_t cost) {
    rt::taskOf(task).chargeLater(cost);
}

rt::Status rt_raise(rt::TaskCore* task, rt::Frame* frame, rt::Status errorNumber) {
    return rt::taskOf(task).raiseAt(frame, errorNumber);
}

rt::Status rt_nativeFailed(rt::TaskCore* task, rt::Frame* frame, rt::Status status) {
    return rt::taskOf(task).nativeFailedAt(frame, status);
}

rt::Status rt_land(rt::TaskCore* task, rt::Frame* frame, rt::Status status) {
    return rt::taskOf(task).landAt(frame, status);
}

rt::Status rt_takesError(rt::TaskCore*, rt::Frame* frame, rt::Status errorNumber) {
    return rt::takesError(*frame->routine, errorNumber) ? 1 : 0;
}

rt::Status rt_propagate(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).propagateFrom(frame);
}

rt::Status rt_handlerEnd(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).handlerEndAt(frame);
}

rt::Status rt_retry(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).retryAt(frame);
}

rt::Status rt_stackOverflow(rt::TaskCore* task, rt::Frame* frame) {
    return rt::taskOf(task).stackOverflowAt(frame);
}

} // extern "C"
