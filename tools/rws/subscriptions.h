#pragma once
// Subscriptions: groups of resources whose changes go to a client over a WebSocket (controller.md 2.4, serve-contract 41 to 45).
//
// Changes come on the controller's thread, which only stores them. The network thread renders each change once, whatever the number of
// clients, and sends the bytes. Changes of low and middle priority are merged before they are rendered.

#include "tools/rws/front_door.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace rapidc::rws {

class Subscriptions final : public SocketGate {
  public:
    using Post = std::function<void(std::function<void()>)>;

    /// `post` and `postToNetwork`: execute something on the thread of the controller and of the network. `subscribables` must be
    /// complete when the first request comes, and must outlive this.
    Subscriptions(const Subscribables& subscribables, Post post, Post postToNetwork);
    ~Subscriptions() override;

    /// POST /subscription and what belongs to it.
    void addTo(Router& router);
    /// "http://127.0.0.1:8080", of the events. Before the first request.
    void setBase(Dialect dialect, std::string base) {
        bases_[static_cast<std::size_t>(dialect)] = std::move(base);
    }
    /// On the controller's thread: all groups of the session end.
    void sessionEnded(uint64_t session);

    // On the network thread:
    /// Each 20 ms or so: lets merged events go.
    void tick();
    /// A socket of a session was opened (+1) or has ended (-1).
    void onSockets(std::function<void(uint64_t session, int change)> action) {
        socketsChanged_ = std::move(action);
    }
    std::optional<http::Upgrade> upgrade(const http::Head& head, const std::string& path,
                                         std::shared_ptr<const Session> session, int& status) override;

  private:
    struct Outlet;
    struct Topic;
    struct Group;
    struct Requested;
    class Listener;
    struct Event {
        std::shared_ptr<Topic> topic;
        Entry entry;
    };
    using Outlets = std::shared_ptr<const std::vector<std::shared_ptr<Outlet>>>;

    // On the controller's thread:
    Reply create(const Request& request);
    Reply change(const Request& request);
    Reply remove(const Request& request);
    Reply removeResource(const Request& request);
    Reply show(const Request& request);
    Group* groupOf(const Request& request);
    std::optional<Failure> readRequested(const Request& request, std::vector<Requested>& requested) const;
    std::optional<Failure> subscribe(const Request& request, Group& group,
                                     const std::vector<Requested>& requested, std::vector<Entry>& initial);
    std::optional<Failure> openTopic(const Request& request, const std::string& text,
                                     std::shared_ptr<Topic>& topic, std::vector<Entry>& initial);
    void connect(Topic& topic, const std::shared_ptr<Outlet>& outlet, int priority);
    void detach(Topic& topic, const std::shared_ptr<Outlet>& outlet);
    void disconnect(const std::shared_ptr<Topic>& topic, const std::shared_ptr<Outlet>& outlet);
    void removeGroup(uint64_t id);
    void closeIfUnused(const std::shared_ptr<Topic>& topic);
    void changed(const std::shared_ptr<Topic>& topic, Entry entry);

    // On the network thread:
    void sendNow();
    void sendMerged(int priority);
    void deliver(const Event& event, const Outlets& outlets);
    void dropLater(uint64_t group);

    /// Groups that have ended, with the time when their sockets are closed; network thread.
    std::deque<std::pair<std::chrono::steady_clock::time_point, std::shared_ptr<Outlet>>> ending_;
    const Subscribables& subscribables_;
    const Post post_, postToNetwork_;
    std::function<void(uint64_t, int)> socketsChanged_ = [](uint64_t, int) {};
    std::chrono::steady_clock::time_point sent_[2]; ///< when merged events went last, by priority
    std::string bases_[2];
    std::map<uint64_t, std::unique_ptr<Group>> groups_; ///< controller's thread
    /// Groups of RWS 2.0 whose socket has closed: they get nothing any more, but clients delete them. Group and session.
    std::deque<std::pair<uint64_t, uint64_t>> spent_;
    std::map<std::pair<Dialect, std::string>, std::shared_ptr<Topic>> topics_; ///< controller's thread
    uint64_t lastGroup_ = 0, lastTopic_ = 0;

    std::mutex mutex_; ///< for what follows, and for parts of Topic
    std::map<uint64_t, std::shared_ptr<Outlet>> outlets_;
    std::vector<Event> now_; ///< changes of high priority, in order
    bool isScheduled_ = false;
    std::vector<std::shared_ptr<Topic>> dirty_[2]; ///< by priority: what changed since the last time
};

} // namespace rapidc::rws
