#pragma once
// The predefined instructions by subject, for pickers of instructions: RWS 2.0 tasks/T/pallet-head and tasks/T/pallet/N, RWS 1.0
// tasks/T?resource=pallet-head and tasks/T?resource=pallet&number=N.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

/// The subjects, with their numbers.
Reply subjectsOfInstructions(service::VirtualController& controller, const Request& request);
/// The instructions of the subject with that number, from 1.
Reply instructionsOf(service::VirtualController& controller, const Request& request,
                     const std::string& number);
/// The controller outlives the routes.
void addInstructionCatalogue(Router& router, service::VirtualController& controller);

} // namespace rapidc::rws
