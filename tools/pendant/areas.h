#pragma once
// The areas of the protocol, a class for each in a file of its own: NAME_methods.cpp.

#include "tools/pendant/method_table.h"

#include <memory>

namespace rapidc::pendant {

std::unique_ptr<Area> makePanelArea(const Context& context);     ///< panel, time, restart
std::unique_ptr<Area> makeExecutionArea(const Context& context); ///< run, tasks, pointers
std::unique_ptr<Area> makeBreakpointArea(const Context& context);
std::unique_ptr<Area> makeModuleArea(const Context& context);
std::unique_ptr<Area> makeFileArea(const Context& context); ///< files, programs, backups
std::unique_ptr<Area> makeSignalArea(const Context& context);
std::unique_ptr<Area> makeDataArea(const Context& context);
std::unique_ptr<Area> makeDialogArea(const Context& context); ///< dialogs, display
std::unique_ptr<Area> makeEventArea(const Context& context);
std::unique_ptr<Area> makeUnitArea(const Context& context);   ///< what to draw
std::unique_ptr<Area> makeMotionArea(const Context& context); ///< samples, positions, the planned path
std::unique_ptr<Area> makeZoneArea(const Context& context);
std::unique_ptr<Area> makeJogArea(const Context& context); ///< jogging, teaching

} // namespace rapidc::pendant
