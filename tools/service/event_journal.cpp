#include "tools/service/event_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <set>

namespace rapidc::service {

namespace {

struct Advice {
    const char *consequences = "", *causes = "", *actions = "";
};

Advice adviceFor(int number) {
    switch (number) {
#define EVENT_ADVICE(code, consequences, causes, actions)                                                    \
    case code: return {consequences, causes, actions};
#include "tools/service/event_advice.def"
#undef EVENT_ADVICE
    default: return {};
    }
}

std::string placeOf(const rt::Event& event) {
    if (event.place.module.empty()) return {};
    std::string text = fmt::format("Task {}, module {}", event.task, event.place.module);
    if (!event.place.routine.empty()) text += fmt::format(", routine {}", event.place.routine);
    if (event.place.line != 0) text += fmt::format(", line {}", event.place.line);
    return text + ".";
}

void append(std::string& text, std::string_view more) {
    if (more.empty()) return;
    if (!text.empty()) text += ' ';
    text += more;
}

} // namespace

const std::vector<EventDomain>& eventDomains() {
    static const std::vector<EventDomain> domains = {{0, "Common"},
                                                     {1, "Operational"},
                                                     {2, "System"},
                                                     {3, "Hardware"},
                                                     {4, "Program"},
                                                     {5, "Motion"},
                                                     {7, "I/O & Communication"},
                                                     {8, "User"},
                                                     {9, "Functional Safety"},
                                                     {11, "Process"},
                                                     {12, "Configuration"}};
    return domains;
}

std::string calendarText(int64_t secondsSince1970) {
    const auto time = static_cast<std::time_t>(secondsSince1970);
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    return fmt::format("{:04}-{:02}-{:02} T {:02}:{:02}:{:02}", parts.tm_year + 1900, parts.tm_mon + 1,
                       parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

EventJournal::EventJournal(VirtualController& controller) : controller_(controller) {
    for (const rt::Event& event : controller_.core().log().events())
        take(event);
    Observer observer;
    observer.event = [this](const rt::Event& event) { take(event); };
    token_ = controller_.observers().add(std::move(observer));
}

EventJournal::~EventJournal() {
    controller_.observers().remove(token_);
}

void EventJournal::take(const rt::Event& event) {
    auto message = std::make_shared<EventMessage>();
    message->number = ++lastNumber_;
    message->code = event.number;
    message->type = event.type;
    message->calendarSeconds = controller_.core().calendarSeconds();
    message->task = event.task;
    message->title = event.title;
    message->arguments = event.arguments;
    message->description = event.text;
    append(message->description, placeOf(event));
    const Advice advice = adviceFor(event.number);
    message->consequences = advice.consequences;
    message->causes = advice.causes;
    message->actions = advice.actions;
    if (event.errorNumber != 0)
        append(message->causes,
               fmt::format("{}: {}",
                           event.errorName.empty() ? fmt::format("Error {}", event.errorNumber)
                                                   : event.errorName,
                           controller_.core().log().errorText(event.errorNumber)));
    std::set<int> domains{0, message->domain()};
    for (const int domain : domains) {
        Messages& messages = byDomain_[domain];
        messages.push_back(message);
        if (messages.size() > kKept) messages.pop_front();
    }
    const auto listeners = listeners_;
    for (const auto& [number, listener] : listeners)
        if (listeners_.contains(number)) listener(*message);
}

const EventJournal::Messages& EventJournal::messages(int domain) const {
    static const Messages none;
    const auto found = byDomain_.find(domain);
    return found == byDomain_.end() ? none : found->second;
}

std::shared_ptr<const EventMessage> EventJournal::find(int domain, uint64_t number) const {
    const Messages& all = messages(domain);
    const auto found =
        std::lower_bound(all.begin(), all.end(), number,
                         [](const auto& message, uint64_t wanted) { return message->number < wanted; });
    return found != all.end() && (*found)->number == number ? *found : nullptr;
}

void EventJournal::clear(int domain) {
    byDomain_.erase(domain);
}

void EventJournal::clearAll() {
    byDomain_.clear();
}

uint64_t EventJournal::addListener(Listener listener) {
    listeners_[++lastListener_] = std::move(listener);
    return lastListener_;
}

} // namespace rapidc::service
