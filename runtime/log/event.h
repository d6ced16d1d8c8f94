#pragma once
// Event: one entry of the event log.

#include "runtime/base/source_place.h"
#include "runtime/base/time.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rt {

/// The figures that controllers use for the type of a message.
enum class EventType : uint8_t { Information = 1, Warning = 2, Error = 3 };

/// The subject of an event: a task and its place in the program; null: the controller.
struct EventOrigin {
    std::string task; ///< empty: the controller
    SourcePlace place;

    EventOrigin(std::nullptr_t) {}
    /// From a Task: the log is below the tasks and knows none, so whatever has a name and a place will do. May be null.
    template <class Source> EventOrigin(const Source* source) {
        if (source == nullptr) return;
        task = source->name();
        place = source->place();
    }
};

struct Event {
    uint64_t sequence = 0; ///< from 1, given by the log; of the last one when it represents several
    int number = 0;
    EventType type = EventType::Information;
    std::string title, text;
    Time time = 0;                      ///< virtual; of the last one
    uint64_t count = 1;                 ///< occurrences that it represents
    Time since = 0;                     ///< time of the first of them, when there are several
    std::string task;                   ///< empty: the controller
    SourcePlace place;                  ///< module, routine, line; empty when there is none
    std::vector<SourcePlace> calls;     ///< callers of place.routine, innermost first
    int errorNumber = 0;                ///< ERRNO, 0 = none
    std::string errorName;              ///< "ERR_DIVZERO"
    std::vector<std::string> arguments; ///< what was filled into the text, for ReadErrData

    /// The same event at another time.
    bool repeats(const Event& other) const;
};

/// Lower-case word used in JSON and on stderr: "error", "program" ...
const char* typeName(EventType type);
const char* domainName(int eventNumber);
/// One line of JSON, without line end.
std::string toJson(const Event& event);
/// Several lines for people, with line ends.
std::string toText(const Event& event);

} // namespace rt
