// rapidc signals: the signals that a program uses, as an EIO.cfg to start a configuration from.

#include "runtime/host/command_line.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "config/atomic_file.h"
#include "runtime/host/run_options.h"

#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

struct SignalsSettings {
    Inputs inputs;
    std::string output;
};

int writeSignalFile(SignalsSettings& settings) {
    settings.inputs.assumeSignals = true;
    const auto compilation = checkInputs(settings.inputs);
    if (!compilation->usageErrors.empty()) return usageErrors("signals", compilation->usageErrors);
    const std::vector<rapid::workspace::UsedSignal>& signals = compilation->assumedSignals;
    for (const rapid::workspace::UsedSignal& signal : signals)
        if (!signal.contradiction.empty())
            fmt::print(stderr, "rapidc signals: signal '{}' is used as {} and as {}: written as {}\n",
                       signal.name, signal.type, signal.contradiction, signal.type);
    const std::string text = rapid::workspace::writeSignals(signals);
    if (settings.output.empty()) {
        fmt::print("{}", text);
    } else {
        rapid::config::OutputGuard guard;
        guard.writesConfiguration(settings.output, "-o");
        std::string problem = outputConflict(*compilation, {}, std::move(guard));
        if (problem.empty()) problem = rapid::config::replaceFile(settings.output, text);
        if (!problem.empty()) return usageError("signals", problem);
    }
    if (!compilation->sink.hasErrors()) return 0;
    const size_t errors = compilation->sink.errorCount();
    fmt::print(stderr,
               "rapidc signals: the program has {} error{}, so signals may be missing: see 'rapidc check'\n",
               errors, errors == 1 ? "" : "s");
    return 1;
}

} // namespace

void addSignalsCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<SignalsSettings>();
    const rt::Command command = line.addCommand(
        "signals", "Write an EIO.cfg with the signals that a program uses and no configuration defines",
        [settings] { return writeSignalFile(*settings); });
    addInputArgument(command, settings->inputs);
    command.add("-o,--output", settings->output, "The file to write; without it standard output");
    addTaskOption(command, settings->inputs);
    addConfigOption(command, settings->inputs);
}

} // namespace rapidc
