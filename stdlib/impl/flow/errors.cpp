// Manual 1.12: what programs ask about errors.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

/// Numbers given to BookErrNo: after all predefined ones.
struct BookedNumbers {
    int next = 10000;
};

} // namespace

extern "C" {

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

/// The variable must hold -1 for a new number to be booked; booked again it keeps its number.
Status rt_BookErrNo(TaskCore* task, float* ErrorName) {
    if (*ErrorName == -1)
        *ErrorName = static_cast<float>(taskOf(task).controller().service<BookedNumbers>().next++);
    return kOk;
}

Status rt_ErrLog(TaskCore* task, float ErrorId, bool W, bool I, const String* Argument1,
                 const String* Argument2, const String* Argument3, const String* Argument4,
                 const String* Argument5) {
    if (!(ErrorId >= 4800 && ErrorId <= 4814) && !(ErrorId >= 5000 && ErrorId <= 9999))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "ErrLog: the number must be 4800 (title in Argument1) or 5000 to 9999");
    std::string text;
    for (const String* line : {Argument2, Argument3, Argument4, Argument5})
        if (line->length > 0) text += (text.empty() ? "" : "\n") + std::string(line->view());
    const EventType type = W ? EventType::Warning : I ? EventType::Information : EventType::Error;
    const int number =
        ErrorId < 5000 ? 40000 + static_cast<int>(ErrorId) : 110000 + static_cast<int>(ErrorId);
    Task& owner = taskOf(task);
    owner.controller().log().write(type, number, std::string(Argument1->view()), text, &owner,
                                   {std::string(Argument1->view()), std::string(Argument2->view()),
                                    std::string(Argument3->view()), std::string(Argument4->view()),
                                    std::string(Argument5->view())});
    return kOk;
}
}
