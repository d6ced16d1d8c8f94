#include "stdlib/impl/guided_motion/signal_partner.h"

#include <algorithm>
#include <utility>

namespace rt::lib {

SignalPartner::SignalPartner(IoSystem& io, const GuidingSignals& signals, GuidanceMode mode,
                             std::function<void()> wake)
    : io_(io), signals_(signals), mode_(mode) {
    listener_ = io.addListener(-1, [this, wake = std::move(wake)](SignalId id, double, double) {
        const auto isIt = [&](Handle handle) { return handle != 0 && io_.idOf(handle) == id; };
        if (std::any_of(signals_.begin(), signals_.end(), isIt)) wake();
    });
}

SignalPartner::~SignalPartner() {
    io_.removeListener(listener_);
}

bool SignalPartner::receive(SensorData& data) {
    for (std::size_t i = 0; i < signals_.size(); ++i) {
        if (signals_[i] == 0) continue;
        IoResult result{};
        const double value = io_.read(signals_[i], result);
        if (mode_ != GuidanceMode::Joint && i < data.pose.size()) data.pose[i] = value;
        if (i >= data.pose.size()) data.additional[i - data.pose.size()] = value;
        if (mode_ == GuidanceMode::Joint && i < data.joints.size()) data.joints[i] = value; // E1: axis 7
    }
    return true;
}

} // namespace rt::lib
