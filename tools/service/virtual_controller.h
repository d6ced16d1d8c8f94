#pragma once
// VirtualController: a controller that lives long: it loads, starts, stops, restarts, and notifies its observers. `rapidc serve` and the
// web page sit on it. One thread (run) executes RAPID and everything else here; other threads only post().

#include "config/temporary.h"
#include "runtime/host/controller.h"
#include "runtime/host/module_loader.h"
#include "runtime/sched/inbox.h"
#include "tools/program/loaded_program.h"
#include "tools/service/cycle_count.h"
#include "tools/service/module_edits.h"
#include "tools/service/observers.h"
#include "tools/service/panel_state.h"
#include "tools/service/state_watch.h"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace rapidc::service {

struct Settings {
    Inputs inputs;          ///< what is compiled; complete, with the options of `run` that the checker needs
    rt::RunOptions options; ///< as of `rapidc run`; home and volumes are folders that exist
    bool programStart = true; ///< motors on, and the program runs from main as soon as the controller is up
    bool motorsOn = false;    ///< the motors also without programStart
    bool beginsWithMotors() const { return programStart || motorsOn; }
    int robotWare = 7; ///< the version that clients read: 6, 7 or 8
};

/// "" or why an order is refused; then nothing has changed.
using Refusal = std::string;

/// How a start order executes (execmode of Robot Web Services).
enum class ExecutionMode : uint8_t { Continue, StepIn, StepOver, StepOut, StepBack, StepLast, StepMotion };
enum class StopMode : uint8_t {
    Stop,
    Cycle,       ///< at the end of main
    Instruction, ///< before the next instruction
    Quick,
};
enum class RestartMode : uint8_t {
    Warm, ///< data and program pointer stay
    Cold, ///< everything as at the first start, the program from its files
};

class PanelOrders;

// Size: the orders of a controller in one place, so that every client finds the same ones.
class VirtualController {
  public:
    explicit VirtualController(Settings settings);
    ~VirtualController();
    VirtualController(const VirtualController&) = delete;
    VirtualController& operator=(const VirtualController&) = delete;

    /// Compiles and prepares; messages go to stderr. Ended when run() may follow.
    rt::ExitStatus open();
    /// open() once more, with the inputs that onInputs() chooses, before run().
    rt::ExitStatus reopen();
    /// Executes until shutDown() or a signal; the thread that calls it is the controller's thread.
    rt::ExitStatus run();
    /// From any thread: executes `command` on the controller's thread between the tasks. Dropped after the end of run().
    void post(std::function<void()> command);
    /// From any thread: ends run() soon.
    void shutDown();

    // ---- Everything below: on the controller's thread only -------------------------------------------------
    /// The controller of now. A restart or a change of compiled modules replaces it: never keep a reference across commands.
    rt::Controller& core() { return *core_; }
    const LoadedProgram& program() const { return *program_; }
    const Settings& settings() const { return settings_; }
    Observers& observers() { return observers_; }
    /// Called before the present controller is replaced, while its state is still to be taken: what refers to it has to be given up.
    void onRelease(std::function<void()> action) { release_ = std::move(action); }
    /// Called before the compilation of a restart: may choose other files of the configuration.
    void onInputs(std::function<void(Inputs&)> action) { chooseInputs_ = std::move(action); }
    /// The files of the configuration are other ones now: the next restart compiles again.
    void noteConfiguration() { isConfigurationChanged_ = true; }
    /// The folder of the host that a volume is, e.g. "HOME"; "" when there is none of this name.
    std::string folderOf(const std::string& volume);

    // ---- Panel -----------------------------------------------------------------------------------------------
    const PanelState& panel() const { return panel_; }
    Refusal setMotors(bool on);
    /// The motors go off when the mode changes.
    Refusal setMode(OperatingMode mode);
    /// 0 to 100 %.
    Refusal setSpeedRatio(int percent);
    Refusal setRunOnce(bool once);
    /// The emergency stop button: pressed or released. After its release the motors are off until setMotors().
    void pressEmergencyStop(bool pressed);
    /// The reset of an emergency stop, after the release of its button: motors off.
    Refusal confirmEmergencyStop();
    /// Sets the system outputs BackupInProgress and BackupError.
    void noteBackup(bool inProgress, bool failed);
    /// A safeguard: open or closed.
    void openSafeguard(bool open);

    // ---- Execution -------------------------------------------------------------------------------------------
    /// A NORMAL task executes.
    bool isRunning() const;
    /// `task`: that one alone; null: all active NORMAL tasks. This and the orders for the program pointer wait while the
    /// program pointer is on its way to a line; the event log says when one that waited is refused.
    Refusal start(ExecutionMode mode, rt::Task* task = nullptr);
    Refusal stop(StopMode mode);
    /// Program pointer to main in all NORMAL tasks.
    Refusal resetPointers();
    Refusal pointerToRoutine(rt::Task& task, const std::string& module, const std::string& routine);
    /// To the instruction that begins in that line; `line` from 1. Takes effect within some instructions' time.
    Refusal pointerToLine(rt::Task& task, const std::string& module, uint32_t line);
    /// Module and line to which the program pointer of the task is on its way.
    std::optional<std::pair<std::string, uint32_t>> destination(const rt::Task& task) const;
    Refusal setTaskActive(rt::Task& task, bool active);
    bool isTaskActive(const rt::Task& task) const { return core_->isTaskActive(task); }

    // ---- Program memory; the NORMAL tasks must be stopped ------------------------------------------------------
    /// `path`: on the host; `shown`: as clients name it. A module of the same name is replaced, or with `replace` false it is a
    /// refusal. With mistakes in it the program stays as it was.
    Refusal loadModule(rt::Task& task, const std::string& path, const std::string& shown, bool replace);
    Refusal unloadModule(rt::Task& task, const std::string& module);
    /// Files of modules, on the host, come into memory together, in place of modules of the same names and, with `replace`, of all program
    /// modules of the task. Its data begin with their initial values, its program pointer is at main.
    Refusal loadProgram(rt::Task& task, const std::vector<std::string>& files, bool replace);
    /// All program modules of the task go; an empty main takes their place until another program is loaded.
    Refusal unloadProgram(rt::Task& task);
    /// The task begins with this procedure from now on; its program pointer is there.
    Refusal setEntry(rt::Task& task, const std::string& routine);
    /// Replaces the text of a module in memory (not its file).
    Refusal setModuleText(rt::Task& task, const std::string& module, const std::string& text);
    /// The source text of a module in memory; false when there is none.
    bool moduleText(const rt::Task& task, const std::string& module, std::string& text) const;
    /// Counts every change of the modules of the task.
    uint64_t structuralChanges(const rt::Task& task) const;

    // ---- The controller itself -------------------------------------------------------------------------------
    /// Takes effect after the command in progress; commands posted later wait for the new controller.
    Refusal restart(RestartMode mode);
    /// The same as a command of its own when programs must be compiled first, which takes long: the caller can answer before. What keeps
    /// the controller from restarting is in the event log then.
    Refusal orderRestart(RestartMode mode);
    /// An order has been given that replaces the present controller.
    bool isBeingReplaced() const { return succession_ != nullptr; }
    /// The orders of system inputs.
    PanelOrders& panelOrders() { return *panelOrders_; }
    /// A cold restart with the programs, the configuration and the HOME of a backup, a folder of the host. Files of HOME that the backup
    /// does not have stay.
    Refusal restore(const std::string& backup);

    // ---- Virtual time ----------------------------------------------------------------------------------------
    /// Per cent of the wall clock's pace; 0: as fast as possible.
    void setPace(int percent);
    int pace() const { return pace_; }
    void setTimeRunning(bool running);
    bool isTimeRunning() const { return timeRunning_; }
    /// The 4 ms cycle of motion, kept in step with the wall clock: how often, and how often late.
    const CycleCount& cycles() const { return cycles_; }

  private:
    /// A module that is in memory beside the compiled program, and what its data hold.
    struct CarriedModule {
        std::string task;
        rt::LoadRequest request;
        bool dynamic = false, isSystem = false;
        int64_t fileTime = -1;
        std::map<std::string, std::string> persistents, variables; ///< by name, as images
    };
    /// Replacement of the present controller.
    struct Succession {
        std::unique_ptr<LoadedProgram> program; ///< null: the same
        std::string state;                      ///< "" = everything begins again
        std::map<std::string, double> signals;  ///< values that stay
        std::vector<CarriedModule> modules;     ///< that come into memory again
        bool powerOn = true;
        bool programStart = false, motorsOn = false;
    };
    std::unique_ptr<LoadedProgram> compile(const ModuleEdits& edits, std::string& problems,
                                           rt::ExitStatus& status);
    rt::ExitStatus makeCore(const Succession& how);
    std::vector<CarriedModule> loadedModules() const;
    void bringBack(const CarriedModule& module);
    void observe();
    void look();
    void execute(std::function<void()> command);
    void executePostponed();
    rt::ExitStatus succeed();
    Refusal replaceProgram(ModuleEdits edits, const rt::Task& task, const std::string& what);
    Refusal link(rt::Task& task, const rt::LoadRequest& request, const rt::LoadedModule* before,
                 int64_t fileTime);
    void leaveModule(const rt::LoadedModule& module);
    void noteModules(const rt::Task& task, const std::string& what);
    Refusal programStopped(const char* order) const;
    void applyPanel();
    void switchCycle(const char* change);
    std::string openHome();
    void carryOutCursor();
    bool isCursorOnItsWay() const;
    bool postponed(bool starts, std::function<Refusal()> order);
    bool isAnythingMoving() const;
    void everyFourMilliseconds();

    Settings settings_;
    rapid::config::TemporaryFolder home_; ///< HOME when none was given: it outlives restarts
    rt::Inbox inbox_;
    Observers observers_;
    PanelState panel_;
    StateWatch watch_{*this};
    std::unique_ptr<PanelOrders> panelOrders_;
    ModuleEdits edits_;
    std::unique_ptr<LoadedProgram> program_;
    std::unique_ptr<rt::Controller> core_;
    std::unique_ptr<Succession> succession_;
    std::deque<std::function<void()>> postponed_; ///< commands for the next controller
    std::map<std::string, uint64_t> changes_;     ///< of modules, by task
    std::map<std::string, std::string> texts_;    ///< of modules that are not compiled into the program
    std::set<std::string> inactive_;              ///< tasks
    struct Cursor {
        std::string task, module;
        uint32_t line = 0;
        struct Order {
            bool starts = false;
            std::function<Refusal()> carryOut;
        };
        std::vector<Order> next; ///< came meanwhile
    };
    std::optional<Cursor> cursor_; ///< where the program pointer goes as soon as its routine has been entered
    std::function<void()> release_;
    std::function<void(Inputs&)> chooseInputs_;
    Inputs inputs_; ///< of the present program
    bool isConfigurationChanged_ = false;
    bool cycleStop_ = false;
    bool safeguardOpen_ = false, emergencyStop_ = false;
    bool cycling_ = false; ///< the cycle of motion is pending
    CycleCount cycles_;
    int pace_ = 100;
    bool timeRunning_ = true;
    bool ends_ = false;
};

} // namespace rapidc::service
