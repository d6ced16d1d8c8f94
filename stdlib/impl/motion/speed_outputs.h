#pragma once
// TriggSpeed: analog outputs that follow the speed of the TCP (manual 1.8).

#include "runtime/host/controller.h"

namespace rt::lib {

struct SpeedScale {
    double scale = 0; ///< value of the output per mm/s; 0 ends the process
    Time dipLag = 0;  ///< the output follows the speed that the TCP will have so much later
    Handle errorSignal =
        0; ///< digital output, 1 while the value is outside the limits of the output; 0 = none
};

/// From now on the output is `scale` times the speed of the TCP, through the movements that follow and 0 while the arm
/// is at rest, until another scale is given or the program begins again. Values outside its limits are set to the limit.
void followSpeed(Task& task, Handle output, const SpeedScale& scale);
/// The program begins again: outputs that follow the speed are set to 0.
void endSpeedOutputs(Task& task);

} // namespace rt::lib
