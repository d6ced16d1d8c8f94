#pragma once
// EventJournal: the event log as people and clients read it: the newest 1000 messages of each domain, and of all of them, across
// restarts. The numbers of messages grow by one over all domains.

#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::service {

struct EventMessage {
    uint64_t number = 0; ///< from 1
    int code = 0;
    rt::EventType type = rt::EventType::Information;
    int64_t calendarSeconds = 0; ///< since 1970, clock of the controller
    std::string task;            ///< "" = the controller
    std::string title, description, consequences, causes, actions;
    std::vector<std::string> arguments;
    int domain() const { return code / 10000; }
};

/// The domains of a controller; 0 ("Common") has the messages of all of them.
struct EventDomain {
    int number;
    const char* name;
};
const std::vector<EventDomain>& eventDomains();

class EventJournal {
  public:
    static constexpr std::size_t kKept = 1000; ///< messages of each domain

    /// The controller has been opened; it must outlive the journal. Takes in what has happened already.
    explicit EventJournal(VirtualController& controller);
    ~EventJournal();
    EventJournal(const EventJournal&) = delete;
    EventJournal& operator=(const EventJournal&) = delete;

    using Messages = std::deque<std::shared_ptr<const EventMessage>>;
    /// Oldest first; 0: of all domains.
    const Messages& messages(int domain) const;
    /// Null when the domain has, or has kept, no message of that number.
    std::shared_ptr<const EventMessage> find(int domain, uint64_t number) const;
    void clear(int domain);
    void clearAll();

    using Listener = std::function<void(const EventMessage&)>;
    /// Called with every new message until removed.
    uint64_t addListener(Listener listener);
    void removeListener(uint64_t listener) { listeners_.erase(listener); }

  private:
    void take(const rt::Event& event);

    VirtualController& controller_;
    Observers::Token token_;
    std::map<int, Messages> byDomain_;
    std::map<uint64_t, Listener> listeners_;
    uint64_t lastNumber_ = 0, lastListener_ = 0;
};

/// "2026-11-25 T 14:03:59"
std::string calendarText(int64_t secondsSince1970);

} // namespace rapidc::service
