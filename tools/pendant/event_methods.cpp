// events.*: the event log.

#include "config/json_text.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/service/event_journal.h"

#include <deque>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

using service::EventMessage;

constexpr std::size_t kMostWaiting = 200; // messages between two flushes; the newest ones are sent

const char* typeOf(rt::EventType type) {
    switch (type) {
    case rt::EventType::Information: return "state";
    case rt::EventType::Warning: return "warning";
    case rt::EventType::Error: break;
    }
    return "error";
}

Json describe(const EventMessage& message) {
    return {{"number", message.number},     {"code", message.code},
            {"type", typeOf(message.type)}, {"time", service::calendarText(message.calendarSeconds)},
            {"task", message.task},         {"title", message.title}};
}

class EventArea final : public Area {
  public:
    explicit EventArea(const Context& context) : journal_(context.journal), hub_(context.hub) {
        listener_ = journal_.addListener([this](const EventMessage& message) {
            if (!hub_.hasClients()) return;
            waiting_.push_back(pendant::describe(message));
            if (waiting_.size() > kMostWaiting) waiting_.pop_front();
            hub_.wake();
        });
    }
    ~EventArea() override { journal_.removeListener(listener_); }
    EventArea(const EventArea&) = delete;
    EventArea& operator=(const EventArea&) = delete;

    void addTo(MethodTable& methods) override {
        methods.add("events.list", [this](Client&, const Json& params) { return list(params); });
        methods.add("events.details", [this](Client&, const Json& params) { return details(params); });
        methods.add("events.clear", [this](Client&, const Json&) {
            journal_.clearAll();
            return Json();
        });
    }
    void flush() override {
        for (const Json& message : std::exchange(waiting_, {}))
            hub_.broadcast("event", message);
    }

  private:
    Json list(const Json& params) const;
    Json details(const Json& params) const;

    service::EventJournal& journal_;
    Hub& hub_;
    uint64_t listener_ = 0;
    std::deque<Json> waiting_;
};

Json EventArea::list(const Json& params) const {
    const int domain = static_cast<int>(wholeOr(params, "domain", 0, 0, 99));
    const auto before =
        static_cast<uint64_t>(wholeOr(params, "before", int64_t{1} << 53, 0, int64_t{1} << 53));
    const auto count = static_cast<std::size_t>(wholeOr(params, "count", 50, 1, 1000));
    const service::EventJournal::Messages& messages = journal_.messages(domain);
    Json events = Json::array();
    bool more = false;
    for (auto message = messages.rbegin(); message != messages.rend() && !more; ++message) {
        if ((*message)->number >= before) continue;
        more = events.size() >= count;
        if (!more) events.push_back(pendant::describe(**message));
    }
    return {{"events", std::move(events)}, {"more", more}};
}

Json EventArea::details(const Json& params) const {
    const auto number = static_cast<uint64_t>(wholeOf(params, "number", 1, int64_t{1} << 53));
    const auto message = journal_.find(0, number);
    if (!message) notFound(fmt::format("There is no message {} any more", number));
    Json details = pendant::describe(*message);
    details["description"] = message->description;
    details["consequences"] = message->consequences;
    details["causes"] = message->causes;
    details["actions"] = message->actions;
    details["arguments"] = message->arguments;
    return details;
}

} // namespace

std::unique_ptr<Area> makeEventArea(const Context& context) {
    return std::make_unique<EventArea>(context);
}

} // namespace rapidc::pendant
