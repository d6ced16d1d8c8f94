#include "tools/rapidc/pipeline.h"

#include "config/read_file.h"
#include "frontend/lint/lint.h"
#include "frontend/project/project.h"
#include "frontend/project/system_parameters.h"
#include "ir/lower/lower.h"
#include "ir/verify/verify.h"
#include "runtime/host/command_line.h"
#include "runtime/host/conveyors.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/robot/robot_model.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"
#include "tools/rapidc/judge_configuration.h"
#include "tools/rapidc/signal_uses.h"
#include "tools/rapidc/task_specs.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <unistd.h>
#include <unordered_set>

namespace rapidc {

namespace fs = std::filesystem;
namespace sema = rapid::sema;
namespace diag = rapid::diag;

namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// A text that is no system parameters at all: programs of other kinds have files called .cfg, too.
bool isForeign(Compilation& compilation, const std::string& path, const std::string& text,
               const rt::CfgFile& cfg) {
    if (!cfg.domain.empty()) return false;
    compilation.sink.report(diag::say::ForeignConfiguration, std::make_shared<rapid::SourceFile>(path, text),
                            {}, {fs::path(path).filename().string()});
    return true;
}

/// The configured signals and mechanical units by name and RAPID type; the runtime reads the same files again when the program starts.
/// `named`: how many of the files the command line names with --config; the others were found. `withSignals`: also
/// what the controller would find wrong with them.
void readConfiguration(Compilation& compilation, const std::vector<std::string>& files, size_t named,
                       bool withSignals) {
    sema::CheckOptions& options = compilation.options;
    std::vector<rt::CfgProblem> problems;
    for (size_t i = 0; i < files.size(); ++i) {
        const std::string& path = files[i];
        std::string bytes;
        compilation.filesRead.push_back(path);
        if (const std::string problem = rapid::config::readFile(path, bytes); !problem.empty()) {
            compilation.usageErrors.push_back(
                fmt::format("cannot read the configuration file '{}': {}", path, problem));
            continue;
        }
        std::vector<rt::CfgProblem> found;
        const rt::CfgFile cfg = rt::parseCfg(bytes, path, found);
        if (i >= named && isForeign(compilation, path, bytes, cfg)) continue;
        problems.insert(problems.end(), found.begin(), found.end());
        compilation.configNames.push_back(path);
        compilation.configTexts.push_back(bytes);
        if (upper(cfg.domain) == "MOC")
            for (const char* type : {"ROBOT", "MECHANICAL_UNIT"})
                for (const rt::CfgSection* section : cfg.find(type))
                    for (const rt::CfgInstance& unit : section->instances)
                        options.signals.push_back({unit.text("name"), "mecunit"});
        if (upper(cfg.domain) != "EIO") continue;
        options.configurationKnown = true;
        for (const rt::CfgSection* section : cfg.find("EIO_SIGNAL"))
            for (const rt::CfgInstance& signal : section->instances) {
                std::string type = signal.text("SignalType");
                std::transform(type.begin(), type.end(), type.begin(),
                               [](unsigned char c) { return std::tolower(c); });
                options.signals.push_back({signal.text("Name"), "signal" + type});
            }
    }
    if (withSignals) judgeSignals(problems, compilation.configNames, compilation.configTexts);
    rapid::config::limitProblems(problems);
    for (size_t i = 0; i < compilation.configNames.size() && !problems.empty(); ++i)
        reportConfigurationProblems(compilation.sink, compilation.configNames[i], compilation.configTexts[i],
                                    problems);
}

/// Units and signals of simulated conveyors exist without a configuration of their own.
void addConveyors(Compilation& compilation, const std::vector<std::string>& conveyors) {
    std::vector<sema::SignalInfo>& known = compilation.options.signals;
    std::vector<std::string> units;
    for (const sema::SignalInfo& unit : known)
        if (unit.type == "mecunit" && rt::isConveyorName(unit.name)) units.push_back(unit.name);
    units.insert(units.end(), conveyors.begin(), conveyors.end());
    for (const std::string& unit : units) {
        rt::ConveyorSettings settings;
        if (const std::string problem = rt::readConveyorOption(unit, settings); !problem.empty()) {
            compilation.usageErrors.push_back(fmt::format("--conveyor={}: {}", unit, problem));
            continue;
        }
        const auto add = [&known](const std::string& name, const std::string& type) {
            const auto same = [&](const sema::SignalInfo& other) { return lower(other.name) == lower(name); };
            if (std::none_of(known.begin(), known.end(), same)) known.push_back({name, type});
        };
        add(settings.name, "mecunit");
        for (const auto& [name, type] : rt::conveyorSignals(settings))
            add(name, type);
    }
}

/// Event routines and shared modules of SYS.cfg.
void readTaskSettings(Compilation& compilation) {
    for (size_t i = 0; i < compilation.configTexts.size(); ++i) {
        std::vector<rt::CfgProblem> ignored;
        const rt::CfgFile cfg = rt::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        if (upper(cfg.domain) != "SYS") continue;
        for (const rt::CfgSection* section : cfg.find("CAB_EXEC_HOOKS"))
            for (const rt::CfgInstance& hook : section->instances)
                compilation.eventRoutines.insert(lower(hook.text("Routine")));
        for (const rapid::project::ConfiguredModule& module :
             rapid::project::readTaskParameters(compilation.configTexts[i]).modules)
            if (module.shared) compilation.options.sharedModules.insert(lower(module.name));
    }
}

/// The modules that are one for all tasks: those of SYS.cfg, and what a backup holds for all of them.
void findSharedModules(Compilation& compilation, const std::vector<std::string>& sharedFiles) {
    compilation.sharedModules = compilation.options.sharedModules;
    for (const auto& task : compilation.program->tasks)
        for (const sema::Module* module : task->modules)
            if (std::find(sharedFiles.begin(), sharedFiles.end(), module->tree->source->path()) !=
                sharedFiles.end())
                compilation.sharedModules.insert(lower(module->name));
}

/// What SYS.cfg says of the tasks of the command line: entry and type. `typesTold`: tasks whose type the command line
/// tells; that of the first task is NORMAL.
void configureTasks(Compilation& compilation, const std::set<std::string>& typesTold) {
    for (const std::string& text : compilation.configTexts) {
        for (const rapid::project::ConfiguredTask& configured :
             rapid::project::readTaskParameters(text).tasks) {
            for (sema::TaskInput& task : compilation.tasks) {
                if (lower(task.name) != lower(configured.name)) continue;
                task.entry = configured.entry;
                if (!typesTold.contains(task.name)) task.type = configured.type;
            }
        }
    }
}

/// The robot of a backup: that of MOC.cfg, else the one among its options, which becomes part of the configuration.
void checkRobot(Compilation& compilation, const std::string& option) {
    std::string robot = option;
    if (!option.empty()) {
        compilation.configNames.emplace_back("backinfo.txt");
        compilation.configTexts.push_back(fmt::format(
            "MOC:CFG_1.0:7:0::\n#\nROBOT:\n\n      -name \"ROB_1\" -use_robot_type \"{}\"\n", option));
    }
    for (size_t i = 0; i < compilation.configTexts.size() && robot.empty(); ++i) {
        std::vector<rt::CfgProblem> ignored;
        const rt::CfgFile cfg = rt::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        if (cfg.domain != "MOC") continue;
        for (const rt::CfgSection* section : cfg.find("ROBOT"))
            for (const rt::CfgInstance& instance : section->instances)
                if (robot.empty()) robot = instance.text("use_robot_type");
    }
    if (robot.empty()) return;
    if (const auto model = robot::loadRobotModel(robot); !model)
        compilation.sink.report(diag::say::RobotUnknown, nullptr, {},
                                {robot, "name one of the known models with --robot to run the program"});
}

/// Reports built-ins that are called but declared only: each once, where it is called first.
class UnimplementedCalls {
  public:
    UnimplementedCalls() {
        for (const rt::NativeEntry& entry : rt::nativeTable())
            if (!entry.isImplemented()) names_.insert(entry.name);
    }

    /// Takes in the modules of one file, which several tasks may load.
    void file(const sema::CheckedProgram& program, std::span<sema::Module* const> modules) {
        if (!known_) findRoutines(program);
        if (std::none_of(routines_.begin(), routines_.end(),
                         [](const auto* routine) { return routine->used; }))
            return;
        const rapid::syntax::SyntaxTree& tree = *modules.front()->tree; // they share the facts, too
        if (!seen_.insert(tree.source).second) return;
        for (const auto& [node, call] : modules.front()->facts->calls) {
            if (!call.routine || !routines_.contains(call.routine)) continue;
            Use& use = uses_[call.routine->name];
            const rapid::SourceRange range = tree.range(*node);
            if (++use.count == 1) use.file = tree.source;
            if (use.count == 1 || (use.file == tree.source && range.begin < use.first.begin))
                use.first = range;
        }
    }

    void report(diag::Sink& sink) const {
        for (const auto& [name, use] : uses_) {
            const size_t more = use.count - 1;
            sink.report(
                diag::say::BuiltinNotImplemented, use.file, use.first,
                {name, more == 0 ? std::string()
                                 : fmt::format(", here and in {} more place{}", more, more == 1 ? "" : "s")});
        }
    }

  private:
    void findRoutines(const sema::CheckedProgram& program) {
        for (const sema::Module* module : program.predefinedModules)
            for (const sema::RoutineSymbol* routine : module->routines)
                if (routine->native && names_.contains(routine->name)) routines_.insert(routine);
        known_ = true;
    }

    struct Use {
        std::shared_ptr<const rapid::SourceFile> file;
        rapid::SourceRange first;
        size_t count = 0;
    };

    std::unordered_set<std::string_view> names_;
    bool known_ = false;
    std::set<std::shared_ptr<const rapid::SourceFile>> seen_;
    std::map<std::string, Use> uses_;
    std::unordered_set<const sema::RoutineSymbol*> routines_;
};

/// The warnings that are wanted: by the project file beside or above the first input, then by the command line.
void readWarningLevels(const Inputs& inputs, Compilation& compilation) {
    rapid::lint::WarningLevels& levels = compilation.warningLevels;
    if (!inputs.paths.empty()) {
        compilation.filesRead.push_back(rapid::project::findSettings(inputs.paths.front()));
        rapid::lint::applySettings(rapid::project::loadSettings(inputs.paths.front(), compilation.sink),
                                   levels, compilation.sink);
    }
    if (!inputs.lint) levels.set("lint", rapid::lint::Level::Off);
    for (const std::string& option : inputs.warnings) {
        std::string problem;
        if (!rapid::lint::applyOption(option, levels, problem))
            compilation.usageErrors.push_back(std::move(problem));
    }
}

void checkDirectives(Compilation& compilation) {
    std::set<std::string> seen; // several tasks may load a file
    for (const sema::TaskInput& task : compilation.tasks)
        for (const auto& file : task.files)
            if (seen.insert(file->path()).second) rapid::lint::checkDirectives(file, compilation.sink);
}

/// What the configuration files name, in lower case: event routines, service routines, interrupts by system signals.
std::set<std::string> namedByConfiguration(const Compilation& compilation) {
    std::set<std::string> names;
    for (size_t i = 0; i < compilation.configTexts.size(); ++i) {
        std::vector<rt::CfgProblem> ignored;
        const rt::CfgFile cfg = rt::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        for (const rt::CfgSection& section : cfg.sections)
            for (const rt::CfgInstance& instance : section.instances)
                for (const rt::CfgAttribute& attribute : instance.attributes)
                    for (const std::string& value : attribute.values)
                        names.insert(lower(value));
    }
    return names;
}

/// The signals that the program uses and the configuration lacks become part of the configuration.
void assumeSignals(Compilation& compilation) {
    const std::vector<UsedSignal>& signals = compilation.assumedSignals =
        usedSignals(*compilation.program, compilation.options.signals);
    if (signals.empty()) return;
    compilation.configNames.emplace_back("(assumed signals)");
    compilation.configTexts.push_back(writeSignals(signals));
    compilation.sink.report(diag::say::SignalsAssumed, nullptr, {}, {describeSignals(signals)});
    for (const UsedSignal& signal : signals)
        compilation.options.signals.push_back({signal.name, "signal" + lower(signal.type)});
}

/// Checks all tasks and looks at each file as soon as it is checked.
void judge(Compilation& compilation, bool onlyDiagnostics) {
    diag::Sink& sink = compilation.sink;
    UnimplementedCalls unimplemented;
    rapid::lint::Lint lint(compilation.warningLevels, sink, compilation.tasks.size() > 1,
                           compilation.warningLevels.anyLint() ? namedByConfiguration(compilation)
                                                               : std::set<std::string>());
    sema::CheckOptions options = compilation.options;
    options.onlyDiagnostics = onlyDiagnostics;
    options.onFile = [&](const sema::CheckedProgram& program, const sema::Task& task,
                         std::span<sema::Module* const> modules) {
        unimplemented.file(program, modules);
        lint.file(program, task, modules);
    };
    compilation.program = sema::check(compilation.tasks, options, sink);
    checkDirectives(compilation);
    unimplemented.report(sink);
    lint.finish(*compilation.program);
    rapid::lint::applyLevels(compilation.warningLevels, sink);
}

} // namespace

void addAssumeSignalsOption(const rt::Command& command, Inputs& inputs) {
    command.addFlag("--assume-signals", inputs.assumeSignals,
                    "Define signals that no configuration defines as the program uses them");
}

void addWarningOption(const rt::Command& command, Inputs& inputs) {
    command
        .add("-W", inputs.warnings,
             "NAME or no-NAME: switch a warning on or off; error=NAME: make it an error. "
             "'lint' means all of 8xxx, 'all' for every warning")
        .oneValueEach();
}

void addTaskOption(const rt::Command& command, Inputs& inputs) {
    command
        .add("--task", inputs.tasks,
             "A further task, which runs the main of its inputs; NAME:STATIC= and NAME:SEMISTATIC= give its "
             "type; repeatable, also to add inputs to a task")
        .typeName("NAME[:TYPE]=INPUT[,INPUT]")
        .oneValueEach();
}

void addConfigOption(const rt::Command& command, Inputs& inputs) {
    command
        .add("--config", inputs.configFiles,
             "EIO, SYS, MOC, SIO or PROC parameters in ABB's text format; repeatable")
        .typeName("FILE.cfg")
        .oneValueEach();
}

void addRobotOption(const rt::Command& command, Inputs& inputs) {
    command
        .add("--robot", inputs.robots,
             "Robot model, of a further robot UNIT=MODEL; repeatable; rapidc robots lists the models")
        .typeName("[UNIT=]MODEL")
        .oneValueEach();
    command
        .add("--conveyor", inputs.conveyors,
             "Simulated conveyor with its signals, as for rapidc run; repeatable")
        .typeName("UNIT=KEY:VALUE,...")
        .oneValueEach();
}

std::string outputConflict(const Compilation& compilation,
                           std::initializer_list<std::pair<const char*, std::string>> outputs,
                           rapid::config::OutputGuard guard) {
    for (const std::string& path : compilation.filesRead)
        guard.reads(path);
    guard.reads("/proc/self/exe", "rapidc itself");
    for (const auto& [option, path] : outputs)
        guard.writes(path, option);
    return guard.conflict();
}

std::unique_ptr<Compilation> checkInputs(const Inputs& inputs) {
    auto compilation = std::make_unique<Compilation>();
    std::set<std::string> typesTold{"T_ROB1"};
    const std::vector<rapid::project::TaskSpec> specs =
        readTaskSpecs(inputs.tasks, typesTold, compilation->usageErrors);
    for (const std::string& robot : inputs.robots)
        if (const auto model = robot::loadRobotModel(robot.substr(robot.find('=') + 1)); !model)
            compilation->usageErrors.push_back("--robot: " + model.error().message);
    readWarningLevels(inputs, *compilation);
    if (!compilation->usageErrors.empty()) return compilation;
    rapid::project::ProjectInput project;
    if (!inputs.paths.empty()) rapid::project::loadProject(inputs.paths, specs, project, compilation->sink);
    std::vector<std::string> configFiles = inputs.configFiles;
    for (const std::string& found : project.configFiles)
        if (std::find(configFiles.begin(), configFiles.end(), found) == configFiles.end())
            configFiles.push_back(found);
    sema::CheckOptions& options = compilation->options;
    options.requireMain = inputs.requireMain;
    options.robotWareOptions = project.robotWareOptions;
    compilation->homeFolder = project.homeFolder;
    compilation->filesRead.insert(compilation->filesRead.end(), project.filesRead.begin(),
                                  project.filesRead.end());
    options.assumeSignals = inputs.assumeSignals;
    readConfiguration(*compilation, configFiles, inputs.configFiles.size(),
                      inputs.onlyDiagnostics); // else the controller judges signals
    addConveyors(*compilation, inputs.conveyors);
    for (const std::string& camera : inputs.cameras)
        options.signals.push_back({camera.substr(0, camera.find('=')), "cameradev"});
    if (project.isBackup) checkRobot(*compilation, project.robot);
    for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources())
        compilation->library.push_back({source.name, source.text});
    options.library = compilation->library;
    compilation->tasks = std::move(project.tasks);
    if (!project.isBackup) configureTasks(*compilation, typesTold);
    readTaskSettings(*compilation);
    judge(*compilation, inputs.onlyDiagnostics);
    if (inputs.assumeSignals) assumeSignals(*compilation);
    findSharedModules(*compilation, project.sharedFiles);
    return compilation;
}

namespace {
/// False when there are any.
bool reportFindings(const std::vector<std::string>& findings, diag::Sink& sink) {
    for (const std::string& finding : findings)
        sink.report(diag::say::InternalIr, nullptr, {}, {finding});
    return findings.empty();
}
} // namespace

bool lowerToIr(Compilation& compilation, const std::string& name, bool stepping, ir::Module& out,
               size_t passesBelow) {
    rapid::lower::Options options;
    options.programName = name;
    options.stepping = stepping;
    options.callsByName = compilation.callsByName;
    options.configNames = compilation.configNames;
    options.configTexts = compilation.configTexts;
    options.eventRoutines = compilation.eventRoutines;
    options.sharedModules = compilation.sharedModules;
    options.folder = compilation.folder;
    options.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    const bool lowered = rapid::lower::lowerProgram(*compilation.program, options, compilation.sink, out);
    rapid::lint::applyLevels(compilation.warningLevels, compilation.sink);
    if (!lowered || compilation.sink.hasErrors()) return false;
    if (out.instructionCount() < passesBelow)
        return runIrPasses(out, irPasses(compilation, stepping), compilation.sink);
    return reportFindings(ir::verifyTables(out), compilation.sink);
}

bool timesStatements(const Compilation& compilation) {
    return compilation.program && compilation.program->uses(sema::Trait::TimesStatements);
}

ir::PassOptions irPasses(const Compilation& compilation, bool stepping) {
    return {.profile = stepping ? ir::Profile::Stepping : ir::Profile::Release,
            .overflowChecks = compilation.overflowChecks};
}

bool runIrPasses(ir::Module& module, const ir::PassOptions& options, diag::Sink& sink) {
    return reportFindings(ir::runPasses(module, options), sink);
}

namespace {
/// A note about what a backup holds.
bool isReport(const diag::Diagnostic& diagnostic) {
    const auto code = static_cast<int>(diagnostic.code);
    return diagnostic.severity == diag::Severity::Note && code >= 6050 && code < 6070;
}
} // namespace

void printDiagnostics(const Compilation& compilation, bool withReport) {
    const bool colour = isatty(STDERR_FILENO) != 0;
    const auto sorted = compilation.sink.sorted();
    constexpr size_t kPiece = size_t{1} << 16; // stderr has no buffer
    std::string text;
    size_t warnings = 0;
    for (const diag::Diagnostic& diagnostic : sorted) {
        if (!withReport && isReport(diagnostic)) continue;
        warnings += diagnostic.severity == diag::Severity::Warning ? 1u : 0u;
        text += diag::renderText(diagnostic, colour);
        if (text.size() < kPiece) continue;
        fmt::print(stderr, "{}", text);
        text.clear();
    }
    fmt::print(stderr, "{}", text);
    const size_t errors = compilation.sink.errorCount();
    auto plural = [](size_t n, const char* word) {
        return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s");
    };
    if (errors > 0 && warnings > 0)
        fmt::print(stderr, "{} and {}\n", plural(errors, "error"), plural(warnings, "warning"));
    else if (errors > 0)
        fmt::print(stderr, "{}\n", plural(errors, "error"));
}

} // namespace rapidc
