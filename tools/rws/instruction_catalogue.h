#pragma once
// RWS 2.0 tasks/T/pallet-head and tasks/T/pallet/N: the predefined instructions by subject, for pickers of instructions.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

/// The controller outlives the routes.
void addInstructionCatalogue(Router& router, service::VirtualController& controller);

} // namespace rapidc::rws
