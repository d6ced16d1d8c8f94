#include "stdlib/impl/guided_motion/udp_partner.h"

#include "stdlib/impl/guided_motion/egm_messages.h"

#include "runtime/log/event_log.h"

#include <utility>

namespace rt::lib {

UdpPartner::UdpPartner(net::Network& network, const Task& owner, std::string device,
                       const net::Address& address, uint16_t localPort, GuidanceMode mode)
    : network_(network), owner_(owner), device_(std::move(device)), address_(address), localPort_(localPort),
      mode_(mode) {}

void UdpPartner::begin() {
    socket_ = std::make_unique<net::Socket>(network_, owner_, true);
    sequence_ = 0;
    refused_ = false;
    if (localPort_ != 0) {
        const net::Outcome outcome = socket_->bind({net::kAnyAddress, localPort_});
        if (!outcome.ok()) refuse("its local port cannot be used: " + outcome.why);
    }
    (void)socket_->connect(address_); // of datagrams: those of others do not count
}

bool UdpPartner::receive(SensorData& data) {
    bool isNew = false;
    net::Datagram datagram;
    while (socket_ && socket_->receiveFrom(datagram).ok()) {
        SensorData received;
        const std::string why = decodeSensorMessage(datagram.bytes, mode_, received);
        if (!why.empty()) {
            refuse(why);
            continue;
        }
        data = received;
        isNew = true;
        refused_ = false;
    }
    return isNew;
}

std::string UdpPartner::send(const RobotData& data) {
    if (!socket_) return {};
    const net::Outcome outcome = socket_->sendTo(encodeRobotMessage(data, sequence_), address_);
    if (!outcome.ok()) return outcome.why;
    ++sequence_;
    return {};
}

/// One event for a burst.
void UdpPartner::refuse(const std::string& why) {
    if (std::exchange(refused_, true)) return;
    network_.log().write(EventId::EgmDataRefused, &owner_, {device_, why});
}

} // namespace rt::lib
