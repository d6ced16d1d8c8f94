#pragma once
// SystemOutputs: signals that show states (SYSSIG_OUT of EIO.cfg; manual 2.10).

#include "runtime/base/time.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace rt {

class Controller;
class MotionDriver;
class Task;
struct Event;
struct MechanicalUnit;

class SystemOutputs {
  public:
    explicit SystemOutputs(Controller& controller) : controller_(controller) {}

    /// Connects the signals; signals that are not defined and states that are not known are warnings.
    void configure(const CfgFile& file, std::vector<CfgProblem>& problems);
    /// The signals follow the state of the controller.
    void update();

  private:
    enum class State : uint8_t {
        Unknown,
        Never,  ///< 0: what a virtual controller does not have
        Always, ///< 1
        Auto,
        CycleOn,
        TaskExecuting,
        Production,
        NotMoving,
        Error,
        ProductionError,
        MotorsOn,
        MotorsOff,
        EmergencyStop,
        SupervisionTriggered,
        SpeedLimited,
        UnitActive,
        PointerMoved,
        PathLost,
        SimulationMode,
        BackupInProgress,
        BackupError,
        Speed,         ///< of the TCP, m/s
        SpeedOverride, ///< per cent
    };
    struct Output {
        SignalId signal = -1;
        State state = State::Unknown;
        std::string task;
        std::string unit;
    };
    static State stateOf(std::string_view word);
    void listen();
    void note(const Event& event);
    double valueOf(const Output& output);
    double valueOfMotion(const Output& output) const;
    bool isExecuting(const std::string& task) const;
    bool hasError(const std::string& task);
    bool concerns(const Output& output, const MotionDriver& motion) const;
    bool isActive(const std::string& unit) const;

    Controller& controller_;
    std::vector<Output> outputs_;
    bool listens_ = false;
    bool wasExecuting_ = false;
    bool pointerMoved_ = false;
    std::set<std::string> triggered_; ///< units whose supervision has stopped them since the last start
    Time nextSpeed_ = 0;
};

} // namespace rt
