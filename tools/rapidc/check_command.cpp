// rapidc check: diagnostics, and with --fix the edits that correct them.

#include "runtime/host/command_line.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/apply_fixes.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/missing_report.h"
#include "tools/rapidc/usage.h"

#include "frontend/project/neighbours.h"
#include "runtime/host/run_options.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace rapidc {

namespace {

struct CheckSettings {
    Inputs inputs;
    std::string format = "human";
    bool fix = false;
    bool missing = false; ///< only the table of what is missing
};

/// Corrects until nothing certain is left, or says that more is: a round corrects the mistakes that one check reports.
void fixFiles(const Inputs& inputs) {
    constexpr int kMaxRounds = 100;
    std::map<std::string, size_t> fixed;
    std::vector<std::string> problems;
    bool more = true;
    for (int round = 0; more && round < kMaxRounds; ++round) {
        const auto compilation = checkInputs(inputs);
        more = compilation->usageErrors.empty();
        if (!more) break;
        const FixOutcome outcome = applyCertainFixes(compilation->sink.sorted());
        for (const auto& [path, count] : outcome.fixed)
            fixed[path] += count;
        problems = outcome.problems;
        more = !outcome.fixed.empty();
    }
    for (const auto& [path, count] : fixed)
        fmt::print(stderr, "{}: {} {} fixed\n", path, count, count == 1 ? "mistake" : "mistakes");
    for (const std::string& problem : problems)
        fmt::print(stderr, "rapidc check: {}\n", problem);
    if (more)
        fmt::print(stderr, "rapidc check: --fix ends after {} rounds and more may be left: run it again\n",
                   kMaxRounds);
}

void printMissing(const Compilation& compilation, const Inputs& inputs, bool json) {
    std::error_code ignored;
    std::string root;
    if (inputs.paths.size() == 1 && std::filesystem::is_directory(inputs.paths[0], ignored))
        root = (std::filesystem::path(inputs.paths[0]) / "").string();
    fmt::print("{}", json ? missingJson(compilation) : missingTable(compilation, root));
    const size_t errors = compilation.sink.errorCount();
    if (errors > 0)
        fmt::print(stderr, "{} error{}: 'rapidc check' without --missing shows them\n", errors,
                   errors == 1 ? "" : "s");
}

int check(CheckSettings& settings) {
    if (settings.missing && settings.format == "sarif")
        return usageError("check", "--missing has the formats human and json");
    if (settings.missing) settings.inputs.onlyDiagnostics = false;
    if (settings.fix) fixFiles(settings.inputs);
    // Kept to the end of the process: taking a large program apart takes as long as parsing it.
    static std::unique_ptr<Compilation> kept;
    kept = checkInputs(settings.inputs);
    rapid::project::noteNeighbours(kept->sink, settings.inputs.paths);
    const Compilation* compilation = kept.get();
    if (!compilation->usageErrors.empty()) return usageErrors("check", compilation->usageErrors);
    const rapid::diag::Sink& sink = compilation->sink;
    if (settings.missing)
        printMissing(*compilation, settings.inputs, settings.format == "json");
    else if (settings.format == "json")
        fmt::print("{}", rapid::diag::renderJson(sink.sorted()));
    else if (settings.format == "sarif")
        fmt::print("{}", rapid::diag::renderSarif(sink.sorted(), std::filesystem::current_path().string()));
    else
        printDiagnostics(*compilation, true);
    return sink.hasErrors() ? 1 : 0;
}

} // namespace

void addCheckCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<CheckSettings>();
    const rt::Command command = line.addCommand("check", "Check RAPID modules and report every mistake",
                                                [settings] { return check(*settings); });
    addInputArgument(command, settings->inputs);
    addTaskOption(command, settings->inputs);
    addConfigOption(command, settings->inputs);
    addRobotOption(command, settings->inputs);
    settings->inputs.lint = true;
    settings->inputs.onlyDiagnostics = true;
    addAssumeSignalsOption(command, settings->inputs);
    addWarningOption(command, settings->inputs);
    command.add("--format", settings->format, "Format of the diagnostics").oneOf({"human", "json", "sarif"});
    command.addFlag("--missing", settings->missing,
                    "Print only a table of what is missing: built-ins, names, modules, "
                    "signals, options");
    command.addFlag("--fix", settings->fix,
                    "Change the files: apply each fix that is certain, then report what is left");
}

} // namespace rapidc
