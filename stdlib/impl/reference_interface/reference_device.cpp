#include "stdlib/impl/reference_interface/reference_device.h"

#include "runtime/base/text_util.h"
#include "runtime/log/event_log.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/sockets/sockets.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <utility>

namespace rt::lib {
namespace {

const data::Wobjdata& world() {
    static const data::Wobjdata kWorld = MotionState().workObject;
    return kWorld;
}

} // namespace

ReferenceDevice::ReferenceDevice(Controller& controller, Task& owner, ReferenceDescription description,
                                 data::Sensor* sensor, bool stopsProgram)
    : controller_(controller), owner_(owner), description_(std::move(description)), sensor_(sensor),
      stopsProgram_(stopsProgram) {}

Status ReferenceDevice::connect(TaskCore* task) {
    net::Network& network = Sockets::of(controller_).network();
    socket_ = std::make_unique<net::Socket>(network, owner_, description_.datagrams);
    net::Outcome outcome = socket_->connect(description_.address);
    if (outcome.fault == net::Fault::Again) {
        const bool isOutside = network.outsideIp(description_.address.ip).has_value();
        WaitSpec spec;
        spec.queues = {&socket_->changed(), &network.listening()};
        spec.condition = [&] {
            outcome = socket_->connect(description_.address);
            return outcome.fault != net::Fault::Again;
        };
        spec.deadline = addTime(owner_.now(), description_.timeout);
        spec.pollPeriod = isOutside ? kReferenceTick : 0;
        spec.outside = [&]() -> std::optional<OutsideWait> {
            if (auto outside = socket_->outside(true)) return outside;
            return isOutside ? std::optional(OutsideWait{}) : std::nullopt;
        };
        WaitResult result{};
        isConnecting_ = true;
        const Status status = owner_.waitFor(spec, result);
        isConnecting_ = false;
        if (status != kOk) {
            end();
            return status;
        }
        if (outcome.fault == net::Fault::Again)
            outcome.why = "it did not take the connection within <TimeOut>";
    }
    if (!outcome.ok()) {
        end();
        show(k::STATE_ERROR, static_cast<float>(err::ERR_COMM_INIT_FAILED));
        return fail(task, err::ERR_COMM_INIT_FAILED,
                    fmt::format("device {} at {} cannot be connected: {}", description_.name,
                                net::addressText(description_.address), outcome.why));
    }
    show(k::STATE_CONNECTED, 0);
    return kOk;
}

void ReferenceDevice::send(const ReferenceProperty& property, void* data, const TypeDesc& type, Time period) {
    sent_ = {&property, data, &type, period, 0};
    unanswered_.clear();
    show(k::STATE_OPERATING, 0);
    schedule();
}

void ReferenceDevice::receive(const ReferenceProperty& property, void* data, const TypeDesc& type,
                              Time period) {
    received_ = {&property, data, &type, period, 0};
    show(k::STATE_OPERATING, 0);
    schedule();
}

void ReferenceDevice::close() {
    end();
    show(k::STATE_CLOSED, 0);
}

void ReferenceDevice::shutDown() {
    if (!isConnecting_) end();
}

void ReferenceDevice::end() {
    if (tick_ != 0) controller_.scheduler().cancel(std::exchange(tick_, 0));
    socket_.reset();
}

/// Periods lie at whole multiples of 4 ms, as the samples of the trace.
void ReferenceDevice::schedule() {
    if (tick_ != 0 || !socket_ || (sent_.period == 0 && received_.period == 0)) return;
    const Time now = controller_.scheduler().now();
    tick_ = controller_.scheduler().at((now / kReferenceTick + 1) * kReferenceTick, [this] {
        tick_ = 0;
        tick();
    });
}

void ReferenceDevice::tick() {
    if (owner_.state() == TaskState::Finished) return end();
    receiveAll();
    if (socket_) sendNow();
    if (socket_) supervise();
    schedule();
}

void ReferenceDevice::sendNow() {
    const Time now = controller_.scheduler().now();
    if (sent_.period == 0 || now < sent_.next) return;
    sent_.next = addTime(now, sent_.period);
    const std::string message = composeMessage(*sent_.property, ++id_, state(), sent_.data, *sent_.type);
    std::size_t done = 0;
    const net::Outcome outcome = description_.datagrams ? socket_->sendTo(message, description_.address)
                                                        : socket_->send(message, done);
    if (description_.isSupervised) unanswered_[id_] = now;
    // A datagram without a receiver is lost, and so is one without room.
    if (!outcome.ok() && outcome.fault != net::Fault::Again && !description_.datagrams) lose(outcome.why);
}

void ReferenceDevice::receiveAll() {
    std::string message, problem;
    if (description_.datagrams) {
        net::Datagram datagram;
        while (socket_ && socket_->receiveFrom(datagram).ok()) {
            stream_ = datagram.bytes;
            if (nextMessage(stream_, message, problem))
                take(message);
            else
                refuse("a datagram holds no whole message");
            stream_.clear();
        }
        return;
    }
    std::size_t count = 0;
    const net::Outcome outcome = socket_->available(count);
    if (outcome.fault == net::Fault::Closed) return lose("it has closed the connection");
    stream_ += socket_->received();
    socket_->take(socket_->received().size());
    while (socket_ && nextMessage(stream_, message, problem))
        take(message);
    if (!problem.empty()) refuse(problem);
}

void ReferenceDevice::take(const std::string& text) {
    XmlElement message;
    std::string problem = readXml(text, message);
    double id = 0;
    if (problem.empty() && parseNumber(message.attribute("Id"), id) && id >= 0 && id <= UINT32_MAX)
        unanswered_.erase(unanswered_.begin(), unanswered_.upper_bound(static_cast<uint32_t>(id)));
    if (problem.empty() && received_.period == 0) return;
    if (problem.empty() && !sameName(message.name, received_.property->tag))
        problem = fmt::format("the message is <{}>, expected <{}>", message.name.substr(0, 40),
                              received_.property->tag);
    if (problem.empty()) problem = takeMessage(*received_.property, message, received_.data, *received_.type);
    if (!problem.empty()) return refuse(problem);
    refused_ = false;
    controller_.scheduler().lookAtData();
}

void ReferenceDevice::supervise() {
    if (unanswered_.empty()) return;
    const Time now = controller_.scheduler().now();
    if (now - unanswered_.begin()->second > description_.timeout)
        lose(fmt::format("a message has not been answered for {} s", description_.timeout / 1e9));
    else if (unanswered_.size() > static_cast<std::size_t>(description_.maxLost) + 1)
        lose(fmt::format("more than {} messages have not been answered", description_.maxLost));
}

/// One event for a burst.
void ReferenceDevice::refuse(const std::string& why) {
    if (std::exchange(refused_, true)) return;
    controller_.log().write(EventId::ReferenceDataRefused, &owner_, {description_.name, why});
}

void ReferenceDevice::lose(const std::string& why) {
    end();
    unanswered_.clear();
    show(k::STATE_ERROR, static_cast<float>(err::ERR_COMM_EXT));
    controller_.log().write(EventId::ReferenceDeviceLost, &owner_,
                            {description_.name, why, stopsProgram_ ? " The program stops." : ""});
    if (stopsProgram_) controller_.actionStop();
}

void ReferenceDevice::show(float state, float error) {
    sensor_->state = state;
    sensor_->errorcode = error;
    controller_.scheduler().lookAtData();
}

InternState ReferenceDevice::state() const {
    InternState state;
    const auto mode = description_.operationModes.find("Automatic");
    state.operationMode = mode == description_.operationModes.end() ? "Auto" : mode->second;
    state.seconds = static_cast<double>(controller_.scheduler().now()) / static_cast<double>(kSecond);
    if (owner_.motionGroup() < 0) return state;
    const motion::MotionSystem& arm = controller_.motion(owner_).system();
    motion::FrameSetup frames;
    if (frameSetup(&owner_, nullptr, &world(), frames) != kOk) return state;
    state.hasArm = true;
    state.actualJoints = state.plannedJoints = arm.currentJoints();
    state.actualPose = state.plannedPose = arm.toRobTarget(state.actualJoints, frames).pose;
    return state;
}

ReferenceDevices& ReferenceDevices::of(Controller& controller) {
    auto& devices = controller.service<ReferenceDevices>();
    if (!std::exchange(devices.isOpen_, true))
        controller.onShutDown([&devices] {
            for (const auto& [name, device] : devices.devices_)
                device->shutDown();
        });
    return devices;
}

ReferenceDevice* ReferenceDevices::find(std::string_view name) const {
    const auto found = devices_.find(upperCase(name));
    return found != devices_.end() && found->second->isConnected() ? found->second.get() : nullptr;
}

ReferenceDevice& ReferenceDevices::add(std::unique_ptr<ReferenceDevice> device) {
    std::unique_ptr<ReferenceDevice>& place = devices_[upperCase(device->description().name)];
    place = std::move(device);
    return *place;
}

void ReferenceDevices::remove(std::string_view name) {
    devices_.erase(upperCase(name));
}

} // namespace rt::lib
