#include "stdlib/impl/support/task_asked.h"

#include "stdlib_constants.h"

namespace rt::lib {

Task* taskAsked(TaskCore* task, const Handle* ref, const String* name, Status& status) {
    Controller& controller = taskOf(task).controller();
    Task* found = nullptr;
    if (name)
        found = controller.findTask(name->view());
    else if (ref && *ref >= 1 && *ref <= static_cast<Handle>(controller.tasks().size()))
        found = controller.tasks()[static_cast<size_t>(*ref - 1)].get();
    status = found ? kOk
                   : fail(task, err::ERR_TASKNAME,
                          name ? "there is no task named " + std::string(name->view())
                               : std::string("the taskid variable names no task"));
    return found;
}

} // namespace rt::lib
