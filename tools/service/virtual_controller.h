#pragma once
// VirtualController: a controller that lives long: it loads, starts, stops, restarts, and tells its observers what happens.
// `rapidc serve` and the web page sit on it. One thread (run) executes RAPID and everything else here; other threads only post().

#include "runtime/host/controller.h"
#include "runtime/sched/inbox.h"
#include "tools/service/loaded_program.h"
#include "tools/service/observers.h"
#include "tools/service/panel_state.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::service {

struct Settings {
    LoadSettings load;        ///< what is compiled
    rt::RunOptions options;   ///< as of `rapidc run`; home and volumes are folders that exist
    bool programStart = true; ///< motors on, and the program runs from main as soon as the controller is up
    int robotWare = 7;        ///< what clients read: 6, 7 or 8
};

/// "" or why an order is refused; then nothing has changed.
using Refusal = std::string;

/// How a start order executes (execmode of Robot Web Services).
enum class ExecutionMode : uint8_t { Continue, StepIn, StepOver, StepOut, StepBack, StepLast, StepMotion };
enum class StopMode : uint8_t { Stop, Cycle, Instruction, Quick };
enum class RestartMode : uint8_t {
    Warm, ///< data and program pointer stay
    Cold, ///< everything as at the first start, program from its files
};

class VirtualController {
  public:
    explicit VirtualController(Settings settings);
    ~VirtualController();
    VirtualController(const VirtualController&) = delete;
    VirtualController& operator=(const VirtualController&) = delete;

    /// Compiles and prepares; messages go to stderr. Ended when run() may follow.
    rt::ExitStatus open();
    /// Executes until shutDown(); the thread that calls it is the controller's thread.
    rt::ExitStatus run();
    /// From any thread: executes `command` on the controller's thread between the tasks. Dropped after the end of run().
    void post(std::function<void()> command);
    /// From any thread: ends run() soon.
    void shutDown();

    // ---- Everything below: on the controller's thread only -------------------------------------------------
    /// The controller of now. A restart or a program load replaces it: never keep a reference across commands.
    rt::Controller& core() { return *core_; }
    const LoadedProgram& program() const { return *program_; }
    const Settings& settings() const { return settings_; }
    Observers& observers() { return observers_; }

    // ---- Panel -----------------------------------------------------------------------------------------------
    const PanelState& panel() const { return panel_; }
    Refusal setMotors(bool on);
    Refusal setMode(OperatingMode mode);
    /// 0 to 100 %.
    Refusal setSpeedRatio(int percent);
    Refusal setRunOnce(bool once);
    /// The chain of emergency stop buttons: open = true presses one.
    Refusal setEmergencyStop(bool open);

    // ---- Execution -------------------------------------------------------------------------------------------
    bool isRunning() const;
    /// `task`: steps only that one; null: all NORMAL tasks.
    Refusal start(ExecutionMode mode, rt::Task* task = nullptr);
    Refusal stop(StopMode mode);
    /// Program pointer to main in all NORMAL tasks.
    Refusal resetPointers();
    Refusal pointerToRoutine(rt::Task& task, const std::string& module, const std::string& routine);
    Refusal pointerToLine(rt::Task& task, const std::string& module, uint32_t line);
    /// Inactive NORMAL tasks are left out of a start.
    Refusal setTaskActive(rt::Task& task, bool active);
    bool isTaskActive(const rt::Task& task) const;

    // ---- Program memory --------------------------------------------------------------------------------------
    /// `path`: on the host. The program stays as it was when something is wrong.
    Refusal loadModule(rt::Task& task, const std::string& path, const std::string& shown, bool replace);
    Refusal unloadModule(rt::Task& task, const std::string& module);
    /// Replaces the text of a loaded module.
    Refusal setModuleText(rt::Task& task, const std::string& module, const std::string& text);
    /// Counts every change of the modules of the task.
    uint64_t structuralChanges(const rt::Task& task) const;

    // ---- The controller itself -------------------------------------------------------------------------------
    Refusal restart(RestartMode mode);
    /// Writes a backup into a folder that does not exist yet; a folder is complete or absent.
    Refusal backup(const std::string& folder);

    // ---- Virtual time ----------------------------------------------------------------------------------------
    /// Per cent of the wall clock's pace; 0: as fast as possible.
    void setPace(int percent);
    int pace() const { return pace_; }
    void setTimeRunning(bool running);
    bool isTimeRunning() const { return timeRunning_; }

  private:
    Settings settings_;
    rt::Inbox inbox_;
    Observers observers_;
    PanelState panel_;
    std::unique_ptr<LoadedProgram> program_;
    std::unique_ptr<rt::Controller> core_;
    int pace_ = 100;
    bool timeRunning_ = true;
};

} // namespace rapidc::service
