#pragma once
// The common part of the instructions of EGM: the process that a variable names, and the preconditions.

#include "stdlib/impl/guided_motion/egm_process.h"

#include <string>

namespace rt::lib {

/// The instruction cannot be used here: the system handler reports why. Negative.
Status egmMisused(TaskCore* task, const std::string& text);

/// The process of this identity, which belongs to the task. Null, with the misuse reported in `status`.
EgmProcess* egmProcess(TaskCore* task, Handle identity, Status& status);

/// \SampleRate as a period: 4, 8, 12 ... ms; 4 ms when it is left out. ERR_ARGVALERR.
Status egmPeriod(TaskCore* task, const float* sampleRate, Time& period);

/// A number that must be at least 0 when it is given. ERR_ARGVALERR.
Status egmNotNegative(TaskCore* task, const char* name, const float* value);

} // namespace rt::lib
