#pragma once
// The welding equipment of an arc system: the signals that PROC.cfg names for it.

#include "runtime/host/controller.h"

#include <array>
#include <optional>
#include <string>

namespace rt::lib {

enum class ArcOutput : uint8_t { GasOn, WeldOn, FeedOn, FeedOnBwd, AwError, Count };
enum class ArcInput : uint8_t {
    ArcEst,
    GasOk,
    WaterOk,
    WireOk,
    GunOk,
    VoltOk,
    CurrentOk,
    StopProc,
    WeldInhib,
    WireStickErr,
    Count
};
enum class ArcReference : uint8_t { Voltage, Feed, Current, Schedule, Mode, Count };

/// Signals that PROC.cfg does not name are not there: outputs are not set, inputs are as if all were well.
class ArcEquipment {
  public:
    /// Reads what PROC.cfg says of arc system 1 or 2. Returns what is wrong, or "".
    std::string read(Controller& controller, int system);

    void set(ArcOutput output, bool on) const;
    /// A value outside the limits of the signal is set to the limit.
    void refer(ArcReference reference, double value) const;
    /// Null: not configured.
    std::optional<bool> input(ArcInput input) const;
    /// -1: not configured.
    SignalId idOf(ArcInput input) const { return inputs_[static_cast<std::size_t>(input)]; }
    /// How long the arc may take to be established.
    Time ignitionTime() const { return ignitionTime_; }

  private:
    IoSystem* io_ = nullptr;
    std::array<SignalId, static_cast<std::size_t>(ArcOutput::Count)> outputs_{};
    std::array<SignalId, static_cast<std::size_t>(ArcInput::Count)> inputs_{};
    std::array<SignalId, static_cast<std::size_t>(ArcReference::Count)> references_{};
    Time ignitionTime_ = 2 * kSecond;
};

} // namespace rt::lib
