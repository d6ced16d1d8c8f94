// Subscriptions: events on their way from a resource to a socket.

#include "tools/rws/subscriptions.h"

#include "tools/rws/render.h"

#include <algorithm>

namespace rapidc::rws {

namespace {

constexpr std::chrono::milliseconds kMergePeriod{180}; // below 200 ms with the period of tick()
constexpr std::chrono::milliseconds kSlowPeriod{4900};

/// Two events are equal in what a client reads.
std::string keyOf(const Entry& entry, std::string_view address, const std::string& base) {
    std::string key = base;
    key += '\n';
    key += address;
    for (const auto& [name, value] : entry.values)
        key += '\n' + name + '=' + value;
    return key;
}

bool speaks(std::string_view offered, std::string_view protocol) {
    while (!offered.empty()) {
        const std::size_t comma = std::min(offered.find(','), offered.size());
        if (http::trimBlanks(offered.substr(0, comma)) == protocol) return true;
        offered.remove_prefix(std::min(comma + 1, offered.size()));
    }
    return false;
}

} // namespace

/// An event of the log is addressed by itself, all others by what was subscribed.
std::string_view Subscriptions::addressOf(const Entry& entry, const Item& item) {
    return entry.type == "elog-message-ev" && !entry.self.empty() ? std::string_view(entry.self) : item.text;
}

/// Values of the same thing are merged; different things (messages of the event log) wait side by side.
void Subscriptions::changed(Item& item, Entry entry) {
    if (item.priority == 2) return send(item, entry);
    const auto same = std::find_if(item.queued.begin(), item.queued.end(),
                                   [&](const Entry& other) { return other.title == entry.title; });
    if (same != item.queued.end())
        *same = std::move(entry);
    else if (item.queued.size() < kMostQueued)
        item.queued.push_back(std::move(entry));
    if (item.isDirty) return;
    for (const auto& own : item.group->items) {
        if (own.get() != &item) continue;
        item.isDirty = true;
        dirty_.push_back(own);
        hasDirty_ = true;
    }
}

void Subscriptions::send(Item& item, const Entry& entry) {
    const std::string_view address = addressOf(entry, item);
    std::string key = keyOf(entry, address, item.group->base);
    if (key != rendered_.key) {
        rendered_.frame = std::make_shared<const std::string>(renderEvent(entry, address, item.group->base));
        rendered_.key = std::move(key);
    }
    item.group->outlet->send(rendered_.frame);
}

void Subscriptions::tick() {
    if (hasDirty_.exchange(false)) post_([this] { flush(); });
}

void Subscriptions::flush() {
    const auto now = Clock::now();
    std::vector<std::weak_ptr<Item>> later;
    for (const std::weak_ptr<Item>& weak : dirty_) {
        const std::shared_ptr<Item> item = weak.lock();
        if (!item || item->group == nullptr) continue;
        if (now - item->sent < (item->priority == 0 ? kSlowPeriod : kMergePeriod)) {
            later.push_back(weak);
            continue;
        }
        for (const Entry& entry : item->queued)
            send(*item, entry);
        item->queued.clear();
        item->isDirty = false;
        item->sent = now;
    }
    dirty_ = std::move(later);
    if (!dirty_.empty()) hasDirty_ = true;
}

// ---- Sockets, on the network thread ------------------------------------------------------------------------------------

class Subscriptions::Listener final : public http::SocketListener {
  public:
    Listener(Subscriptions& owner, uint64_t number, std::shared_ptr<Outlet> outlet, Dialect dialect)
        : owner_(owner), number_(number), outlet_(std::move(outlet)), dialect_(dialect) {}

    void opened(std::shared_ptr<http::WebSocket> socket) override {
        socket_ = socket;
        outlet_->attach(std::move(socket));
        if (owner_.socketsChanged_) owner_.socketsChanged_(outlet_->session, 1);
    }
    void received(std::string, bool) override {
        if (dialect_ == Dialect::V2 && socket_)
            socket_->close(http::CloseCode::PolicyViolation, "clients only listen here");
    }
    void closed() override {
        socket_.reset();
        const bool isLast = outlet_->detach();
        if (owner_.socketsChanged_) owner_.socketsChanged_(outlet_->session, -1);
        if (isLast) owner_.post_([&owner = owner_, number = number_] { owner.drop(number); });
    }

  private:
    Subscriptions& owner_;
    const uint64_t number_;
    std::shared_ptr<Outlet> outlet_;
    const Dialect dialect_;
    std::shared_ptr<http::WebSocket> socket_;
};

std::optional<http::Upgrade> Subscriptions::upgrade(const http::Head& head, const std::string& path,
                                                    std::shared_ptr<const Session> session, int& status) {
    constexpr std::string_view kFolder = "/poll/";
    status = 404;
    if (path.substr(0, kFolder.size()) != kFolder) return std::nullopt;
    uint64_t number = 0;
    for (const char digit : path.substr(kFolder.size())) {
        if (digit < '0' || digit > '9' || number > UINT32_MAX) return std::nullopt;
        number = number * 10 + static_cast<uint64_t>(digit - '0');
    }
    std::shared_ptr<Outlet> outlet;
    {
        const std::lock_guard lock(mutex_);
        const auto found = outlets_.find(number);
        if (found == outlets_.end()) return std::nullopt;
        outlet = found->second;
    }
    if (outlet->session != session->number) {
        status = 403;
        return std::nullopt;
    }
    const std::string protocol =
        session->dialect == Dialect::V1 ? "robapi2_subscription" : "rws_subscription";
    if (!speaks(head.header("sec-websocket-protocol"), protocol)) {
        status = 400;
        return std::nullopt;
    }
    if (!outlet->mayAttach()) return std::nullopt;
    http::Upgrade upgrade;
    upgrade.subprotocol = protocol;
    upgrade.listener = std::make_shared<Listener>(*this, number, outlet, session->dialect);
    return upgrade;
}

} // namespace rapidc::rws
