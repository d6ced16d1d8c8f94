#pragma once
// ModPos: positions that a part of a module names get the present position of the arm.

#include "tools/rws/module_text.h"
#include "tools/service/virtual_controller.h"

#include <string>

namespace rapidc::rws {

/// Robtargets and jointtargets that are named in the range, in the tool and work object named there, else in those in force. Variables and
/// persistents change in memory, constants in the text of their module. "" or why nothing has changed.
std::string modifyPositions(service::VirtualController& controller, rt::Task& task, const std::string& module,
                            const std::string& text, const TextRange& range);

} // namespace rapidc::rws
