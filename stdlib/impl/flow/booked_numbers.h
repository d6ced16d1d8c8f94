#pragma once
// BookErrNo between two processes (--state).

namespace rt {
class Controller;
struct StateKeepers;
} // namespace rt

namespace rt::lib {

/// Numbers that are booked stay booked.
void keepBookedNumbers(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
