#pragma once
// States that clients name in a group with others and that change seldom, or never, on a virtual controller. A group that names one
// which is not known is refused as a whole.

#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

/// Modes of mechanical units, errors of the motion system, hold-to-run, build log, synchronisation of pointers, task panel, energy.
void addRareStates(service::VirtualController& controller, Subscribables& subscribables);

} // namespace rapidc::rws
