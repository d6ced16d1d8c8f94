#pragma once
// Signals as the source of guidance (EGMSetupAI, EGMSetupAO, EGMSetupGI).

#include "stdlib/impl/guided_motion/partner.h"

#include "runtime/io/io_system.h"

#include <array>
#include <functional>

namespace rt::lib {

/// The signals for axes 1 to 6, or for x, y, z and the rotations about them, and for additional axes; 0 = not given.
using GuidingSignals = std::array<Handle, 12>;

class SignalPartner final : public Partner {
  public:
    /// `wake` is called when one of the signals changes.
    SignalPartner(IoSystem& io, const GuidingSignals& signals, GuidanceMode mode, std::function<void()> wake);
    ~SignalPartner() override;
    std::string name() const override { return "signals"; }
    bool receive(SensorData& data) override;

  private:
    IoSystem& io_;
    GuidingSignals signals_;
    GuidanceMode mode_;
    uint64_t listener_ = 0;
};

} // namespace rt::lib
