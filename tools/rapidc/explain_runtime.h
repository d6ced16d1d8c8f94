#pragma once
// The meaning of the numbers and names that a running program shows: events of the event log, ERR_ constants.

#include <string>
#include <string_view>

namespace rapidc {

/// The explanation of an event number as the log shows it (40229, also "event 40229"); "" if it is none.
std::string explainEvent(std::string_view text);
/// The explanation of an error constant (ERR_DIVZERO, in any case) or of its number; "" if it is none.
std::string explainError(std::string_view text);
/// "; did you mean 'ERR_DIVZERO'?" for a name that begins like one of an error; else "".
std::string nearestError(std::string_view text);

} // namespace rapidc
