// Manual 1.20: exclusive rights by a persistent bool. Tasks cannot interrupt each other inside a native, so testing and
// setting is one indivisible step.

#include "runtime/host/controller.h"

#include "stdlib_natives.h"

using namespace rt;

namespace {

constexpr Time kPoll = 10 * kMillisecond; // nothing tells of changes of a persistent

bool take(bool* object) {
    if (*object) return false;
    *object = true;
    return true;
}

} // namespace

extern "C" {

Status rt_TestAndSet(TaskCore*, bool* result, bool* Object) {
    *result = take(Object);
    return kOk;
}

Status rt_WaitTestAndSet(TaskCore* task, bool* Object) {
    WaitSpec spec;
    spec.condition = [Object] { return take(Object); };
    spec.pollPeriod = kPoll;
    WaitResult result = WaitResult::Done;
    return taskOf(task).waitFor(spec, result);
}
}
