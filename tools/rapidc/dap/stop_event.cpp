#include "tools/rapidc/dap/stop_event.h"

#include "tools/rapidc/dap/context.h"

namespace rapidc::dap {
namespace {

const char* reasonOf(rt::StopReason reason) {
    switch (reason) {
    case rt::StopReason::Entry: return "entry";
    case rt::StopReason::Breakpoint: return "breakpoint";
    case rt::StopReason::Routine: return "function breakpoint";
    case rt::StopReason::Data: return "data breakpoint";
    case rt::StopReason::Step:
    case rt::StopReason::CirclePoint:
    case rt::StopReason::Cursor: return "step";
    case rt::StopReason::Order:
    case rt::StopReason::Stop: return "pause";
    case rt::StopReason::Error:
    case rt::StopReason::Raised: return "exception";
    case rt::StopReason::Pointer: return "goto";
    }
    return "pause";
}

const char* descriptionOf(rt::StopReason reason) {
    switch (reason) {
    case rt::StopReason::Entry: return "Stopped at the first instruction";
    case rt::StopReason::Breakpoint: return "Stopped at a breakpoint";
    case rt::StopReason::Step: return "Stepped";
    case rt::StopReason::CirclePoint: return "Stepped to the circle point";
    case rt::StopReason::Cursor: return "Stopped at the cursor";
    case rt::StopReason::Order: return "Paused";
    case rt::StopReason::Stop: return "Stopped by an instruction";
    case rt::StopReason::Error: return "Stopped by an error";
    case rt::StopReason::Pointer: return "Program pointer moved";
    case rt::StopReason::Routine: return "Stopped at a routine";
    case rt::StopReason::Data: return "Stopped because data have changed";
    case rt::StopReason::Raised: return "Stopped at an error that a handler takes";
    }
    return "";
}

} // namespace

Json stopEvent(rt::StopReason reason, const rt::Task& task) {
    return {{"reason", reasonOf(reason)},
            {"description", descriptionOf(reason)},
            {"threadId", Context::threadOf(task)},
            {"allThreadsStopped", true}};
}

} // namespace rapidc::dap
