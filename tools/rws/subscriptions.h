#pragma once
// Subscriptions: groups of resources whose changes a client receives over a WebSocket (serve-contract 41 to 45). Groups belong to the
// controller's thread; sockets come on the network thread.
//
// Priorities: 2 sends every change at once, 1 the last value each 200 ms, 0 each 5 s, by the wall clock.

#include "tools/rws/front_door.h"
#include "tools/rws/outlet.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::rws {

class Subscriptions final : public SocketGate {
  public:
    /// `subscribables` must be complete and outlive this. `post` executes something on the controller's thread.
    Subscriptions(const Subscribables& subscribables, std::function<void(std::function<void()>)> post)
        : subscribables_(subscribables), post_(std::move(post)) {}
    ~Subscriptions() override;

    void addTo(Router& router);
    /// On the controller's thread: all groups of the session end.
    void sessionEnded(uint64_t session);

    /// On the network thread, about each 20 ms: lets merged events go.
    void tick();
    /// On the network thread: a socket of a session was opened (+1) or has ended (-1).
    void onSockets(std::function<void(uint64_t session, int change)> action) {
        socketsChanged_ = std::move(action);
    }
    std::optional<http::Upgrade> upgrade(const http::Head& head, const std::string& path,
                                         std::shared_ptr<const Session> session, int& status) override;

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kMostHigh = 64;        ///< resources of priority 2 in a group
    static constexpr std::size_t kMostResources = 2000; ///< in a group
    static constexpr std::size_t kMostGroups = 64;      ///< of a session
    static constexpr std::size_t kMostQueued = 1000;    ///< events of one resource that are not merged

    struct Group;
    struct Item {
        std::string text; ///< as the client wrote it: "/rw/iosystem/signals/do1;state"
        int priority = 1;
        Group* group = nullptr;
        std::unique_ptr<Watch> watch;
        std::deque<Entry> queued;
        bool isDirty = false;
        Clock::time_point sent{};
    };
    struct Group {
        uint64_t number = 0;
        Dialect dialect = Dialect::V1;
        std::string base;
        std::shared_ptr<Outlet> outlet;
        std::vector<std::shared_ptr<Item>> items;
    };
    struct Wanted {
        std::string text;
        int priority = 1;
    };
    class Listener;

    static std::optional<Failure> read(const Request& request, std::vector<Wanted>& wanted);
    std::optional<Failure> open(Group& group, const Request& request, const std::vector<Wanted>& wanted,
                                std::vector<Entry>& initial);
    std::optional<Failure> openItem(const Request& request, Item& item, std::vector<Entry>& initial);
    Reply create(const Request& request);
    Reply change(const Request& request);
    Reply show(const Request& request);
    Reply remove(const Request& request);
    Reply removeResource(const Request& request);
    Group* groupOf(const Request& request);
    static std::string_view addressOf(const Entry& entry, const Item& item);
    void changed(Item& item, Entry entry);
    void send(Item& item, const Entry& entry);
    void flush();
    void drop(uint64_t number);

    const Subscribables& subscribables_;
    std::function<void(std::function<void()>)> post_;
    std::function<void(uint64_t, int)> socketsChanged_;
    std::map<uint64_t, Group> groups_;
    std::vector<std::weak_ptr<Item>> dirty_;
    std::atomic<bool> hasDirty_{false};
    /// The event rendered last, which others may want as well.
    struct {
        std::string key;
        std::shared_ptr<const std::string> frame;
    } rendered_;
    uint64_t last_ = 0;
    std::mutex mutex_; ///< of outlets_
    std::map<uint64_t, std::shared_ptr<Outlet>> outlets_;
};

} // namespace rapidc::rws
