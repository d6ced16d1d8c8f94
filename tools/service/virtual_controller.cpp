// VirtualController: its life from the first start to the end. Orders: virtual_controller_orders.cpp; program memory:
// virtual_controller_memory.cpp.

#include "tools/service/virtual_controller.h"

#include "runtime/host/panel_switches.h"
#include "runtime/host/stop_signals.h"
#include "runtime/host/system_orders.h"
#include "stdlib/impl/queues/message_queue.h"
#include "tools/program/run_setup.h"
#include "tools/service/panel_orders.h"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace rapidc::service {

namespace {

constexpr rt::Time kMotionPeriod = 4 * rt::kMillisecond;

} // namespace

VirtualController::VirtualController(Settings settings)
    : settings_(std::move(settings)), panelOrders_(std::make_unique<PanelOrders>(*this)) {}

VirtualController::~VirtualController() {
    core_.reset(); // before the code that it executes
}

std::unique_ptr<LoadedProgram> VirtualController::compile(const ModuleEdits& edits, std::string& problems,
                                                          rt::ExitStatus& status) {
    Inputs inputs = inputs_;
    inputs.requireMain = true;
    inputs.adjust = [&edits](std::vector<rapid::sema::TaskInput>& tasks) { edits.applyTo(tasks); };
    auto compilation = checkInputs(inputs);
    if (!compilation->usageErrors.empty()) {
        status = rt::ExitStatus::BadUsage;
        for (const std::string& problem : compilation->usageErrors)
            problems += problem + "\n";
        return nullptr;
    }
    compilation->keepsPredefined = true;
    auto program = std::make_unique<LoadedProgram>(std::move(compilation));
    std::string error;
    const std::string name = nameOfProgram(inputs);
    const bool compiled = program->compile({.name = name, .stepping = true}, error);
    for (const rapid::diag::Diagnostic& diagnostic : program->compilation().sink.sorted())
        if (diagnostic.severity == rapid::diag::Severity::Error)
            problems += rapid::diag::renderText(diagnostic, false);
    if (compiled) return program;
    if (!error.empty()) problems += error + "\n";
    status = rt::ExitStatus::BadProgram;
    return nullptr;
}

rt::ExitStatus VirtualController::open() {
    inputs_ = settings_.inputs;
    std::string problems;
    rt::ExitStatus status = rt::ExitStatus::Ended;
    program_ = compile(edits_, problems, status);
    if (!program_) {
        fmt::print(stderr, "{}", problems);
        return status;
    }
    printDiagnostics(program_->compilation());
    if (const std::string problem = openHome(); !problem.empty()) {
        fmt::print(stderr, "{}\n", problem);
        return rt::ExitStatus::BadUsage;
    }
    panel_.motors = settings_.beginsWithMotors() ? MotorState::On : MotorState::Off;
    Succession first;
    first.programStart = settings_.programStart;
    first.motorsOn = settings_.beginsWithMotors();
    return makeCore(first);
}

rt::ExitStatus VirtualController::reopen() {
    if (release_) release_();
    inputs_ = settings_.inputs;
    if (chooseInputs_) chooseInputs_(inputs_);
    std::string problems;
    rt::ExitStatus status = rt::ExitStatus::Ended;
    auto program = compile(edits_, problems, status);
    if (!program) {
        fmt::print(stderr, "{}", problems);
        return status;
    }
    core_.reset();
    program_ = std::move(program);
    Succession first;
    first.programStart = settings_.programStart;
    first.motorsOn = settings_.beginsWithMotors();
    if (status = makeCore(first); status == rt::ExitStatus::Ended) observers_.changed(Change::Generation);
    return status;
}

/// Without --home: an empty folder, or a copy of the HOME of a backup, so that the backup stays as it is.
std::string VirtualController::openHome() {
    if (!settings_.options.home.empty()) return {};
    const std::string& from = program_->compilation().homeFolder;
    std::string error;
    if (!from.empty()) {
        settings_.options.home = copyHome(from, home_, error);
        return error;
    }
    if (const int problem = home_.make("home"); problem != 0)
        return fmt::format("cannot make a folder for HOME: {}", std::strerror(problem));
    settings_.options.home = home_.path();
    return {};
}

rt::ExitStatus VirtualController::makeCore(const Succession& how) {
    rt::RunOptions options = settings_.options;
    options.configFiles.clear(); // they are in the program already
    core_ = std::make_unique<rt::Controller>(options);
    core_->panel().setAnsweredByClients();
    core_->panel().setOutput(stderr, stderr); // standard output belongs to the addresses
    program_->equip(*core_);
    core_->setInbox(&inbox_);
    core_->service<rt::SystemOrdersSlot>().host = panelOrders_.get();
    core_->setResident(how.programStart, how.motorsOn);
    if (!how.state.empty()) core_->continueFrom(how.state, how.powerOn);
    if (const rt::ExitStatus status = core_->prepare(program_->description());
        status != rt::ExitStatus::Ended)
        return status;
    for (const CarriedModule& module : how.modules)
        bringBack(module);
    bool& areKept = core_->service<rt::SystemOrdersSlot>().valuesAreKept;
    areKept = true; // values that stay give no orders
    for (const auto& [name, value] : how.signals)
        if (const rt::SignalId id = core_->io().find(name); id >= 0) (void)core_->io().force(id, value);
    areKept = false;
    for (const auto& task : core_->tasks())
        core_->setTaskActive(*task, inactive_.count(task->name()) == 0);
    observe();
    applyPanel();
    setPace(pace_);
    core_->holdTime(!timeRunning_);
    return rt::ExitStatus::Ended;
}

/// The panel of a new controller is as that of the one before.
void VirtualController::applyPanel() {
    rt::PanelSwitches& switches = core_->service<rt::PanelSwitches>();
    switches.mode = panel_.mode;
    switches.backupInProgress = panel_.backupInProgress;
    switches.backupFailed = panel_.backupFailed;
    core_->setRunOnce(panel_.runOnce);
    for (const auto& motion : core_->motions())
        motion->setOverride(panel_.speedRatio);
}

void VirtualController::observe() {
    watch_.forget();
    core_->log().addListener([this](const rt::Event& event) { observers_.event(event); });
    core_->io().addListener(-1,
                            [this](rt::SignalId id, double, double value) { observers_.signal(id, value); });
    core_->panel().onLine([this](std::string_view) { observers_.changed(Change::Display); });
    core_->onLook([this] { look(); });
    cycling_ = false;
}

bool VirtualController::isAnythingMoving() const {
    return std::any_of(core_->motions().begin(), core_->motions().end(),
                       [](const auto& motion) { return motion->isMoving(); });
}

/// The cycle of motion, from the beginning of a movement until everything is at rest.
void VirtualController::everyFourMilliseconds() {
    cycles_.count(core_->scheduler().lateness(), kMotionPeriod);
    cycling_ = isAnythingMoving();
    if (cycling_) core_->scheduler().after(kMotionPeriod, [this] { everyFourMilliseconds(); });
    observers_.motion();
}

void VirtualController::look() {
    if (!core_->motorsOn() && panel_.motors == MotorState::On) panel_.motors = MotorState::Off;
    if (core_->motorsOn() && panel_.motors == MotorState::Off) panel_.motors = MotorState::On;
    if (cycleStop_ && !isRunning()) {
        cycleStop_ = false;
        core_->setRunOnce(panel_.runOnce);
    }
    if (cursor_) carryOutCursor();
    if (!cycling_ && isAnythingMoving()) {
        cycling_ = true;
        core_->scheduler().after(kMotionPeriod, [this] { everyFourMilliseconds(); });
    }
    watch_.look();
}

void VirtualController::post(std::function<void()> command) {
    inbox_.post([this, command = std::move(command)]() mutable { execute(std::move(command)); });
}

/// A command that comes after an order to restart is for the next controller. All are executed in the order in which they came.
void VirtualController::execute(std::function<void()> command) {
    postponed_.push_back(std::move(command));
    executePostponed();
}

void VirtualController::executePostponed() {
    while (!postponed_.empty() && !succession_ && !ends_) {
        const std::function<void()> command = std::move(postponed_.front());
        postponed_.pop_front();
        command();
    }
}

void VirtualController::shutDown() {
    inbox_.post([this] {
        ends_ = true;
        if (core_) core_->endRun();
    });
}

rt::ExitStatus VirtualController::run() {
    rt::ExitStatus status = rt::ExitStatus::Ended;
    for (;;) {
        core_->log().write(rt::EventId::ControllerStarted, nullptr);
        status = core_->run();
        if (!succession_ || ends_ || rt::StopSignals::received() != 0) break;
        if (status = succeed(); status != rt::ExitStatus::Ended) break;
    }
    ends_ = true;
    postponed_.clear();
    return status;
}

/// The controller of now ends, and the next one takes its place.
rt::ExitStatus VirtualController::succeed() {
    const std::unique_ptr<Succession> how = std::move(succession_);
    core_.reset();
    if (how->program) program_ = std::move(how->program);
    cursor_.reset();
    cycleStop_ = false;
    if (const rt::ExitStatus status = makeCore(*how); status != rt::ExitStatus::Ended) return status;
    observers_.changed(Change::Generation);
    inbox_.post([this] { executePostponed(); });
    return rt::ExitStatus::Ended;
}

std::string VirtualController::folderOf(const std::string& volume) {
    std::string path;
    return core_->volumes().has(volume) && core_->volumes().resolve(volume + ":", path) ? path
                                                                                        : std::string();
}

Refusal VirtualController::restart(RestartMode mode) {
    auto next = std::make_unique<Succession>();
    next->programStart = settings_.programStart;
    next->motorsOn = settings_.beginsWithMotors();
    if (release_) release_();
    if (mode == RestartMode::Cold || isConfigurationChanged_) {
        std::string problems;
        rt::ExitStatus status = rt::ExitStatus::Ended;
        const ModuleEdits edits = mode == RestartMode::Cold ? ModuleEdits() : edits_;
        Inputs before = inputs_;
        inputs_ = settings_.inputs;
        if (chooseInputs_) chooseInputs_(inputs_);
        next->program = compile(edits, problems, status);
        if (!next->program) {
            inputs_ = std::move(before);
            return "the program has mistakes:\n" + problems;
        }
        edits_ = edits;
        isConfigurationChanged_ = false;
    }
    if (mode == RestartMode::Warm) {
        rt::lib::MessageQueues::of(*core_).emptyAll();
        next->state = core_->captureState();
        next->modules = loadedModules();
    }
    panel_.motors = next->motorsOn ? MotorState::On : MotorState::Off;
    emergencyStop_ = safeguardOpen_ = false;
    succession_ = std::move(next);
    core_->endRun();
    observers_.changed(Change::Restart);
    return {};
}

Refusal VirtualController::orderRestart(RestartMode mode) {
    if (mode == RestartMode::Warm && !isConfigurationChanged_) return restart(mode);
    post([this, mode] {
        if (const Refusal refusal = restart(mode); !refusal.empty())
            core_->log().write(rt::EventId::PowerRefused, nullptr, {"Restart", refusal});
    });
    return {};
}

Refusal VirtualController::restore(const std::string& backup) {
    Inputs before = settings_.inputs;
    settings_.inputs.paths = {backup};
    settings_.inputs.tasks.clear(); // they are in the backup
    settings_.inputs.configFiles.clear();
    std::function<void(Inputs&)> chooseInputs;
    chooseInputs.swap(chooseInputs_); // changes of the configuration belong to what is replaced
    Refusal refusal = restart(RestartMode::Cold);
    chooseInputs_.swap(chooseInputs);
    if (!refusal.empty()) {
        settings_.inputs = std::move(before);
        return refusal;
    }
    const std::string home = folderOf("HOME");
    std::error_code code;
    if (!home.empty() && std::filesystem::is_directory(backup + "/HOME", code))
        std::filesystem::copy(backup + "/HOME", home,
                              std::filesystem::copy_options::recursive |
                                  std::filesystem::copy_options::overwrite_existing |
                                  std::filesystem::copy_options::skip_symlinks,
                              code);
    if (code) fmt::print(stderr, "HOME of the backup: {}\n", code.message());
    return {};
}

void VirtualController::setPace(int percent) {
    pace_ = percent;
    core_->scheduler().setPace(percent > 0, percent > 0 ? percent : 100);
}

void VirtualController::setTimeRunning(bool running) {
    timeRunning_ = running;
    core_->holdTime(!running);
}

} // namespace rapidc::service
