#pragma once
// The signals of a process equipment: those that PROC.cfg names, else those that bear the usual names.

#include "runtime/host/controller.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rt::lib {

/// A signal of an equipment; "{}" in the usual name is replaced with the number of the equipment.
struct ProcessSignal {
    enum class Kind : uint8_t { Output, Reference, Input };
    const char* attribute; ///< of PROC.cfg, without regard to case and underscores
    const char* usualName;
    Kind kind; ///< digital output; analog or group output; digital input
};

/// Undefined signals are left out: outputs are not set, and the process continues as if all were well.
class ProcessSignals {
  public:
    /// Instance `number`, from 1, of the types of PROC.cfg that begin with `types`. Returns what is wrong, or "".
    std::string read(Controller& controller, std::string_view types, int number,
                     std::span<const ProcessSignal> signals);

    /// A value outside the limits of the signal is set to the limit.
    void set(std::size_t signal, double value) const;
    /// Nothing: not there.
    std::optional<bool> input(std::size_t signal) const;
    /// -1: not there.
    SignalId id(std::size_t signal) const { return ids_[signal]; }
    /// A number of PROC.cfg, 0 or more.
    double number(std::string_view attribute, double otherwise) const;

  private:
    IoSystem* io_ = nullptr;
    std::vector<SignalId> ids_;
    std::vector<const CfgAttribute*> attributes_;
};

/// Number of the instance whose -name is this one, from 1; 0: there is none.
int processInstance(const Controller& controller, std::string_view types, std::string_view name);

} // namespace rt::lib
