#include "runtime/log/event_log.h"

#include <algorithm>
#include <utility>

namespace rt {
namespace {

constexpr std::size_t kKept = 1000; // as many as a controller keeps per domain

/// Replaces {0} {1} ... by the arguments; other braces stay, since arguments may hold RAPID aggregates or JSON.
std::string fill(std::string_view text, std::initializer_list<std::string> arguments) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}') {
            const auto index = static_cast<std::size_t>(text[i + 1] - '0');
            if (index < arguments.size()) result += arguments.begin()[index];
            i += 2;
        } else {
            result += text[i];
        }
    }
    while (!result.empty() && result.back() == ' ')
        result.pop_back();
    return result;
}

void countAgain(Event& last, const Event& more) {
    if (last.count == 1) last.since = last.time;
    last.count += more.count;
    last.sequence = more.sequence;
    last.time = more.time;
}

} // namespace

EventText eventText(EventId id) {
    switch (id) {
#define EVENT(name, number, type, title, text)                                                               \
    case EventId::name: return {EventType::type, title, text};
#include "runtime/log/event_texts.def"
#undef EVENT
    }
    return {EventType::Error, "Unknown event", ""};
}

std::string formatEventText(EventId id, std::initializer_list<std::string> arguments) {
    return fill(eventText(id).text, arguments);
}

void EventLog::addErrorName(int number, const char* name, const char* text) {
    names_[number] = {name, text != nullptr ? text : ""};
    outdated_ = sequence_;
}

std::string EventLog::errorName(int number) const {
    const auto found = names_.find(number);
    return found == names_.end() ? std::string() : found->second.first;
}

std::string EventLog::errorText(int number) const {
    const auto found = names_.find(number);
    return found == names_.end() ? std::string() : found->second.second;
}

uint64_t EventLog::write(Event event) {
    keepRepeated();
    event.sequence = ++sequence_;
    if (event.time < 0) event.time = now_ ? now_() : 0;
    shown_.take(event);
    keep(event);
    const uint64_t sequence = sequence_;
    if (!listeners_.empty()) {
        const auto listeners = listeners_; // a listener may write events, and remove itself
        for (const auto& [id, listener] : listeners)
            if (listeners_.count(id) != 0) listener(event);
    }
    return sequence;
}

bool EventLog::repeat(uint64_t written, Time time) {
    if (written <= outdated_ || !listeners_.empty()) return false;
    if (!shown_.repeat(written, sequence_ + 1, time)) return false;
    ++sequence_;
    if (repeated_.empty() || repeated_.back().written != written) {
        repeated_.push_back({written, 0, 0, time, 0});
        if (repeated_.size() > kKept) repeated_.pop_front();
    }
    Repeated& last = repeated_.back();
    last.sequence = sequence_;
    last.last = time;
    ++last.count;
    return true;
}

void EventLog::keepRepeated() const {
    for (const Repeated& repeated : repeated_) {
        Event event = *shown_.find(repeated.written); // nothing has been taken since
        event.sequence = repeated.sequence;
        event.time = repeated.last;
        event.count = repeated.count;
        event.since = repeated.count > 1 ? repeated.first : 0;
        keep(event);
    }
    repeated_.clear();
}

void EventLog::keep(const Event& event) const {
    if (!events_.empty() && event.repeats(events_.back())) {
        countAgain(events_.back(), event);
        return;
    }
    events_.push_back(event);
    if (events_.size() > kKept) events_.pop_front();
}

uint64_t EventLog::addListener(std::function<void(const Event&)> listener) {
    listeners_[++lastListener_] = std::move(listener);
    return lastListener_;
}

const Event* EventLog::find(uint64_t sequence) const {
    keepRepeated();
    const auto before = [](const Event& event, uint64_t wanted) { return event.sequence < wanted; };
    const auto found = std::lower_bound(events_.begin(), events_.end(), sequence, before);
    return found != events_.end() && sequence + found->count > found->sequence ? &*found : nullptr;
}

uint64_t EventLog::write(EventId id, EventOrigin origin, std::initializer_list<std::string> arguments) {
    const EventText row = eventText(id);
    return write(row.type, static_cast<int>(id), row.title, fill(row.text, arguments), std::move(origin),
                 arguments);
}

uint64_t EventLog::write(EventType type, int number, std::string title, std::string text, EventOrigin origin,
                         std::vector<std::string> arguments) {
    Event event;
    event.number = number;
    event.type = type;
    event.title = std::move(title);
    event.text = std::move(text);
    event.time = -1;
    event.arguments = std::move(arguments);
    event.task = std::move(origin.task);
    event.place = std::move(origin.place);
    return write(std::move(event));
}

void EventLog::show(const Event& event) {
    if (json_.isOpen()) toFile_.write(event);
    if (human_ == nullptr) return;
    std::fflush(stdout); // keeps the order of what the terminal shows
    toPeople_.write(event);
    std::fflush(human_);
}

void EventLog::putJson(const Event& event) {
    if (json_.isOpen()) json_.write(toJson(event) + "\n");
}

void EventLog::putText(const Event& event) {
    if (human_ == nullptr) return;
    const std::string text = toText(event);
    std::fwrite(text.data(), 1, text.size(), human_);
}

void EventLog::restore(const std::vector<Event>& events) {
    keepRepeated();
    const uint64_t last = events.empty() ? 0 : events.back().sequence;
    for (auto event = events.rbegin(); event != events.rend(); ++event)
        if (events_.size() < kKept) events_.push_front(*event);
    // Those written already keep their order.
    sequence_ += last;
    outdated_ = sequence_;
    uint64_t number = sequence_;
    for (auto event = events_.rbegin(); event != events_.rend(); ++event) {
        event->sequence = number;
        number -= std::min(event->count, number);
    }
}

void EventLog::flush() {
    shown_.flush();
    json_.flush();
    if (human_ != nullptr) std::fflush(human_);
}

void EventLog::finish() {
    shown_.flush();
    toFile_.finish();
    toPeople_.finish();
    flush();
}

} // namespace rt
