#include "runtime/log/event_log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

nlohmann::ordered_json jsonOf(const SourcePlace& place) {
    nlohmann::ordered_json json;
    json["module"] = place.module;
    json["routine"] = place.routine;
    json["line"] = place.line;
    json["column"] = place.column;
    json["file"] = place.file;
    return json;
}

std::string placeText(const SourcePlace& place) {
    std::string text = place.module;
    if (place.line != 0) text += fmt::format(":{}", place.line);
    if (place.routine.empty()) return text;
    return text.empty() ? place.routine : fmt::format("{} in {}", text, place.routine);
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

const char* typeName(EventType type) {
    switch (type) {
    case EventType::Information: return "information";
    case EventType::Warning: return "warning";
    case EventType::Error: return "error";
    }
    return "error";
}

const char* domainName(int eventNumber) {
    switch (eventNumber / 10'000) {
    case 0: return "common";
    case 1: return "operational";
    case 2: return "system";
    case 3: return "hardware";
    case 4: return "program";
    case 5: return "motion";
    case 7: return "io";
    case 8: return "user";
    case 9: return "safety";
    case 11: return "process";
    case 12: return "configuration";
    default: return "other";
    }
}

void EventLog::addErrorName(int number, const char* name, const char* text) {
    names_[number] = {name, text != nullptr ? text : ""};
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
    event.sequence = ++sequence_;
    if (event.time < 0) event.time = now_ ? now_() : 0;
    show(event);
    events_.push_back(std::move(event));
    if (events_.size() > kKept) events_.pop_front();
    const uint64_t sequence = sequence_;
    if (!listeners_.empty()) {
        const Event written = events_.back(); // a listener may write events, and remove itself
        const auto listeners = listeners_;
        for (const auto& [id, listener] : listeners)
            if (listeners_.count(id) != 0) listener(written);
    }
    return sequence;
}

uint64_t EventLog::addListener(std::function<void(const Event&)> listener) {
    listeners_[++lastListener_] = std::move(listener);
    return lastListener_;
}

const Event* EventLog::find(uint64_t sequence) const {
    if (events_.empty() || sequence < events_.front().sequence || sequence > events_.back().sequence)
        return nullptr;
    return &events_[static_cast<std::size_t>(sequence - events_.front().sequence)];
}

uint64_t EventLog::write(EventId id, const Task* task, std::initializer_list<std::string> arguments) {
    const EventText row = eventText(id);
    return write(row.type, static_cast<int>(id), row.title, fill(row.text, arguments), task, arguments);
}

uint64_t EventLog::write(EventType type, int number, std::string title, std::string text, const Task* task,
                         std::vector<std::string> arguments) {
    Event event;
    event.number = number;
    event.type = type;
    event.title = std::move(title);
    event.text = std::move(text);
    event.time = -1;
    event.arguments = std::move(arguments);
    if (task != nullptr) {
        event.task = task->name();
        event.place = task->place();
    }
    return write(std::move(event));
}

void EventLog::show(const Event& event) {
    if (json_.isOpen()) json_.write(toJson(event) + "\n");
    if (human_ != nullptr) {
        std::fflush(stdout); // keeps the order of what the terminal shows
        const std::string text = toText(event);
        std::fwrite(text.data(), 1, text.size(), human_);
        std::fflush(human_);
    }
}

void EventLog::restore(const std::vector<Event>& events) {
    const auto own = static_cast<uint64_t>(events_.size());
    for (auto event = events.rbegin(); event != events.rend(); ++event)
        if (events_.size() < kKept) events_.push_front(*event);
    // Those written already keep their order.
    for (Event& event : events_)
        event.sequence = 0;
    const uint64_t last = events.empty() ? 0 : events.back().sequence;
    uint64_t number = last + own;
    for (auto event = events_.rbegin(); event != events_.rend(); ++event)
        event->sequence = number > 0 ? number-- : 0;
    sequence_ = last + own;
}

void EventLog::flush() {
    json_.flush();
    if (human_ != nullptr) std::fflush(human_);
}

std::string toJson(const Event& event) {
    nlohmann::ordered_json json;
    const auto microseconds = event.time / kMicrosecond; // whole ones
    json["sequence"] = event.sequence;
    json["number"] = event.number;
    json["type"] = typeName(event.type);
    json["category"] = domainName(event.number);
    json["title"] = event.title;
    json["text"] = event.text;
    json["time"] = static_cast<double>(microseconds) / 1e6;
    json["task"] = event.task;
    json["module"] = event.place.module;
    json["routine"] = event.place.routine;
    json["line"] = event.place.line;
    if (!event.place.file.empty()) json["file"] = event.place.file;
    if (event.errorNumber != 0) json["errno"] = event.errorNumber;
    if (!event.errorName.empty()) json["errorName"] = event.errorName;
    if (!event.calls.empty()) {
        for (const SourcePlace& call : event.calls)
            json["calls"].push_back(jsonOf(call));
    }
    // Text of a program may hold bytes that are no UTF-8: they are replaced, never a reason to fail.
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string toText(const Event& event) {
    std::string text = fmt::format("[{} s] {} {}: {}\n", formatSeconds(event.time, 3), typeName(event.type),
                                   event.number, event.title);
    if (!event.text.empty()) text += fmt::format("    {}\n", event.text);
    if (!event.task.empty()) {
        const std::string place = placeText(event.place);
        text += place.empty() ? fmt::format("    in task {}\n", event.task)
                              : fmt::format("    at {} {}\n", event.task, place);
    }
    for (const SourcePlace& call : event.calls)
        text += fmt::format("    called from {}\n", placeText(call));
    return text;
}

} // namespace rt
