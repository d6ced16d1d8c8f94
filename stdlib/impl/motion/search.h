#pragma once
// The watching of a search while the robot moves (manual 1.8): changes of a digital input or a persistent, from the beginning
// of its own movement to its end.

#include "runtime/host/controller.h"

#include <memory>
#include <optional>

namespace rt::lib {

/// Which changes count, and what the first one does.
struct SearchConditions {
    bool rising = true, falling = false;
    /// With this value at the beginning of the movement the search fails.
    std::optional<bool> activeLevel;
    bool stops = false;               ///< \Stop, \PStop, \SStop: the first hit ends the movement
    BreakOff stop = BreakOff::OnPath; ///< \Stop: stiff, \SStop: quickly
};

/// The source of the value: a digital input or a persistent bool.
struct SearchSource {
    SignalId signal = -1;
    const bool* persistent = nullptr; ///< null: the signal
};

/// One execution of a search instruction. The action at the start of its movement holds it, too; it may outlive it.
class Search {
  public:
    Search(Task& task, const SearchConditions& conditions, SearchSource source)
        : task_(task), conditions_(conditions), source_(source) {}
    ~Search() { end(); }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;

    /// The movement begins: the search fails when the value is active already, else it watches.
    void begin();
    /// Watches from now on, whatever the value is.
    void watch();
    /// The movement is over.
    void end();

    int hits() const { return hits_; }
    /// The movement ended before its point.
    bool wasBrokenOff() const { return wasActive_ || (conditions_.stops && hits_ > 0); }
    /// Active at the beginning: the movement was broken off.
    bool wasActive() const { return wasActive_; }
    /// Places of the axes at the first hit.
    const motion::JointTarget& place() const { return place_; }

  private:
    bool value() const;
    void look();
    void stopWatching();
    void checkSpeed(MotionDriver& driver);

    Task& task_;
    SearchConditions conditions_;
    SearchSource source_;
    uint64_t listener_ = 0;
    EventToken dataWatch_ = 0;
    int level_ = 0; // path level of the movement
    bool last_ = false, wasActive_ = false, isOver_ = false;
    int hits_ = 0;
    motion::JointTarget place_;
};

} // namespace rt::lib
