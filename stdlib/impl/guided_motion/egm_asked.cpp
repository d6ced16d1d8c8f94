#include "stdlib/impl/guided_motion/egm_asked.h"

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>

namespace rt::lib {

Status egmMisused(TaskCore* task, const std::string& text) {
    return taskOf(task).fatal(static_cast<int>(EventId::EgmMisused), text);
}

EgmProcess* egmProcess(TaskCore* task, Handle identity, Status& status) {
    Task& owner = taskOf(task);
    EgmProcess* process = EgmProcesses::of(owner.controller()).find(identity);
    if (process == nullptr)
        status = egmMisused(task, "The variable names no EGM process. Use EGMGetId first.");
    else if (&process->owner() != &owner)
        status = egmMisused(task, "The EGM process belongs to another task. Use EGMGetId in this task.");
    else
        return process;
    return nullptr;
}

Status egmPeriod(TaskCore* task, const float* sampleRate, Time& period) {
    constexpr float kLeast = 4, kMost = 65536; // ms
    period = GuidedArm::kPeriod;
    if (sampleRate == nullptr) return kOk;
    if (!(*sampleRate >= kLeast && *sampleRate <= kMost && std::fmod(*sampleRate, kLeast) == 0))
        return fail(
            task, err::ERR_ARGVALERR,
            fmt::format("\\SampleRate must be a multiple of 4 ms (4, 8, 12 ...), not {}", *sampleRate));
    period = static_cast<Time>(*sampleRate) * kMillisecond;
    return kOk;
}

Status egmNotNegative(TaskCore* task, const char* name, const float* value) {
    if (value == nullptr || (std::isfinite(*value) && *value >= 0)) return kOk;
    return fail(task, err::ERR_ARGVALERR, fmt::format("{} must be a number from 0 on", name));
}

} // namespace rt::lib
