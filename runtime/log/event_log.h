#pragma once
// EventLog: every stop, warning and error of the controller (manual: event log; numbers as on a controller:
// domain * 10000 + number). Shown on stderr for people and, when asked for, as JSON lines. Texts:
// event_texts.def.

#include "runtime/base/output_file.h"
#include "runtime/log/event.h"
#include "runtime/log/event_output.h"

#include <cstdio>
#include <deque>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {

/// Event numbers that the runtime itself uses: one enumerator per row of event_texts.def.
enum class EventId : int {
#define EVENT(name, number, type, title, text) name = number,
#include "runtime/log/event_texts.def"
#undef EVENT
};

class EventLog {
  public:
    EventLog() = default;
    ~EventLog() { finish(); }
    EventLog(const EventLog&) = delete;
    EventLog& operator=(const EventLog&) = delete;

    /// Writes a JSON object a line to this file from now on; false with a reason when it cannot be opened.
    bool openJson(const std::string& path, std::string& error) { return json_.open(path, error); }
    /// Ends that file, after finish(); false when some of it was lost, which has been reported.
    bool closeJson() { return json_.close(); }
    /// The output that people read; null: none. Default stderr.
    void setHumanOutput(std::FILE* file) { human_ = file; }
    void setClock(std::function<Time()> now) { now_ = std::move(now); }
    /// Called with every event after it is kept, until removed; a listener may remove itself and write events.
    uint64_t addListener(std::function<void(const Event&)> listener);
    void removeListener(uint64_t listener) { listeners_.erase(listener); }

    /// The standard library gives the name ("ERR_DIVZERO") and the meaning (one sentence, may be "") of every
    /// ERRNO constant. The texts must outlive the log.
    void addErrorName(int number, const char* name, const char* text);
    /// "ERR_DIVZERO", or "" when the number has no name (RAISE with 1 to 90).
    std::string errorName(int number) const;
    std::string errorText(int number) const;

    /// Keeps and shows an event; sequence is set here, time when it is negative. Returns the sequence number.
    uint64_t write(Event event);
    /// The event that `write` gave this sequence number has occurred once more, as if it were written again; the number of that
    /// occurrence is the next one. False, and nothing is done, when it is not among the latest different events, or when it might
    /// read otherwise by now. Costs little: a program may handle millions of errors.
    bool repeat(uint64_t written, Time time);
    /// An event from event_texts.def; {0} {1} ... in its text are replaced. `origin`: a `const Task*`, may be null.
    uint64_t write(EventId id, EventOrigin origin, std::initializer_list<std::string> arguments = {});
    /// ErrWrite, ErrLog: number in full (domain * 10000 + number), texts as given.
    uint64_t write(EventType type, int number, std::string title, std::string text, EventOrigin origin,
                   std::vector<std::string> arguments = {});

    /// The newest 1000, oldest first. One that repeats the one before it is counted there.
    const std::deque<Event>& events() const {
        keepRepeated();
        return events_;
    }
    /// Events of an earlier run come before those of this one; numbers continue. They are not shown again.
    void restore(const std::vector<Event>& events);
    /// The event with this sequence number, while it is kept.
    const Event* find(uint64_t sequence) const;
    uint64_t count() const { return sequence_; }
    /// Everything to disk, counts of repetitions too.
    void flush();
    /// flush(), and what was not written because of the limits is said. At the end of the run.
    void finish();

  private:
    void show(const Event& event);
    void putJson(const Event& event);
    void putText(const Event& event);
    /// Repetitions in succession that are not among `events_` yet: most of them never need an event of their own.
    struct Repeated {
        uint64_t written = 0; ///< see repeat()
        uint64_t sequence = 0, count = 0;
        Time first = 0, last = 0;
    };
    void keep(const Event& event) const;
    void keepRepeated() const;
    mutable std::deque<Event> events_;
    mutable std::deque<Repeated> repeated_; ///< later than those; the newest 1000
    std::map<int, std::pair<const char*, const char*>> names_;
    std::function<Time()> now_;
    std::map<uint64_t, std::function<void(const Event&)>> listeners_;
    uint64_t lastListener_ = 0;
    std::FILE* human_ = stderr;
    OutputFile json_;
    static constexpr uint64_t kMostShown = 10'000, kMostInFile = 100'000; // events
    BoundedOutput toPeople_{kMostShown, [this](const Event& event) { putText(event); }};
    BoundedOutput toFile_{kMostInFile, [this](const Event& event) { putJson(event); }};
    RepeatFilter shown_{[this](const Event& event) { show(event); }};
    uint64_t sequence_ = 0;
    uint64_t outdated_ = 0; ///< events up to this number are not repeated: names of errors may have changed
};

/// The row of event_texts.def.
struct EventText {
    EventType type;
    const char* title;
    const char* text;
};
EventText eventText(EventId id);
/// Its text with {0} {1} ... replaced.
std::string formatEventText(EventId id, std::initializer_list<std::string> arguments);

} // namespace rt
