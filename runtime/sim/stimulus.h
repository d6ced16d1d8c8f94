#pragma once
// Stimulus: what happens around the controller at which virtual time, from a CSV file
// (`time_s,target,value`).

#include "runtime/base/time.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

enum class StimulusKind : uint8_t {
    Signal,
    Quantity, ///< of a simulated device: "ROB_1.external_torque_2"
    Answer,
    Stop,
    QuickStop,
    EmergencyStop,
    PowerFail,
    PowerOn,
    Start,
    PpToMain,
    StepForward,
    StepBackward,
    PendantLost,  ///< no FlexPendant is connected: nothing can be shown or asked
    PendantFound, ///< ... one is again
    ViewsFull,    ///< the display has no room for a further view (UIShow)
    ViewsFree,
    DeviceLost,   ///< I/O device `text` loses contact
    DeviceFound,  ///< ... and has it again
    NetworkError, ///< I/O network `text` is in error, and so are its devices
    NetworkOk,
    SignalInvalid, ///< signal `text` is not valid
    SignalValid
};

struct StimulusItem {
    Time time = 0;
    StimulusKind kind = StimulusKind::Signal;
    std::string target; ///< name of the signal or quantity, as written
    double value = 0;   ///< Signal, Quantity
    std::string text;   ///< Answer, or the name of what is disturbed
    uint32_t line = 0;
};

struct StimulusProblem {
    uint32_t line = 0; ///< from 1, 0 = the file as a whole
    std::string message;
};

/// Reads the text of a stimulus file: a header line is allowed, `#` starts a comment, blank lines do not
/// count, a field may stand in double quotes (an answer with a comma). Items come sorted by time, equal times
/// in the order of the file.
std::vector<StimulusItem> parseStimulus(std::string_view text, std::vector<StimulusProblem>& problems);
/// Of a file, a pipe, or "-" for the standard input.
std::vector<StimulusItem> readStimulus(const std::string& path, std::vector<StimulusProblem>& problems);

} // namespace rt
