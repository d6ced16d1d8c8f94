#include "stdlib/impl/guided_motion/udp_devices.h"

#include "config/text_util.h"

#include <algorithm>
#include <utility>

namespace rt::lib {
namespace {

/// As many as a socket holds, some times over: a flood has no end.
void dropOld(net::Socket& socket) {
    net::Datagram ignored;
    for (std::size_t i = 0; i < 16 * net::Socket::kMostDatagrams && socket.receiveFrom(ignored).ok(); ++i) {
    }
    (void)socket.takeForeign();
}

} // namespace

std::shared_ptr<net::Socket> UdpDevices::take(net::Network& network, const Task& owner,
                                              const UdpDevice& device, std::string& why) {
    const auto isIt = [&](const Kept& kept) {
        return rapid::config::sameName(kept.device.name, device.name);
    };
    const auto found = std::find_if(kept_.begin(), kept_.end(), isIt);
    const bool isFree = found == kept_.end() || found->socket.use_count() == 1;
    if (found != kept_.end() && isFree && found->device == device &&
        found->socket->state() == net::Socket::State::Connected) {
        dropOld(*found->socket);
        return found->socket;
    }
    if (found != kept_.end() && isFree) kept_.erase(found); // its parameters have changed
    auto socket = std::make_shared<net::Socket>(network, owner, true);
    if (device.localPort != 0) why = socket->bind({net::kAnyAddress, device.localPort}).why;
    (void)socket->connect(device.address); // of datagrams: those of others do not count
    if (isFree && why.empty()) kept_.push_back({device, socket});
    return socket;
}

} // namespace rt::lib
