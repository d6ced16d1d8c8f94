#include "runtime/net/network.h"

#include "runtime/log/event_log.h"
#include "runtime/net/socket.h"
#include "runtime/sched/task.h"

namespace rt::net {

void Network::open(Scheduler& scheduler, EventLog& log, const NetworkOptions& options) {
    scheduler_ = &scheduler;
    log_ = &log;
    options_ = options;
    own_ = {kServicePort};
    if (options.listen) own_.insert(*options.listen);
}

uint32_t Network::boundIp(uint32_t named) const {
    if (!options_.listen) return isLoopback(named) ? named : kLoopback;
    return *options_.listen == kAnyAddress ? named : *options_.listen;
}

bool Network::isOwn(uint32_t ip) const {
    return isLoopback(ip) || ip == kAnyAddress || own_.count(ip) != 0;
}

std::optional<uint32_t> Network::outsideIp(uint32_t named) const {
    if (options_.offline) return std::nullopt;
    if (const auto found = options_.connect.find(named); found != options_.connect.end())
        return found->second;
    if (isLoopback(named)) return named;
    if (isOwn(named)) return kLoopback;
    return options_.connectAnywhere ? std::optional(named) : std::nullopt;
}

Socket* Network::boundAt(bool datagrams, uint16_t port) const {
    const auto found = bound_.find({datagrams, port});
    return found == bound_.end() ? nullptr : found->second;
}

Socket* Network::reachedBy(bool datagrams, const Address& address) const {
    // All addresses of the controller lead to the same place, as they do on the computer.
    return isOwn(address.ip) ? boundAt(datagrams, address.port) : nullptr;
}

void Network::removeBound(bool datagrams, uint16_t port, const Socket& socket) {
    if (boundAt(datagrams, port) == &socket) bound_.erase({datagrams, port});
}

uint16_t Network::freePort() const {
    constexpr uint16_t kFirst = 49152; // the range for ports of this kind
    for (uint32_t port = kFirst; port <= UINT16_MAX; ++port)
        if (boundAt(true, static_cast<uint16_t>(port)) == nullptr) return static_cast<uint16_t>(port);
    return 0;
}

void Network::noteBound(const Address& named, const Address& used, const Task* task) {
    if (named == used || !noted_.insert({named, used}).second) return;
    const char* reach = isLoopback(used.ip)
                            ? " Only programs on this computer can connect; with --listen others can, too."
                            : "";
    log_->write(EventId::SocketAddressUsed, task, {addressText(named), addressText(used), reach});
}

} // namespace rt::net
