// rapidc run: compiles in memory and runs on the virtual controller.

#include "runtime/host/command_line.h"
#include "tools/program/loaded_program.h"
#include "tools/program/pipeline.h"
#include "tools/program/run_setup.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/line_debugger.h"
#include "tools/rapidc/usage.h"

#include "config/temporary.h"
#include "runtime/host/controller.h"
#include "runtime/host/run_files.h"
#include "runtime/host/run_options.h"
#include "runtime/host/stop_signals.h"
#include "runtime/sim/stimulus.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc {

namespace {

namespace fs = std::filesystem;

struct RunSettings {
    Inputs inputs;
    rt::RunOptions options;
    bool noOptimise = false;
    bool stepping = false;    ///< compile for the stepping profile
    bool noStepping = false;  ///< not even for --state
    bool interactive = false; ///< --step
    bool interpreted = false; ///< execute every routine by the interpreter, as huge ones
    bool inParts = false;     ///< compile each routine when it is called, as in large programs
};

/// Only programs made for the stepping profile can be stepped.
bool stimulusSteps(const rt::RunOptions& options) {
    if (!options.stimulusText) return false;
    std::vector<rt::StimulusProblem> problems; // reported when the controller reads it
    for (const rt::StimulusItem& item : rt::parseStimulus(*options.stimulusText, problems))
        if (item.kind == rt::StimulusKind::StepForward || item.kind == rt::StimulusKind::StepBackward)
            return true;
    return false;
}

void makeFolders(const RunSettings& settings) {
    for (const std::string* path : {&settings.options.outputs.trace, &settings.options.outputs.signals,
                                    &settings.options.outputs.events, &settings.options.outputs.errors,
                                    &settings.options.outputs.picture, &settings.options.outputs.report}) {
        std::error_code ignored;
        const fs::path folder = fs::path(*path).parent_path();
        if (!folder.empty()) fs::create_directories(folder, ignored);
    }
}

/// Why the files of the run cannot be written without loss; "" when they can.
std::string conflictOf(const RunSettings& settings, const Compilation& compilation) {
    rapid::config::OutputGuard guard;
    rt::guardOutputs(settings.options, guard);
    return outputConflict(compilation, {}, std::move(guard));
}

int execute(RunSettings& settings, const LoadedProgram& program) {
    const rt::StopSignals signals;
    rt::ExitStatus status = rt::ExitStatus::Ended;
    {
        rt::Controller controller(settings.options);
        program.equip(controller);
        status = controller.prepare(program.description());
        if (status != rt::ExitStatus::Ended) return static_cast<int>(status);
        LineDebugger debugger(controller, program.compilation());
        if (settings.interactive) debugger.attach();
        status = controller.run();
        std::fflush(stdout);
    }
    rt::StopSignals::endIfReceived();
    return static_cast<int>(status);
}

int run(RunSettings& settings) {
    Inputs& inputs = settings.inputs;
    takeOptions(inputs, settings.options);
    inputs.requireMain = true;
    auto compilation = checkInputs(inputs);
    if (!compilation->usageErrors.empty()) return usageErrors("run", compilation->usageErrors);
    findStimulus(settings.options, inputs.paths);
    std::string error = conflictOf(settings, *compilation);
    if (!error.empty() || !readStimulus(settings.options, error)) return usageError("run", error);
    rapid::config::removeLeftoversBeside(compilation->filesRead);
    // A later process can continue in the middle of a program of the stepping profile only.
    settings.stepping = settings.stepping || settings.interactive || stimulusSteps(settings.options) ||
                        timesStatements(*compilation) ||
                        (!settings.options.state.empty() && !settings.noStepping);
    compilation->callsByName = settings.interactive;
    const std::string home = compilation->homeFolder;
    LoadedProgram program(std::move(compilation));
    const bool compiled = program.compile({.name = nameOfProgram(settings.inputs),
                                           .stepping = settings.stepping,
                                           .optimise = !settings.noOptimise,
                                           .inParts = settings.inParts,
                                           .startsAtOnce = !settings.options.realtime,
                                           .interpreted = settings.interpreted,
                                           .executedOnce = settings.options.cycles == 1 && !settings.stepping,
                                           .keepsProgram = settings.interactive},
                                          error);
    printDiagnostics(program.compilation());
    if (!compiled) {
        if (!error.empty()) fmt::print(stderr, "rapidc run: {}\n", error);
        return static_cast<int>(rt::ExitStatus::BadProgram);
    }
    // The configuration is in the program already; reading it twice would define every signal twice.
    settings.options.configFiles.clear();
    rapid::config::TemporaryFolder folder;
    if (settings.options.home.empty() && !home.empty()) {
        settings.options.home = copyHome(home, folder, error);
        if (settings.options.home.empty()) return usageError("run", error);
    }
    makeFolders(settings);
    return execute(settings, program);
}

} // namespace

void addRunCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<RunSettings>();
    const rt::Command command = line.addCommand("run", "Compile in memory and run on the virtual controller",
                                                [settings] { return run(*settings); });
    addInputArgument(command, settings->inputs);
    rt::addRunOptions(command, settings->options, true);
    addAssumeSignalsOption(command, settings->inputs);
    addWarningOption(command, settings->inputs);
    command.addFlag("--step", settings->interactive,
                    "Debug in the terminal: stop before the first instruction and take commands (help)");
    const rt::Option stepping =
        command.addFlag("--stepping", settings->stepping, "Compile for the stepping profile");
    command
        .addFlag("--no-stepping", settings->noStepping,
                 "With --state: fast code, but a program that is interrupted begins at main in the next run")
        .excludes(stepping);
    command.addFlag("--no-optimise", settings->noOptimise, "Leave out the optimiser");
    command.addFlag("--interpreted", settings->interpreted, "Interpret every routine, as huge ones are")
        .hide(); // for tests
    command
        .addFlag("--in-parts", settings->inParts,
                 "Compile each routine when it is called first, even in a small program")
        .hide(); // for tests
}

} // namespace rapidc
