#pragma once
// Program pointer and motion pointer of a task as places in its text. Used on the controller's thread.

#include <cstdint>
#include <optional>
#include <string>

namespace rt {
class Task;
}

namespace rapidc::service {

class VirtualController;

struct PointerPlace {
    std::string module, routine;
    uint32_t beginLine = 0, beginColumn = 0, endLine = 0,
             endColumn = 0;    ///< from 1; the end is the last character
    std::string executionType; ///< "Normal", "Interrupt", "Event routine"
};

/// The instruction that comes next. None: there is none.
std::optional<PointerPlace> programPointer(VirtualController& controller, const rt::Task& task);
/// The movement instruction executed last. None: the task has executed none since its program pointer was moved.
std::optional<PointerPlace> motionPointer(VirtualController& controller, const rt::Task& task);

} // namespace rapidc::service
