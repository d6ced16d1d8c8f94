// Manual 1.14: ModExist, ModTime.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

#include "natives/time.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

using namespace rt;

namespace {

Status fileTime(TaskCore* task, const String& object, String* digits, int64_t& seconds) {
    const LoadedModule* module = taskOf(task).controller().tables().findModule(
        static_cast<int32_t>(taskOf(task).index()), object.view());
    if (module == nullptr || module->fileTime < 0)
        return lib::fail(task, err::ERR_MOD_NOT_LOADED,
                         module == nullptr
                             ? fmt::format("module {} is not loaded", object.view())
                             : fmt::format("the file of module {} is not known", object.view()));
    seconds = module->fileTime;
    if (digits != nullptr) digits->assign(std::to_string(seconds));
    return kOk;
}

} // namespace

extern "C" {

Status rt_ModExist(TaskCore* task, bool* result, const String* ModuleName) {
    const Task& owner = taskOf(task);
    *result = owner.controller().tables().findModule(static_cast<int32_t>(owner.index()),
                                                     ModuleName->view()) != nullptr;
    return kOk;
}

Status rt_ModTimeDnum(TaskCore* task, double* result, const String* Object, String* StrDig) {
    int64_t seconds = 0;
    const Status status = fileTime(task, *Object, StrDig, seconds);
    *result = static_cast<double>(seconds);
    return status;
}

Status rt_ModTime(TaskCore* task, float* result, const String* Object, String* StrDig) {
    int64_t seconds = 0;
    const Status status = fileTime(task, *Object, StrDig, seconds);
    *result = static_cast<float>(seconds);
    return status;
}
}
