// Memory of the task's stack whose size is known at run time only (private copies of array arguments).

#include "stdlib/impl/support/support_natives.h"

using namespace rt;

extern "C" Status rt_reserveStack(TaskCore* task, int64_t bytes) {
    const char here = 0;
    if (&here - task->stackLimit > bytes) return kOk;
    return rt_stackOverflow(task, task->frame);
}
