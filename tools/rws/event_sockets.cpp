// The network side of Subscriptions: sockets, rendering, merging.

#include "config/letter_case.h"
#include "tools/rws/render.h"
#include "tools/rws/subscription_parts.h"

#include <algorithm>

namespace rapidc::rws {

namespace {

constexpr std::size_t kMostWaiting = 2000; ///< events of a group without socket; more are merged
/// By priority; a tick may come 20 ms late.
constexpr std::chrono::milliseconds kPeriods[] = {std::chrono::milliseconds(4500),
                                                  std::chrono::milliseconds(180)};

const char* protocolOf(Dialect dialect) {
    return dialect == Dialect::V1 ? "robapi2_subscription" : "rws_subscription";
}

bool listHas(std::string_view list, std::string_view word) {
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        if (http::trimBlanks(list.substr(0, end)) == word) return true;
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return false;
}

} // namespace

Subscriptions::Topic::Topic(uint64_t topicNumber) : number(topicNumber) {
    for (Outlets& each : outlets)
        each = std::make_shared<const std::vector<std::shared_ptr<Outlet>>>();
}

void Subscriptions::Outlet::deliver(uint64_t topic, const std::shared_ptr<const std::string>& text) {
    if (hasEnded) return;
    if (socket) return socket->send(text);
    if (waiting.size() >= kMostWaiting) {
        const auto same = std::find_if(waiting.rbegin(), waiting.rend(),
                                       [&](const Waiting& each) { return each.topic == topic; });
        if (same != waiting.rend()) {
            same->text = text;
            return;
        }
        if (waiting.size() >= 2 * kMostWaiting) return;
    }
    waiting.push_back({topic, text});
}

void Subscriptions::Outlet::opened(std::shared_ptr<http::WebSocket> opened) {
    if (hasEnded) return opened->close(http::CloseCode::Normal, "the subscription has ended");
    if (socket) socket->close(http::CloseCode::GoingAway, "another socket was opened");
    socket = std::move(opened);
    for (const Waiting& each : waiting)
        socket->send(each.text);
    waiting.clear();
}

void Subscriptions::Outlet::stop() {
    hasEnded = true;
    waiting.clear();
}

void Subscriptions::Outlet::close() {
    if (socket) socket->close(http::CloseCode::Normal, "the subscription has ended");
    socket.reset();
}

class Subscriptions::Listener final : public http::SocketListener {
  public:
    Listener(Subscriptions& owner, std::shared_ptr<Outlet> outlet)
        : owner_(owner), outlet_(std::move(outlet)) {}

    void opened(std::shared_ptr<http::WebSocket> socket) override {
        socket_ = socket;
        opening_ = ++outlet_->opening;
        owner_.socketsChanged_(outlet_->session, 1);
        outlet_->opened(std::move(socket));
    }
    void received(std::string, bool) override {
        // Clients of RWS 2.0 must not send anything; RWS 1.0 takes no notice.
        if (outlet_->dialect == Dialect::V2)
            socket_->close(http::CloseCode::PolicyViolation, "clients do not send data");
    }
    void closed() override {
        owner_.socketsChanged_(outlet_->session, -1);
        if (opening_ != outlet_->opening) return;
        outlet_->socket.reset();
        if (outlet_->dialect == Dialect::V2 && !outlet_->hasEnded) owner_.dropLater(outlet_->id);
    }

  private:
    Subscriptions& owner_;
    const std::shared_ptr<Outlet> outlet_;
    std::shared_ptr<http::WebSocket> socket_;
    uint64_t opening_ = 0;
};

std::optional<http::Upgrade> Subscriptions::upgrade(const http::Head& head, const std::string& path,
                                                    std::shared_ptr<const Session> session, int& status) {
    const std::vector<std::string> segments = splitPath(path);
    status = 404;
    if (!session || segments.size() != 2 || segments[0] != "poll") return std::nullopt;
    std::shared_ptr<Outlet> outlet;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [id, each] : outlets_)
            if (std::to_string(id) == segments[1]) outlet = each;
    }
    if (!outlet || outlet->session != session->number || outlet->hasEnded) return std::nullopt;
    status = 400;
    const std::string protocol = protocolOf(outlet->dialect);
    if (!listHas(head.header("sec-websocket-protocol"), protocol)) return std::nullopt;
    if (outlet->dialect == Dialect::V2 && outlet->isTaken) return std::nullopt; // the socket was opened once
    outlet->isTaken = true;
    http::Upgrade upgrade;
    upgrade.subprotocol = protocol;
    upgrade.listener = std::make_shared<Listener>(*this, outlet);
    return upgrade;
}

void Subscriptions::tick() {
    const auto now = std::chrono::steady_clock::now();
    for (; !ending_.empty() && ending_.front().first <= now; ending_.pop_front())
        ending_.front().second->close();
    for (int priority = 0; priority < 2; ++priority) {
        if (now - sent_[priority] < kPeriods[priority]) continue;
        sent_[priority] = now;
        sendMerged(priority);
    }
}

void Subscriptions::sendNow() {
    std::vector<Event> events;
    std::vector<Outlets> outlets;
    {
        const std::lock_guard lock(mutex_);
        events.swap(now_);
        isScheduled_ = false;
        outlets.reserve(events.size());
        for (const Event& event : events)
            outlets.push_back(event.topic->outlets[2]);
    }
    for (std::size_t i = 0; i < events.size(); ++i)
        deliver(events[i], outlets[i]);
}

void Subscriptions::sendMerged(int priority) {
    std::vector<Event> events;
    std::vector<Outlets> outlets;
    {
        const std::lock_guard lock(mutex_);
        for (const std::shared_ptr<Topic>& topic : dirty_[priority]) {
            topic->isDirty[priority] = false;
            std::deque<Entry>& messages = topic->messages[priority];
            if (messages.empty()) {
                events.push_back({topic, topic->latest});
            } else {
                events.push_back({topic, std::move(messages.front())});
                messages.pop_front();
            }
            outlets.push_back(topic->outlets[priority]);
        }
        dirty_[priority].clear();
    }
    for (std::size_t i = 0; i < events.size(); ++i)
        deliver(events[i], outlets[i]);
}

void Subscriptions::deliver(const Event& event, const Outlets& outlets) {
    if (outlets->empty()) return;
    const auto text = std::make_shared<const std::string>(
        renderEvent(event.entry, event.topic->text, bases_[static_cast<std::size_t>(event.topic->dialect)]));
    for (const std::shared_ptr<Outlet>& outlet : *outlets)
        outlet->deliver(event.topic->number, text);
}

} // namespace rapidc::rws
