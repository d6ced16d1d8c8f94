#include "frontend/workspace/compilation.h"

#include "config/letter_case.h"
#include "config/text_util.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/project/settings.h"
#include "frontend/workspace/configuration.h"
#include "frontend/workspace/judge.h"
#include "frontend/workspace/task_specs.h"

#include <algorithm>

namespace rapid::workspace {

namespace {

/// The modules that are one for all tasks: those of SYS.cfg, and what a backup holds for all of them.
void findSharedModules(Compilation& compilation) {
    compilation.sharedModules = compilation.options.sharedModules;
    for (const auto& task : compilation.program->tasks)
        for (const sema::Module* module : task->modules)
            if (std::find(compilation.sharedFiles.begin(), compilation.sharedFiles.end(),
                          module->tree->source->path()) != compilation.sharedFiles.end())
                compilation.sharedModules.insert(config::lowerCase(module->name));
}

/// The warnings that are wanted: by the project file beside or above `first`, the first input, then by the command line.
void readWarningLevels(const Inputs& inputs, const std::string& first, Compilation& compilation) {
    lint::WarningLevels& levels = compilation.warningLevels;
    if (!first.empty()) {
        compilation.filesRead.push_back(project::findSettings(first));
        lint::applySettings(project::loadSettings(first, compilation.sink, inputs.texts), levels,
                            compilation.sink);
    }
    if (!inputs.lint) levels.set("lint", lint::Level::Off);
    for (const std::string& option : inputs.warnings) {
        std::string problem;
        if (!lint::applyOption(option, levels, problem))
            compilation.usageErrors.push_back(std::move(problem));
    }
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
        compilation.options.signals.push_back({signal.name, "signal" + config::lowerCase(signal.type)});
}

/// Checks all tasks and looks at each file as soon as it is checked.
void check(Compilation& compilation, const Environment& environment, bool onlyDiagnostics) {
    Judge judge(compilation, environment, compilation.sink);
    sema::CheckOptions options = compilation.options;
    options.onlyDiagnostics = onlyDiagnostics;
    options.onFile = [&](const sema::CheckedProgram& program, const sema::Task& task,
                         std::span<sema::Module* const> modules) { judge.file(program, task, modules); };
    compilation.program = sema::check(compilation.tasks, options, compilation.sink);
    judge.finish(*compilation.program, compilation.tasks);
}

std::string firstInput(const Inputs& inputs, const std::vector<project::TaskSpec>& specs) {
    if (!inputs.paths.empty()) return inputs.paths.front();
    for (const project::TaskSpec& spec : specs)
        if (!spec.inputs.empty()) return spec.inputs.front();
    return {};
}

} // namespace

std::unique_ptr<Compilation> loadInputs(const Inputs& inputs, const Environment& environment) {
    auto compilation = std::make_unique<Compilation>();
    std::set<std::string> typesGiven{"T_ROB1"};
    const std::vector<project::TaskSpec> specs =
        readTaskSpecs(inputs.tasks, typesGiven, compilation->usageErrors);
    for (const std::string& robot : inputs.robots)
        if (const std::string problem = environment.robotProblem(robot.substr(robot.find('=') + 1));
            !problem.empty())
            compilation->usageErrors.push_back("--robot: " + problem);
    readWarningLevels(inputs, firstInput(inputs, specs), *compilation);
    if (!compilation->usageErrors.empty()) return compilation;
    project::ProjectInput input;
    input.chosenHome = inputs.home;
    if (!inputs.paths.empty() || !specs.empty())
        project::loadProject(inputs.paths, specs, input, compilation->sink, inputs.texts);
    std::vector<std::string> configFiles = inputs.configFiles;
    for (const std::string& found : input.configFiles)
        if (std::find(configFiles.begin(), configFiles.end(), found) == configFiles.end())
            configFiles.push_back(found);
    sema::CheckOptions& options = compilation->options;
    options.requireMain = inputs.requireMain;
    options.robotWareOptions = input.robotWareOptions;
    compilation->homeFolder = input.homeFolder;
    compilation->filesRead.insert(compilation->filesRead.end(), input.filesRead.begin(),
                                  input.filesRead.end());
    options.assumeSignals = inputs.assumeSignals;
    readConfiguration(*compilation, environment, inputs, configFiles,
                      inputs.onlyDiagnostics); // else the controller judges signals
    addConveyors(*compilation, environment, inputs.conveyors);
    for (const std::string& camera : inputs.cameras)
        options.signals.push_back({camera.substr(0, camera.find('=')), "cameradev"});
    if (input.isBackup) configureRobot(*compilation, input.robot);
    if (input.isBackup && !inputs.requireMain) checkRobot(*compilation, environment, input.robot);
    compilation->library = environment.library(inputs.documented);
    options.library = compilation->library;
    compilation->tasks = std::move(input.tasks);
    configureTasks(*compilation, typesGiven, input.isBackup);
    readTaskSettings(*compilation);
    if (inputs.adjust) inputs.adjust(compilation->tasks);
    compilation->sharedFiles = std::move(input.sharedFiles);
    compilation->loaded = true;
    return compilation;
}

std::unique_ptr<Compilation> checkInputs(const Inputs& inputs, const Environment& environment) {
    auto compilation = loadInputs(inputs, environment);
    if (!compilation->loaded) return compilation;
    check(*compilation, environment, inputs.onlyDiagnostics);
    if (inputs.assumeSignals) assumeSignals(*compilation);
    findSharedModules(*compilation);
    return compilation;
}

} // namespace rapid::workspace
