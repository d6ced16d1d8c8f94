#pragma once
// /rw/rapid/aliasio: signal variables of the program that AliasIO has connected with a signal.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

/// The controller outlives the routes.
void addAliasSignals(Router& router, service::VirtualController& controller);

} // namespace rapidc::rws
