#pragma once
// UdpDevices: the sockets of the devices of EGM. A device keeps its local port for the life of the controller, over sessions and
// processes, as clients answer to where the last message came from.

#include "runtime/net/socket.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rt::lib {

/// A device of SIO.cfg.
struct UdpDevice {
    std::string name;
    net::Address address;
    uint16_t localPort = 0; ///< 0: any free one
    bool operator==(const UdpDevice&) const = default;
};

/// A service of the Controller.
class UdpDevices {
  public:
    /// The socket of this device, for one session at a time (another one gets a socket of its own). Earlier datagrams are dropped.
    /// `why`: its port cannot be used; "" otherwise.
    std::shared_ptr<net::Socket> take(net::Network& network, const Task& owner, const UdpDevice& device,
                                      std::string& why);
    /// The controller shuts down.
    void closeAll() { kept_.clear(); }

  private:
    struct Kept {
        UdpDevice device;
        std::shared_ptr<net::Socket> socket;
    };
    std::vector<Kept> kept_;
};

} // namespace rt::lib
