#pragma once

namespace rapid {

/// Gives memory that arenas have given back to the system, as far as it is whole pages. For a process that continues without making
/// as much again: an arena that takes it later pays for its pages once more.
void releaseFreeMemory();

} // namespace rapid
