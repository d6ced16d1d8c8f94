// Controller: everything before the first instruction: configuration, robot, files, tasks, what the program names.

#include "runtime/host/camera_names.h"
#include "runtime/host/controller.h"

#include "runtime/base/text_util.h"
#include "runtime/host/conveyors.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/module_units.h"
#include "runtime/host/run_reports.h"
#include "runtime/host/saved_state.h"
#include "runtime/robot/robot_model.h"
#include "runtime/sim/csv_writers.h"
#include "runtime/sim/surroundings.h"
#include "runtime/sim/trace_merger.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt {
namespace {

/// Path modifiers have led the robot where it cannot be: the task that moves it stops with an error.
void stopOutOfReach(Controller& controller, MotionDriver& motion) {
    Task* mover = nullptr;
    for (const auto& task : controller.tasks())
        if (task->motionGroup() == static_cast<int>(motion.group()) && task->isExecuting())
            mover = task.get();
    const auto& error = motion.system().outOfReachError();
    controller.log().write(EventId::DisplacedOutOfReach, mover,
                           {motion.unitName(), error ? error->message() : ""});
    if (mover == nullptr) return motion.programStop();
    mover->stop(StopCause::Error);
    controller.taskFailed(*mover);
}

void print(const std::string& message) {
    fmt::print(stderr, "error: {}\n", message);
}

ExitStatus printProblems(const std::vector<CfgProblem>& problems) {
    ExitStatus status = ExitStatus::Ended;
    for (const CfgProblem& problem : problems) {
        const std::string place = problem.line == 0 ? "" : fmt::format(":{}", problem.line);
        fmt::print(stderr, "{}{}: {}: {}\n", problem.file, place, problem.warning ? "warning" : "error",
                   problem.message);
        if (problem.warning || status != ExitStatus::Ended) continue;
        status = problem.line == 0 ? ExitStatus::BadUsage : ExitStatus::BadProgram;
    }
    return status;
}

/// A mechanical unit, or a device of SIO.cfg: what a stimulus may give quantities to. A colon after the name does not count.
bool hasDevice(Controller& controller, std::string_view name) {
    const auto plain = [](std::string_view text) { return text.substr(0, text.find(':')); };
    if (controller.units().find(name) != nullptr) return true;
    const auto devices = controller.instances("SIO", "COM_TRP");
    return std::any_of(devices.begin(), devices.end(), [&](const CfgInstance* device) {
        return sameName(plain(device->text("name")), plain(name));
    });
}

std::string textOf(const char* text) {
    return text != nullptr ? text : "";
}

bool signalTypeOf(const std::string& kind, SignalType& type) {
    static constexpr std::pair<const char*, SignalType> kKinds[] = {
        {"signaldi", SignalType::DI}, {"signaldo", SignalType::DO}, {"signalai", SignalType::AI},
        {"signalao", SignalType::AO}, {"signalgi", SignalType::GI}, {"signalgo", SignalType::GO},
    };
    for (const auto& [word, value] : kKinds) {
        if (!sameName(kind, word)) continue;
        type = value;
        return true;
    }
    return false;
}

bool sameAttribute(const CfgAttribute& a, const CfgAttribute& b) {
    return sameName(a.name, b.name) && a.values == b.values;
}

bool sameInstance(const CfgInstance& a, const CfgInstance& b) {
    return std::ranges::equal(a.attributes, b.attributes, sameAttribute);
}

bool sameSection(const CfgSection& a, const CfgSection& b) {
    return a.type == b.type && std::ranges::equal(a.instances, b.instances, sameInstance);
}

/// A file that comes twice, say built in and named again, counts once: its event routines would be executed twice.
void addOnce(std::vector<CfgFile>& files, CfgFile file) {
    const auto same = [&](const CfgFile& other) {
        return other.domain == file.domain && std::ranges::equal(other.sections, file.sections, sameSection);
    };
    if (file.sections.empty() || std::none_of(files.begin(), files.end(), same))
        files.push_back(std::move(file));
}

} // namespace

ExitStatus Controller::prepare(const ProgramDesc& program) {
    program_ = &program;
    tables_.setProgram(program);
    saver_->remember();
    // An order in which each step can use what came before; the first that fails ends it.
    ExitStatus status = readConfiguration(program);
    if (status == ExitStatus::Ended) status = openRobots(program);
    if (status == ExitStatus::Ended) status = readStimulusFile();
    if (status == ExitStatus::Ended && !connectExternals(program)) status = ExitStatus::BadProgram;
    if (status == ExitStatus::Ended) status = openFiles();
    if (status != ExitStatus::Ended) return status;
    makeTasks(program);
    assignGroups();
    applyTaskParameters();
    return openState();
}

// ---- Configuration -------------------------------------------------------------------------------------------------

ExitStatus Controller::readConfiguration(const ProgramDesc& program) {
    std::vector<CfgProblem> problems;
    for (uint32_t i = 0; i < program.configCount; ++i)
        addOnce(configuration_, parseCfg(program.configTexts[i], program.configNames[i], problems));
    for (const std::string& path : options_.configFiles)
        addOnce(configuration_, readCfg(path, problems));
    for (const CfgFile& file : configuration_)
        io_.configure(file, problems);
    io_.finishConfiguration(problems);
    for (const CfgFile& file : configuration_)
        systemSignals_.configure(file, problems);
    applySystemParameters();
    rapid::config::limitProblems(problems);
    return printProblems(problems);
}

std::vector<const CfgInstance*> Controller::instances(std::string_view domain, std::string_view type) const {
    std::vector<const CfgInstance*> result;
    for (const CfgFile& file : configuration_) {
        if (!sameName(file.domain, domain)) continue;
        for (const CfgSection* section : file.find(type)) {
            for (const CfgInstance& instance : section->instances)
                result.push_back(&instance);
        }
    }
    return result;
}

void Controller::applySystemParameters() {
    for (const CfgInstance* instance : instances("SYS", "SYS_MISC")) {
        double value = 0;
        if (sameName(instance->text("Name"), "NoOfRetry") && instance->number("Value", value) && value >= 0) {
            settings_.noOfRetry = static_cast<int>(value);
        }
    }
}

// ---- Robots --------------------------------------------------------------------------------------------------------

namespace {

/// T_ROB2, T_ROB3 ...: the further robots of a controller without a configuration of its tasks.
bool isNamedAsRobot(std::string_view task) {
    constexpr std::string_view kPrefix = "T_ROB";
    return task.size() > kPrefix.size() && sameName(task.substr(0, kPrefix.size()), kPrefix) &&
           std::all_of(task.begin() + kPrefix.size(), task.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
}

} // namespace

/// Which tasks control mechanical units: those with MotionTask in SYS.cfg. When it names none, the first one, and those
/// that are named as the tasks of further robots.
std::vector<bool> Controller::motionTasks(const ProgramDesc& program) const {
    const auto tasks = instances("SYS", "CAB_TASKS");
    const bool isConfigured = std::any_of(
        tasks.begin(), tasks.end(), [](const CfgInstance* instance) { return instance->flag("MotionTask"); });
    std::vector<bool> result;
    for (uint32_t i = 0; i < program.taskCount; ++i) {
        const TaskDesc& task = program.tasks[i];
        const auto here = std::find_if(tasks.begin(), tasks.end(), [&](const CfgInstance* instance) {
            return sameName(instance->text("Name"), task.name);
        });
        result.push_back(isConfigured ? here != tasks.end() && (*here)->flag("MotionTask")
                                      : task.motionTask != 0 || isNamedAsRobot(task.name));
    }
    return result;
}

ExitStatus Controller::openRobots(const ProgramDesc& program) {
    std::vector<std::string> robots;
    for (const CfgInstance* instance : instances("RAPIDC", "OPTIONS")) // of rapidc build
        if (const std::string robot = instance->text("robot"); !robot.empty()) robots.push_back(robot);
    if (!options_.robots.empty()) robots = options_.robots;
    const std::vector<bool> moving = motionTasks(program);
    const auto needed = static_cast<std::size_t>(std::count(moving.begin(), moving.end(), true));
    bool isUsage = false;
    const std::string problem = units_.read(
        [this](std::string_view domain, std::string_view type) { return instances(domain, type); }, robots,
        kDefaultRobot, needed, isUsage);
    if (!problem.empty()) {
        print(problem);
        return isUsage && !options_.robots.empty() ? ExitStatus::BadUsage : ExitStatus::BadProgram;
    }
    for (const std::string& warning : units_.warnings())
        fmt::print(stderr, "warning: {}\n", warning);
    if (const std::string wrong = openConveyors(*this, options_.conveyors); !wrong.empty()) {
        print(wrong);
        return ExitStatus::BadUsage;
    }
    for (const MotionGroup& group : units_.groups()) {
        motion::MotionOptions how = group.options;
        if (options_.planner == "optimal") how.planner = motion::Planner::Optimal;
        motions_.push_back(
            std::make_unique<MotionDriver>(scheduler_, group.model, how, group.robot, motions_.size()));
        motions_.back()->setTick(options_.tick);
        motions_.back()->addListener([this, &motion = *motions_.back()](ArmChange news) {
            if (news == ArmChange::CornerLost)
                log_.write(EventId::CornerPathFailure, motion.orderingTask(), {motion.unitName()});
            if (news == ArmChange::OutOfReach) stopOutOfReach(*this, motion);
        });
    }
    return ExitStatus::Ended;
}

/// A motion task gets the group that SYS.cfg names, else the next robot that has no task yet. Without one it moves nothing.
void Controller::assignGroups() {
    const std::vector<bool> moving = motionTasks(*program_);
    std::vector<bool> taken(motions_.size());
    const auto assign = [&](Task& task, int group) {
        task.setMotionGroup(group);
        if (group >= 0) taken[static_cast<std::size_t>(group)] = true;
    };
    for (const auto& task : tasks_) {
        task->setMotionGroup(-1);
        if (!moving[task->index()]) continue;
        for (const CfgInstance* instance : instances("SYS", "CAB_TASKS"))
            if (sameName(instance->text("Name"), task->name()))
                assign(*task, units_.groupNamed(instance->text("UseMechanicalUnitGroup")));
    }
    for (const auto& task : tasks_) {
        if (!moving[task->index()] || task->motionGroup() >= 0) continue;
        const auto free = std::find(taken.begin(), taken.end(), false);
        if (free != taken.end()) assign(*task, static_cast<int>(free - taken.begin()));
    }
}

// ---- Files ---------------------------------------------------------------------------------------------------------

ExitStatus Controller::openFiles() {
    std::string error;
    const auto refuse = [&error](const char* option) {
        print(fmt::format("{}: {}", option, error));
        return ExitStatus::BadUsage;
    };
    if (!(options_.home.empty() ? volumes_.openTemporary(error) : volumes_.open(options_.home, error)))
        return refuse("--home");
    for (const std::string& volume : options_.volumes) {
        if (!volumes_.useAsWritten(volume, error)) return refuse("--volume");
    }
    for (const std::string& device : options_.devices) {
        if (!volumes_.addDevice(device, error)) return refuse("--device");
    }
    if (const std::string& problem = service<CameraNames>().problem; !problem.empty()) {
        print("--camera: " + problem);
        return ExitStatus::BadUsage;
    }
    if (!options_.outputs.trace.empty()) {
        trace_ = std::make_unique<TraceWriter>(options_.outputs.motors);
        if (!trace_->open(options_.outputs.trace, error)) return refuse("--trace");
        traceMotion();
    }
    if (!options_.outputs.signals.empty()) {
        signalsWriter_ = std::make_unique<SignalsWriter>();
        if (!signalsWriter_->open(options_.outputs.signals, error)) return refuse("--signals");
        io_.addListener(-1, [this](SignalId id, double, double value) {
            signalsWriter_->change(scheduler_.now(), io_.config(id).name, value);
        });
    }
    if (!options_.outputs.errors.empty()) {
        errorsWriter_ = std::make_unique<ErrorsWriter>();
        if (!errorsWriter_->open(options_.outputs.errors, error)) return refuse("--errors");
        scheduler_.setErrorObserver([this](const Task& task, int number) {
            errorsWriter_->raised(scheduler_.now(), task.name(), task.place(), number,
                                  log_.errorName(number));
        });
    }
    if (!options_.outputs.events.empty() && !log_.openJson(options_.outputs.events, error))
        return refuse("--events");
    if (!RunReports::areWanted(options_)) return ExitStatus::Ended;
    reports_ = std::make_unique<RunReports>(options_);
    if (error = reports_->prepare(*this, *program_); !error.empty()) {
        print(error);
        return ExitStatus::BadUsage;
    }
    return ExitStatus::Ended;
}

void Controller::traceMotion() {
    if (motions_.size() == 1) {
        motions_.front()->addTrace(*trace_);
        return;
    }
    traceMerger_ = std::make_unique<TraceMerger>(*trace_, [this] {
        for (const auto& motion : motions_)
            motion->refresh();
    });
    for (const auto& motion : motions_) {
        traceMerger_->addUnit(motion->unitName());
        motion->addTrace(*traceMerger_);
    }
}

ExitStatus Controller::openState() {
    if (resident_) state_->remember();
    if (!earlier_.empty()) state_->continueFrom(std::exchange(earlier_, {}));
    if (options_.state.empty()) return ExitStatus::Ended;
    std::string error;
    if (!state_->open(options_.state, error)) {
        print("--state: " + error);
        return ExitStatus::BadUsage;
    }
    if (state_->restore(error)) return ExitStatus::Ended;
    print("--state: " + error);
    return ExitStatus::BadUsage;
}

/// A name in the stimulus that the configuration lacks; empty when there is none.
static std::string problemOf(Controller& controller, const StimulusItem& item) {
    const IoSystem& io = controller.io();
    switch (item.kind) {
    case StimulusKind::Signal:
        if (io.find(item.target) >= 0) return {};
        return fmt::format("'{}' is neither a signal nor a controller action; define the signal "
                           "in an EIO configuration file (--config)",
                           item.target);
    case StimulusKind::Quantity:
        if (hasDevice(controller, Surroundings::split(item.target)->unit)) return {};
        return fmt::format("'{}' does not name a mechanical unit, nor a device of SIO.cfg", item.target);
    case StimulusKind::SignalInvalid:
    case StimulusKind::SignalValid:
        if (io.find(item.text) >= 0) return {};
        return fmt::format("'{}' is not a signal of the configuration", item.text);
    case StimulusKind::DeviceLost:
    case StimulusKind::DeviceFound:
        if (io.devices().isDevice(item.text)) return {};
        return fmt::format("'{}' is not an I/O device of the configuration", item.text);
    case StimulusKind::NetworkError:
    case StimulusKind::NetworkOk:
        if (io.devices().isNetwork(item.text)) return {};
        return fmt::format("'{}' is not an I/O network of the configuration", item.text);
    default: return {};
    }
}

ExitStatus Controller::readStimulusFile() {
    if (options_.stimulus.empty()) return ExitStatus::Ended;
    std::vector<StimulusProblem> problems;
    stimulus_ = options_.stimulusText ? parseStimulus(*options_.stimulusText, problems)
                                      : readStimulus(options_.stimulus, problems);
    for (const StimulusItem& item : stimulus_) {
        if (std::string problem = problemOf(*this, item); !problem.empty())
            problems.push_back({item.line, std::move(problem)});
    }
    for (const StimulusProblem& problem : problems) {
        if (problem.line == 0)
            fmt::print(stderr, "{}: error: {}\n", options_.stimulus, problem.message);
        else
            fmt::print(stderr, "{}:{}: error: {}\n", options_.stimulus, problem.line, problem.message);
    }
    return problems.empty() ? ExitStatus::Ended : ExitStatus::BadUsage;
}

// ---- Program -------------------------------------------------------------------------------------------------------

void Controller::makeTasks(const ProgramDesc& program) {
    for (uint32_t i = 0; i < program.taskCount; ++i) {
        tasks_.push_back(std::make_unique<Task>(*this, this, scheduler_, program.tasks[i], i));
        tasks_.back()->setStepHook(&debugger_);
    }
}

bool Controller::connectExternals(const ProgramDesc& program) {
    bool all = true;
    for (uint32_t i = 0; i < program.externalCount; ++i)
        all = connectExternal(program.externals[i]) && all;
    return all;
}

bool Controller::connectExternal(const ExternalDesc& external) {
    return rt::connectExternal(*this, external);
}

bool connectExternal(Controller& controller, const ExternalDesc& external) {
    const std::string kind = textOf(external.kind), name = textOf(external.name);
    const auto fail = [&external](const std::string& message) {
        const std::string file = textOf(external.file);
        if (file.empty())
            print(message);
        else
            fmt::print(stderr, "{}:{}:{}: error: {}\n", file, external.line, external.column, message);
        return false;
    };
    SignalType type{};
    if (signalTypeOf(kind, type)) {
        const SignalId id = controller.io().find(name);
        if (id < 0 && controller.instances("EIO", "EIO_SIGNAL").empty()) {
            *external.slot =
                controller.io().undefinedHandle(name); // without any configuration: an error when it is used
            return true;
        }
        if (id < 0) {
            return fail(fmt::format(
                "signal '{}' ({}) is not defined; define it in an EIO configuration file "
                "(EIO_SIGNAL: -Name \"{}\" -SignalType \"{}\") and pass it with --config=FILE.cfg",
                name, kind, name, signalTypeName(type)));
        }
        const SignalConfig& config = controller.io().config(id);
        if (config.type != type) {
            return fail(fmt::format(
                "signal '{}' is used as {} but configured as {} in {}:{}; change one of the two", name,
                signalTypeName(type), signalTypeName(config.type), config.file, config.line));
        }
        *external.slot = IoSystem::handleOf(id);
        return true;
    }
    if (sameName(kind, "mecunit")) { // one that is not there: an error when it is used
        const auto& units = controller.units().all();
        const auto found = std::find_if(units.begin(), units.end(),
                                        [&name](const auto& unit) { return sameName(unit->name, name); });
        *external.slot = found == units.end() ? 0 : found - units.begin() + 1;
        return true;
    }
    if (sameName(kind, "cameradev")) { // one without --camera does not answer
        *external.slot = CameraNames::handleOf(controller.service<CameraNames>().add(name));
        return true;
    }
    if (sameName(kind, "taskid")) { // predefined for each task as <name>Id
        for (uint32_t i = 0; i < controller.program().taskCount; ++i) {
            if (!sameName(name, std::string(controller.program().tasks[i].name) + "Id")) continue;
            *external.slot = static_cast<Handle>(i) + 1;
            return true;
        }
    }
    return fail(fmt::format("'{}' ({}) is not configured on this controller", name, kind));
}

} // namespace rt
