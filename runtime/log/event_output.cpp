#include "runtime/log/event_output.h"

#include "runtime/log/event_log.h"

#include <algorithm>
#include <vector>

namespace rt {
namespace {

/// Orders and states of the controller: each one counts.
bool isOperational(const Event& event) {
    return event.number >= 10'000 && event.number < 30'000;
}

/// An event that stops a program is written also when the file is full.
bool isLasting(const Event& event) {
    return isOperational(event) || (event.type == EventType::Error && event.number / 10'000 == 4);
}

Event eventOf(EventId id, uint64_t number, uint64_t sequence, Time time) {
    const EventText row = eventText(id);
    Event event;
    event.sequence = sequence;
    event.number = static_cast<int>(id);
    event.type = row.type;
    event.title = row.title;
    event.text = formatEventText(id, {std::to_string(number)});
    event.time = time;
    return event;
}

} // namespace

void RepeatFilter::take(const Event& event) {
    if (isOperational(event)) {
        flush();
        known_.clear();
        put_(event);
        return;
    }
    const auto found = std::find_if(known_.rbegin(), known_.rend(),
                                    [&event](const Known& known) { return event.repeats(known.event); });
    if (found != known_.rend()) {
        count(*found, event.sequence, event.time);
        found->taken = event.sequence;
        return;
    }
    flush();
    put_(event);
    known_.push_back({event, 0, 0, event.sequence});
    if (known_.size() > kWindow) known_.pop_front();
}

bool RepeatFilter::repeat(uint64_t taken, uint64_t sequence, Time time) {
    Known* const known = knownAs(known_, taken);
    if (known != nullptr) count(*known, sequence, time);
    return known != nullptr;
}

const Event* RepeatFilter::find(uint64_t taken) const {
    const Known* const known = knownAs(known_, taken);
    return known != nullptr ? &known->event : nullptr;
}

void RepeatFilter::count(Known& known, uint64_t sequence, Time time) {
    if (known.repeats++ == 0) known.since = time;
    known.event.sequence = sequence;
    known.event.time = time;
}

void RepeatFilter::flush() {
    std::vector<Known*> open;
    for (Known& known : known_)
        if (known.repeats > 0) open.push_back(&known);
    std::sort(open.begin(), open.end(),
              [](const Known* a, const Known* b) { return a->event.sequence < b->event.sequence; });
    for (Known* known : open) {
        Event event = known->event;
        event.count = std::exchange(known->repeats, 0);
        event.since = known->since;
        put_(event);
    }
}

void BoundedOutput::write(const Event& event) {
    constexpr uint64_t kReserved = 1000;
    sequence_ = event.sequence;
    time_ = event.time;
    if (written_ >= most_ + (isLasting(event) ? kReserved : 0)) {
        if (dropped_ == 0) put_(eventOf(EventId::EventLimit, written_, event.sequence, event.time));
        dropped_ += event.count;
        return;
    }
    ++written_;
    put_(event);
}

void BoundedOutput::finish() {
    if (dropped_ > 0) put_(eventOf(EventId::EventsOmitted, std::exchange(dropped_, 0), sequence_, time_));
}

} // namespace rt
