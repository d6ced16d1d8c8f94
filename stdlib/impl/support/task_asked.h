#pragma once
// Arguments \TaskRef | \TaskName of natives.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

namespace rt::lib {

/// The task asked for: by a taskid (number of the task from 1) or by name. Null when there is none: `status` is then the
/// error to return, ERR_TASKNAME.
Task* taskAsked(TaskCore* task, const Handle* ref, const String* name, Status& status);

} // namespace rt::lib
