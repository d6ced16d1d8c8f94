#pragma once
// SystemInputs: signals that give orders (SYSSIG_IN of EIO.cfg; manual 2.10).

#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rt {

class Controller;
class Task;

class SystemInputs {
  public:
    explicit SystemInputs(Controller& controller) : controller_(controller) {}

    /// Connects the signals; signals that are not defined and actions that are not known are warnings.
    void configure(const CfgFile& file, std::vector<CfgProblem>& problems);
    /// A change of this signal to 1 starts the program.
    bool isStart(SignalId signal) const;

  private:
    enum class Order : uint8_t {
        Unknown,
        None, ///< means nothing to a virtual controller
        Start,
        StartMain,
        MotorOnStart,
        LoadStart,
        Stop,
        QuickStop,
        StopCycle,
        StopInstruction,
        MotorOn,
        MotorOff,
        PpToMain,
        ResetError,
        ResetEmergencyStop,
        LimitSpeed,
        SimulationMode,
        Interrupt,
        Load,
        Backup,
        Restart,
    };
    struct Input {
        SignalId signal = -1;
        Order order = Order::None;
        std::string action;                 ///< as the configuration spells it
        std::vector<std::string> arguments; ///< Arg1 to Arg6; "" for those that are not given
        const std::string& argument(std::size_t number) const { return arguments[number - 1]; }
        /// One of the arguments is CYCLE.
        bool isOnce() const;
    };
    static Order orderOf(std::string_view action);
    static bool worksInManualMode(Order order);
    void change(const Input& input, bool on);
    std::string carryOut(const Input& input);
    std::string start(const Input& input);
    std::string loadProgram(const Input& input);
    std::string interrupt(const Input& input);
    void limitSpeed(const std::string& unit, bool on);
    Task* taskNamed(const std::string& name) const;

    Controller& controller_;
    std::vector<Input> inputs_;
};

} // namespace rt
