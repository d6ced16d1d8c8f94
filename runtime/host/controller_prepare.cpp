// Controller: everything before the first instruction: configuration, robot, files, tasks, what the program names.

#include "runtime/host/controller.h"

#include "runtime/base/text_util.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/module_units.h"
#include "runtime/host/run_reports.h"
#include "runtime/host/saved_state.h"
#include "runtime/robot/robot_model.h"
#include "runtime/sim/csv_writers.h"

#include <fmt/format.h>

namespace rt {
namespace {

constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

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

} // namespace

ExitStatus Controller::prepare(const ProgramDesc& program) {
    program_ = &program;
    tables_.setProgram(program);
    saver_->remember();
    // An order in which each step can use what came before; the first that fails ends it.
    ExitStatus status = readConfiguration(program);
    if (status == ExitStatus::Ended) status = openRobot();
    if (status == ExitStatus::Ended) status = readStimulusFile();
    if (status == ExitStatus::Ended && !connectExternals(program)) status = ExitStatus::BadProgram;
    if (status == ExitStatus::Ended) status = openFiles();
    if (status != ExitStatus::Ended) return status;
    makeTasks(program);
    applyTaskParameters();
    return openState();
}

// ---- Configuration -------------------------------------------------------------------------------------------------

ExitStatus Controller::readConfiguration(const ProgramDesc& program) {
    std::vector<CfgProblem> problems;
    for (uint32_t i = 0; i < program.configCount; ++i) {
        configuration_.push_back(parseCfg(program.configTexts[i], program.configNames[i], problems));
    }
    for (const std::string& path : options_.configFiles)
        configuration_.push_back(readCfg(path, problems));
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

std::vector<std::string> Controller::mechanicalUnits() const {
    std::vector<std::string> units{std::string(motion_->unitName())};
    for (const char* type : {"ROBOT", "MECHANICAL_UNIT"})
        for (const CfgInstance* instance : instances("MOC", type))
            if (const std::string name = instance->text("name"); !sameName(name, units.front()))
                units.push_back(name);
    return units;
}

// ---- Robot ---------------------------------------------------------------------------------------------------------

ExitStatus Controller::openRobot() {
    std::string name = options_.robot;
    for (const CfgInstance* instance : instances("RAPIDC", "OPTIONS")) { // of rapidc build
        if (name.empty()) name = instance->text("robot");
    }
    for (const CfgInstance* instance : instances("MOC", "ROBOT")) {
        if (name.empty()) name = instance->text("use_robot_type");
    }
    const auto model = robot::loadRobotModel(name.empty() ? kDefaultRobot : name);
    if (!model) {
        print(model.error().message);
        return options_.robot.empty() ? ExitStatus::BadProgram : ExitStatus::BadUsage;
    }
    robot::RobotModel arm = *model;
    applyMotionParameters(arm);
    motion::MotionOptions how;
    if (options_.planner == "optimal") how.planner = motion::Planner::Optimal;
    motion_ = std::make_unique<MotionDriver>(scheduler_, std::move(arm), how);
    motion_->addListener([this](ArmNews news) {
        if (news != ArmNews::CornerLost) return;
        log_.write(EventId::CornerPathFailure, motion_->orderingTask(), {motion_->unitName()});
    });
    return ExitStatus::Ended;
}

/// Base frame and joint bounds of MOC.cfg; metres and radians there.
void Controller::applyMotionParameters(robot::RobotModel& model) const {
    for (const CfgInstance* instance : instances("MOC", "ROBOT")) {
        double* const position[] = {&model.baseFrame.pos.x, &model.baseFrame.pos.y, &model.baseFrame.pos.z};
        for (int i = 0; i < 3; ++i) {
            double metres = 0;
            const std::string attribute = fmt::format("base_frame_pos_{}", "xyz"[i]);
            if (instance->number(attribute, metres)) *position[i] = metres * 1000;
        }
        robot::Quat rotation = model.baseFrame.rot;
        double* const q[] = {&rotation.w, &rotation.x, &rotation.y, &rotation.z};
        for (int i = 0; i < 4; ++i)
            instance->number(fmt::format("base_frame_orient_u{}", i), *q[i]);
        model.baseFrame.rot = robot::normalized(rotation);
        break; // one robot
    }
    for (const CfgInstance* instance : instances("MOC", "ARM")) {
        const std::string name = instance->text("name");
        if (name.size() != 6 || !sameName(name.substr(0, 5), "rob1_") || name[5] < '1' || name[5] > '6')
            continue;
        const auto axis = static_cast<std::size_t>(name[5] - '1');
        double bound = 0;
        if (instance->number("upper_joint_bound", bound)) model.upperDeg[axis] = bound * kDegreesPerRadian;
        if (instance->number("lower_joint_bound", bound)) model.lowerDeg[axis] = bound * kDegreesPerRadian;
    }
}

// ---- Files ---------------------------------------------------------------------------------------------------------

ExitStatus Controller::openFiles() {
    std::string error;
    if (!(options_.home.empty() ? home_.openTemporary(error) : home_.open(options_.home, error))) {
        print("--home: " + error);
        return ExitStatus::BadUsage;
    }
    if (!options_.trace.empty()) {
        trace_ = std::make_unique<TraceWriter>();
        if (!trace_->open(options_.trace, error)) {
            print("--trace: " + error);
            return ExitStatus::BadUsage;
        }
        motion_->addTrace(*trace_);
    }
    if (!options_.signals.empty()) {
        signalsWriter_ = std::make_unique<SignalsWriter>();
        if (!signalsWriter_->open(options_.signals, error)) {
            print("--signals: " + error);
            return ExitStatus::BadUsage;
        }
        io_.addListener(-1, [this](SignalId id, double, double value) {
            signalsWriter_->change(scheduler_.now(), io_.config(id).name, value);
        });
    }
    if (!options_.events.empty() && !log_.openJson(options_.events, error)) {
        print("--events: " + error);
        return ExitStatus::BadUsage;
    }
    if (!RunReports::areWanted(options_)) return ExitStatus::Ended;
    reports_ = std::make_unique<RunReports>(options_);
    if (error = reports_->prepare(*this, *program_); !error.empty()) {
        print(error);
        return ExitStatus::BadUsage;
    }
    return ExitStatus::Ended;
}

ExitStatus Controller::openState() {
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

ExitStatus Controller::readStimulusFile() {
    if (options_.stimulus.empty()) return ExitStatus::Ended;
    std::vector<StimulusProblem> problems;
    stimulus_ = options_.stimulusText ? parseStimulus(*options_.stimulusText, problems)
                                      : readStimulus(options_.stimulus, problems);
    for (const StimulusItem& item : stimulus_) {
        if (item.kind != StimulusKind::Signal || io_.find(item.target) >= 0) continue;
        problems.push_back(
            {item.line, fmt::format("'{}' is neither a signal nor a controller action; define the signal "
                                    "in an EIO configuration file (--config)",
                                    item.target)});
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
        const std::vector<std::string> units = controller.mechanicalUnits();
        const auto found = std::find_if(units.begin(), units.end(),
                                        [&name](const std::string& unit) { return sameName(unit, name); });
        *external.slot = found == units.end() ? 0 : found - units.begin() + 1;
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
