#pragma once
// Clocks between two processes (--state).

namespace rt {
class Controller;
struct StateKeepers;
} // namespace rt

namespace rt::lib {

/// A clock keeps what it has counted, and continues when it ran. No time passes while no process runs.
void keepClocks(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
