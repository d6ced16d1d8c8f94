#pragma once
// The outputs of the event log: JSON lines and text for people. Repetitions are counted, and both have a last line, so that
// a program that fails for ever fills neither a disk nor a terminal.

#include "runtime/log/event.h"

#include <deque>
#include <functional>
#include <utility>

namespace rt {

/// Passes events on in order of time. An event that repeats one of the latest different ones is counted instead; the count
/// is passed on, as an event with the time of the last repetition, when another event comes or at the end. Events of the
/// operator and of the system (domains 1 and 2) are never counted: what follows one is written again.
class RepeatFilter {
  public:
    explicit RepeatFilter(std::function<void(const Event&)> put) : put_(std::move(put)) {}
    void take(const Event& event);
    /// The event that was taken with the sequence number `taken` has come again, under another number. False: it is not counted.
    bool repeat(uint64_t taken, uint64_t sequence, Time time);
    /// That event, with sequence number and time of its last repetition; null: it is not among the latest.
    const Event* find(uint64_t taken) const;
    /// The counts that are open.
    void flush();

  private:
    static constexpr std::size_t kWindow = 16; ///< different events that repeat in turns
    struct Known {
        Event event;          ///< sequence and time of the last repetition
        uint64_t repeats = 0; ///< not passed on yet
        Time since = 0;       ///< of the first of them
        uint64_t taken = 0;   ///< sequence number at the last `take`
    };
    /// The entry of `known` that was taken with that sequence number; null: none. The latest is the most likely one.
    template <class Entries> static auto* knownAs(Entries& known, uint64_t taken) {
        for (std::size_t i = known.size(); i-- > 0;)
            if (known[i].taken == taken) return &known[i];
        return decltype(&known[0])(nullptr);
    }
    static void count(Known& known, uint64_t sequence, Time time);
    std::function<void(const Event&)> put_;
    std::deque<Known> known_; ///< the latest one last
};

/// Passes on so many events, then one that says so, then only what stops programs, and at the end how many were left out.
class BoundedOutput {
  public:
    BoundedOutput(uint64_t most, std::function<void(const Event&)> put) : most_(most), put_(std::move(put)) {}
    void write(const Event& event);
    /// Says how many events were left out.
    void finish();

  private:
    uint64_t most_;
    std::function<void(const Event&)> put_;
    uint64_t written_ = 0, dropped_ = 0;
    uint64_t sequence_ = 0; ///< of the last event,
    Time time_ = 0;         ///< and its time
};

} // namespace rt
