#pragma once
// SystemSignals: system inputs (SYSSIG_IN: a signal gives an order) and system outputs (SYSSIG_OUT: a signal shows a state)
// of EIO.cfg; manual 2.10. The virtual controller is in automatic mode with motors on.

#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rt {

class Controller;

class SystemSignals {
  public:
    explicit SystemSignals(Controller& controller) : controller_(controller) {}

    /// Connects the signals; those that are not defined are warnings. Actions and states that mean nothing to a virtual
    /// controller (motors, emergency stop ...) are accepted: such orders do nothing, such states keep their value.
    void configure(const CfgFile& file, std::vector<CfgProblem>& problems);
    /// A change of this signal to 1 starts the program.
    bool isStart(SignalId signal) const;
    /// Outputs follow the state of the controller.
    void update();

  private:
    enum class Order : uint8_t { None, Start, StartMain, Stop, QuickStop, PpToMain, LimitSpeed };
    enum class State : uint8_t {
        None,
        CycleOn,
        TaskExecuting,
        NotMoving,
        Error,
        MotorsOn,
        MotorsOff,
        On,
        SpeedLimited,
        UnitActive
    };
    struct Input {
        SignalId signal = -1;
        Order order = Order::None;
        std::string unit; ///< of LimitSpeed: the robot; "" for all
    };
    struct Output {
        SignalId signal = -1;
        State state = State::None;
        std::string task;
        std::string unit;
    };
    void carryOut(Order order);
    void limitSpeed(const std::string& unit, bool on);
    double stateValue(const Output& output) const;
    bool isActive(const std::string& unit) const;

    Controller& controller_;
    std::vector<Input> inputs_;
    std::vector<Output> outputs_;
};

} // namespace rt
