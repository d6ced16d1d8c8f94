#pragma once
// StopSignals: Ctrl-C and its kin end a run in order: event, complete files, temporary HOME: removed.

#include <chrono>

namespace rt {

/// While an object of this class lives, the first SIGINT, SIGTERM, SIGHUP or SIGPIPE (the reader of the output is
/// gone) is only noted; the controller looks at received() between slices and ends the run. A second one kills the
/// process at once. Signals that the process was started to ignore (nohup) stay ignored. One object at a time.
class StopSignals {
  public:
    static constexpr int kStatus = 128; ///< a shell adds it to the number of the signal that ended a process

    /// With a `patience` above 0 the process ends with kStatus + number of the signal when this object still lives
    /// that long after the first signal: a compilation in progress does not look at received().
    explicit StopSignals(std::chrono::milliseconds patience = std::chrono::milliseconds{0});
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that came; 0 = none.
    static int received();
    /// "Ctrl-C (SIGINT)": for the event log.
    static const char* name(int signal);
    /// If a signal came, ends the process by that very signal, so that a calling shell knows (status 128 + its
    /// number). To be called when everything is closed and removed.
    static void endIfReceived();
};

} // namespace rt
