#include "stdlib/impl/guided_motion/udp_partner.h"

#include "stdlib/impl/guided_motion/egm_messages.h"

#include "runtime/log/event_log.h"
#include "runtime/sched/scheduler.h"

#include <fmt/format.h>

#include <utility>

namespace rt::lib {

UdpPartner::UdpPartner(net::Network& network, UdpDevices& devices, const Task& owner, UdpDevice device,
                       GuidanceMode mode)
    : network_(network), devices_(devices), owner_(owner), device_(std::move(device)), mode_(mode) {}

void UdpPartner::begin() {
    std::string why;
    socket_ = devices_.take(network_, owner_, device_, why);
    sequence_ = 0;
    refused_ = {};
    if (!why.empty()) refuse("its local port cannot be used: " + why);
}

void UdpPartner::end() {
    if (socket_) socket_->rest();
    socket_.reset();
}

/// All that has come, one socket's room at most.
bool UdpPartner::receive(SensorData& data) {
    if (!socket_) return false;
    bool isNew = false;
    data.hasTarget = false;
    net::Datagram datagram;
    for (std::size_t i = 0; i < net::Socket::kMostDatagrams && socket_->receiveFrom(datagram).ok(); ++i)
        isNew = take(datagram, data) || isNew;
    if (const auto sender = socket_->takeForeign())
        refuse(fmt::format("a datagram came from {} and not from {}", net::addressText(*sender),
                           net::addressText(device_.address)));
    return isNew;
}

/// False when it cannot be used. Parts that the datagram does not have keep the values of earlier ones.
bool UdpPartner::take(const net::Datagram& datagram, SensorData& data) {
    SensorData received;
    std::string why = decodeSensorMessage(datagram.bytes, mode_, received);
    if (datagram.sent > datagram.bytes.size()) why = "a datagram is too long for a message of EGM";
    if (!why.empty()) {
        refuse(why);
        return false;
    }
    refused_.note();
    if (received.digital) data.digital = received.digital;
    if (!received.numbers.empty()) data.numbers = std::move(received.numbers);
    if (!received.hasTarget) return true;
    received.digital = data.digital;
    received.numbers = std::move(data.numbers);
    data = std::move(received);
    return true;
}

std::string UdpPartner::send(const RobotData& data) {
    if (!socket_) return {};
    const net::Outcome outcome = socket_->sendTo(encodeRobotMessage(data, sequence_), device_.address);
    if (!outcome.ok()) return outcome.why;
    ++sequence_;
    return {};
}

/// One event for a burst.
void UdpPartner::refuse(const std::string& why) {
    if (!refused_.begins(network_.scheduler().now())) return;
    network_.log().write(EventId::EgmDataRefused, &owner_, {device_.name, why});
}

} // namespace rt::lib
