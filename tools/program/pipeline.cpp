#include "tools/program/pipeline.h"

#include "frontend/diag/messages/internal.h"
#include "frontend/lint/warnings.h"
#include "ir/lower/lower.h"
#include "ir/verify/verify.h"
#include "runtime/host/command_line.h"
#include "stdlib/native_table.h"
#include "tools/program/constant_calls.h"
#include "tools/program/controller_environment.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace rapidc {

namespace sema = rapid::sema;
namespace diag = rapid::diag;

void addInputArgument(const rt::Command& command, Inputs& inputs) {
    command.add("input", inputs.paths, "Modules, folders, .pgf programs, backups");
    command.requireOneOf("input", "--task");
}

std::string nameOfProgram(const Inputs& inputs) {
    if (!inputs.paths.empty()) return std::filesystem::path(inputs.paths.front()).stem().string();
    return inputs.tasks.empty() ? ""
                                : inputs.tasks.front().substr(0, inputs.tasks.front().find_first_of(":="));
}

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
             "type; repeatable; also adds inputs to a task")
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
    return rapid::workspace::checkInputs(inputs, controllerEnvironment());
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
               size_t passesBelow, const std::function<bool(const sema::RoutineSymbol&)>& calledFromOutside) {
    rapid::lower::Options options;
    options.calledFromOutside = calledFromOutside;
    options.programName = name;
    options.stepping = stepping;
    options.callsByName = compilation.callsByName;
    options.keepsPredefined = compilation.keepsPredefined;
    options.configNames = compilation.configNames;
    options.configTexts = compilation.configTexts;
    options.eventRoutines = compilation.eventRoutines;
    options.sharedModules = compilation.sharedModules;
    options.folder = compilation.folder;
    options.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    options.evaluate = constantCalls();
    const bool lowered = rapid::lower::lowerProgram(*compilation.program, options, compilation.sink, out);
    rapid::lint::applyLevels(compilation.warningLevels, compilation.sink);
    if (!lowered || compilation.sink.hasErrors()) return false;
    if (!stepping) ir::foldParameters(out);
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
