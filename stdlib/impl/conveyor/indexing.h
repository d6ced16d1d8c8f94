#pragma once
// Indexing conveyors: they stand, and make a step when a digital input says so.

#include "runtime/host/controller.h"

namespace rt::lib {

/// Ends the indexing mode of all conveyors (the program begins again).
void resetIndexing(Controller& controller);

} // namespace rt::lib
