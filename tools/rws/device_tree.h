#pragma once
// /rw/devices: the parts of the controller as a tree: its hardware, its mechanical units and its software.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

/// The controller outlives the routes.
void addDeviceTree(Router& router, service::VirtualController& controller);

} // namespace rapidc::rws
