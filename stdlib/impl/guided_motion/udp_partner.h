#pragma once
// A program that guides the robot by UDP (EGMSetupUC): the controller sends to the address that SIO.cfg gives the device,
// and takes the answers that come from there.

#include "stdlib/impl/guided_motion/event_burst.h"
#include "stdlib/impl/guided_motion/partner.h"
#include "stdlib/impl/guided_motion/udp_devices.h"

#include "runtime/net/socket.h"

#include <memory>

namespace rt::lib {

class UdpPartner final : public Partner {
  public:
    UdpPartner(net::Network& network, UdpDevices& devices, const Task& owner, UdpDevice device,
               GuidanceMode mode);
    ~UdpPartner() override { end(); }
    std::string name() const override { return device_.name; }
    void begin() override;
    void end() override;
    bool receive(SensorData& data) override;
    std::string send(const RobotData& data) override;
    bool answers() const override { return true; }

  private:
    bool take(const net::Datagram& datagram, SensorData& data);
    void refuse(const std::string& why);

    net::Network& network_;
    UdpDevices& devices_;
    const Task& owner_;
    UdpDevice device_;
    GuidanceMode mode_;
    std::shared_ptr<net::Socket> socket_; ///< during a session
    uint32_t sequence_ = 0;
    EventBurst refused_;
};

} // namespace rt::lib
