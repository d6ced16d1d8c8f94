#pragma once
// Controller: everything a running program is in: tasks, clock, signals, robot, event log, operator, HOME:.
// No singletons; a native reaches it by taskOf(core).controller().

#include "runtime/abi/rt_abi.h"
#include "runtime/debug/debugger.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/clock_object.h"
#include "runtime/host/handle_table.h"
#include "runtime/host/mechanical_units.h"
#include "runtime/host/motion_driver.h"
#include "runtime/host/run_options.h"
#include "runtime/host/service_table.h"
#include "runtime/host/system_signals.h"
#include "runtime/host/volumes.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"
#include "runtime/log/event_log.h"
#include "runtime/program/program_tables.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/task.h"
#include "runtime/sim/operator_panel.h"
#include "runtime/sim/stimulus.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

class ModuleSaver;
class RunReports;
class SavedState;
class SignalsWriter;
class ErrorsWriter;
class TraceMerger;
class TraceWriter;

/// Parameters of SYS.cfg that the runtime itself obeys.
struct SystemSettings {
    int noOfRetry = 4; ///< SYS_MISC NoOfRetry
};

// Size: owns all parts of the controller and joins them; each part is a class of its own.
class Controller final : public DebugHost {
  public:
    explicit Controller(const RunOptions& options);
    ~Controller();
    Controller(const Controller&) = delete;
    Controller& operator=(const Controller&) = delete;

    // ---- Parts --------------------------------------------------------------------------------------------
    Scheduler& scheduler() { return scheduler_; }
    IoSystem& io() { return io_; }
    EventLog& log() override { return log_; }
    OperatorPanel& panel() { return panel_; }
    Volumes& volumes() { return volumes_; }
    /// The motion groups, one at least as soon as prepare() succeeded.
    const std::vector<std::unique_ptr<MotionDriver>>& motions() const { return motions_; }
    /// The group that the task controls; for a task that controls none the first one, which it may ask.
    MotionDriver& motion(const Task& task) const {
        return *motions_[static_cast<std::size_t>(std::max(task.motionGroup(), 0))];
    }
    MechanicalUnits& units() { return units_; }
    const MechanicalUnits& units() const { return units_; }
    SteppedArm& arm(const Task& task) override { return motion(task); }
    void forEachArm(const std::function<void(SteppedArm&)>& action) override;
    HandleTable<ClockObject>& clocks() { return clocks_; }
    Debugger& debugger() { return debugger_; }
    ModuleSaver& saver() { return *saver_; }
    const RunOptions& options() const { return options_; }
    const SystemSettings& settings() const { return settings_; }
    /// All configuration files read, in order (every domain).
    const std::vector<CfgFile>& configuration() const { return configuration_; }
    /// All instances of a type in the files of a domain, in order.
    std::vector<const CfgInstance*> instances(std::string_view domain, std::string_view type) const;
    /// Random numbers for Rand, started with --seed; the same sequence on every machine.
    std::mt19937& random() { return random_; }
    /// Date and time of the controller: that of the wall clock at the start plus virtual time. Seconds since 1970, UTC.
    int64_t calendarSeconds() const;
    /// An operator sets the clock.
    void setCalendarSeconds(int64_t seconds) { startCalendar_ += seconds - calendarSeconds(); }

    /// Data that a part of the standard library keeps per controller; made on first use, destroyed with the
    /// controller.
    template <class T> T& service() { return services_.get<T>(); }

    // ---- Program ------------------------------------------------------------------------------------------
    const ProgramDesc& program() const override { return *program_; }
    /// Everything in program memory, modules loaded at run time included.
    ProgramTables& tables() { return tables_; }
    const ProgramTables& tables() const override { return tables_; }
    const std::vector<std::unique_ptr<Task>>& tasks() const override { return tasks_; }
    /// Without regard to case; null when there is none.
    Task* findTask(std::string_view name);
    /// Module data visible in the task: its own, then shared; `module` may be empty. Null when there is none.
    const GlobalDesc* findGlobal(std::string_view name, std::string_view module,
                                 const Task& task) const override;
    /// Routine for late binding; `module` may be empty.
    const RoutineEntry* findRoutine(std::string_view name, std::string_view module,
                                    const Task& task) const override;

    /// Reads configuration, robot, HOME:, stimulus; opens output files; makes the tasks; connects what the
    /// program names. Problems are written to stderr. Ended when there are none.
    ExitStatus prepare(const ProgramDesc& program);
    /// Runs to the end.
    ExitStatus run();

    // ---- A controller that serves clients (controller_resident.cpp) -----------------------------------------
    /// Before prepare(): run() lasts until endRun(). `programStart`: NORMAL tasks start at once; else they wait at main.
    void setResident(bool programStart, bool motorsOn);
    /// run() returns soon.
    void endRun() { endWanted_ = true; }
    /// Commands of other threads, for the whole run.
    void setInbox(Inbox* inbox) { scheduler_.setInbox(inbox); }
    /// While `held` virtual time does not pass.
    void holdTime(bool held) { timeHeld_ = held; }
    /// The cycle in progress is the last one; the next start executes one. Of a resident controller.
    void setRunOnce(bool once) { runOnce_ = once; }
    /// An inactive NORMAL task is left out of starts.
    void setTaskActive(const Task& task, bool active);
    bool isTaskActive(const Task& task) const override;
    void actionMotors(bool on);
    /// Before prepare(): data, program pointers and arms are as captureState() of another controller gave them. `powerOn`: this is
    /// a restart, so the POWER_ON routines run.
    void continueFrom(std::string state, bool powerOn);
    /// Between the tasks.
    std::string captureState() const;
    /// Called between the tasks, often.
    void onLook(std::function<void()> action) { lookActions_.push_back(std::move(action)); }

    /// Called whenever the program of a task begins again, before its RESET routines (settings go back to their defaults).
    void onProgramReset(std::function<void(Task&)> action) { resetActions_.push_back(std::move(action)); }

    /// Called when everything that is open is closed: at a power failure and at the end of the run, once no routine is in
    /// progress any more. The event log still takes events.
    void onShutDown(std::function<void()> action) { shutDownActions_.push_back(std::move(action)); }
    /// Called when EXIT has ended the program of a task, and for each task when the power fails: what the program has open
    /// outside it is lost. `why`: for an event, "the power failed".
    void onConnectionsLost(std::function<void(Task&, const char* why)> action) {
        lossActions_.push_back(std::move(action));
    }

    /// Called before the process sleeps for the wall clock or for something outside: output must be complete.
    void onSleep(std::function<void()> action) { sleepActions_.push_back(std::move(action)); }

    // ---- Controller actions (stimulus, clients): reach all NORMAL tasks -----------------------------------
    /// `event`: Stop, or QuickStop for a quick or an emergency stop.
    void actionStop(SystemEvent event = SystemEvent::Stop);
    /// Motors off: the arm leaves its path; the next start switches them on and returns to it first (manual 2.2.6).
    void actionEmergencyStop();
    /// Everything is halted until actionPowerOn(); then data are as before, outputs as at the start of the controller,
    /// STATIC tasks continue, SEMISTATIC ones begin again, NORMAL ones wait for a start (manual 1.2.2, 1.20, 2.10).
    void actionPowerFail();
    void actionPowerOn();
    void actionStart();
    /// Refused with an event unless the program is stopped.
    void actionPpToMain() override;
    void actionStep(bool forward);

    /// The stopped task is about to execute continuously: START at main, else RESTART becomes due.
    void orderStartEvent(Task& task) override;
    const StateKeepers& stateKeepers() override { return service<StateKeepers>(); }

    /// A NORMAL task was stopped by an error, or a background task stopped the NORMAL tasks.
    bool stoppedByError() const;
    /// False once a background task with TrustLevel SysHalt has stopped.
    bool motorsOn() const { return motorsOn_; }

    // ---- TaskHost ----------------------------------------------------------------------------------------------
    bool cyclesLeft(const Task& task) const override;
    bool staysAtMain(Task& task) override;
    /// The stimulus has a `start` ahead.
    bool startToCome() const override { return startsToCome_ > 0 || resident_; }
    void taskStopped(Task& task) override;
    void cycleLeft(Task& task) override;
    void retried(Task& task) override;
    void taskExited(Task& task) override;
    void eventRoutinesEnded(Task& task, SystemEvent event) override;
    void programReset(Task& task) override;
    /// Variables of loaded modules, too; modules loaded with \Dynamic leave memory.
    Status resetUnits(Task& task) override;
    int retryLimit() const override { return settings_.noOfRetry; }
    /// NORMAL tasks stop; when a STATIC or SEMISTATIC task failed, its TrustLevel decides (manual 1.20).
    void taskFailed(Task& task) override;
    void stopNormalTasks(StopCause cause) override;

  private:
    ExitStatus readConfiguration(const ProgramDesc& program);
    void applySystemParameters();
    std::vector<bool> motionTasks(const ProgramDesc& program) const;
    ExitStatus openRobots(const ProgramDesc& program);
    void assignGroups();
    ExitStatus openFiles();
    void traceMotion();
    ExitStatus openState();
    ExitStatus readStimulusFile();
    bool connectExternals(const ProgramDesc& program);
    bool connectExternal(const ExternalDesc& external);
    void makeTasks(const ProgramDesc& program);
    // task_parameters.cpp
    void applyTaskParameters();
    void setForeground(const CfgInstance& instance);
    void addEventRoutines();
    bool hookConcerns(const CfgInstance& hook, const Task& task) const;
    void backgroundStopped(Task& task);
    void stopTasks(const char* order, SystemEvent event);
    void loseConnections(Task& task, const char* why);
    void scheduleStimulus();
    void perform(const StimulusItem& item);
    bool runOver();
    void beginTasks();
    bool backgroundAtWork();
    bool isStart(const StimulusItem& item) const;
    void reportEnds();
    ExitStatus finish(RunEnd end);
    bool closeOutputs();
    void shutDown();
    std::string whereTasksAre(const char* verb) const;
    std::string startRefusal(const Task& task) const;
    std::string trustLevel(const Task& task) const;

    RunOptions options_;
    EventLog log_;
    Scheduler scheduler_;
    IoSystem io_;
    SystemSignals systemSignals_{*this};
    OperatorPanel panel_{log_};
    Volumes volumes_;
    MechanicalUnits units_;
    std::vector<std::unique_ptr<MotionDriver>> motions_;
    std::unique_ptr<TraceWriter> trace_;
    std::unique_ptr<TraceMerger> traceMerger_; // between several groups and the trace
    std::unique_ptr<SignalsWriter> signalsWriter_;
    std::unique_ptr<ErrorsWriter> errorsWriter_;
    std::unique_ptr<RunReports> reports_;
    HandleTable<ClockObject> clocks_;
    SystemSettings settings_;
    std::vector<CfgFile> configuration_;
    std::vector<StimulusItem> stimulus_;
    std::mt19937 random_;
    int64_t startCalendar_ = 0;
    ServiceTable services_;
    std::vector<std::function<void(Task&)>> resetActions_;
    std::vector<std::function<void()>> shutDownActions_, sleepActions_, lookActions_;
    std::vector<std::function<void(Task&, const char*)>> lossActions_;
    const ProgramDesc* program_ = nullptr;
    ProgramTables tables_;
    std::vector<std::unique_ptr<Task>> tasks_;
    std::size_t startsToCome_ = 0; // `start` and steps that the stimulus has ahead
    Debugger debugger_{*this};
    bool systemFailed_ = false;      // a background task with TrustLevel SysFail or SysHalt has stopped
    bool backgroundStopped_ = false; // one with SysStop has, and there was no start since
    bool motorsOn_ = true;
    bool powerOff_ = false;
    bool resident_ = false, programStart_ = true, runOnce_ = false, timeHeld_ = false, endWanted_ = false;
    std::set<const Task*> inactive_;
    std::string earlier_;
    bool powersOn_ = true;
    Time programsEnded_ = kNever; // when the last NORMAL task came to its end
    std::unique_ptr<ModuleSaver> saver_;
    std::unique_ptr<SavedState> state_;
};

/// Additions of a host to a controller before the program runs (names of errors, services).
using ControllerSetup = void (*)(Controller&);

/// Runs a compiled program from beginning to end with these options: builds the controller, runs, writes what
/// was asked for. Returns the exit status of the process (see ExitStatus). `setup` may be null.
int runProgram(const ProgramDesc& program, const RunOptions& options, ControllerSetup setup);

} // namespace rt
