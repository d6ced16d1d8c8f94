#pragma once
// What an executable that links the standard library gives to its controller.

namespace rt {

class Controller;

/// Tells the event log the names of the errors, and the controller what the standard library keeps between two processes. A
/// ControllerSetup for runProgram.
void setUpStandardLibrary(Controller& controller);

} // namespace rt
