#pragma once
// The services that an executable with the standard library adds to its controller.

namespace rt {

class Controller;

/// Gives the event log the names of errors, and the controller the state that the library keeps between two processes. A
/// ControllerSetup for runProgram.
void setUpStandardLibrary(Controller& controller);

} // namespace rt
