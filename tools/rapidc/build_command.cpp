// rapidc build: a native executable that needs no rapidc.

#include "runtime/host/command_line.h"
#include "tools/program/drop_program.h"
#include "tools/program/native_library.h"
#include "tools/program/pipeline.h"
#include "tools/program/program_sources.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "config/temporary.h"
#include "runtime/host/run_options.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace rapidc {

namespace {

namespace fs = std::filesystem;

struct BuildSettings {
    Inputs inputs;
    std::string output;
    bool noOptimise = false;
    bool strip = false;
    bool stepping = false;
    bool withoutOverflowChecks = false;
    bool noCache = false;
    bool inParts = false; ///< as large programs are compiled
};

fs::path ownFolder() {
    std::error_code ignored;
    const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
    return self.parent_path();
}

/// A program that loads modules must hold all that they may use.
codegen::LinkOptions linkOptions(bool strip, bool wholeLibrary) {
    codegen::LinkOptions options;
    const auto path = [](const char* name) {
        return (ownFolder() / "lib" / fmt::format("lib{}.a", name)).string();
    };
    for (const char* name :
         {"rapidc_host_main", "rapidc_runtime", "rapidc_motion", "rapidc_config", "rapidc_fmt"})
        options.libraries.push_back(path(name));
    (wholeLibrary ? options.wholeLibraries : options.libraries).push_back(path("rapidc_stdlib"));
    options.libraries.emplace_back(RAPIDC_BOOST_CONTEXT);
    options.libraries.emplace_back(RAPIDC_PROTOBUF);
    options.stripDebug = strip;
    const std::string arguments = RAPIDC_LINK_ARGUMENTS;
    for (size_t at = 0; at < arguments.size();) {
        const size_t end = std::min(arguments.find(' ', at), arguments.size());
        options.extraArguments.push_back(arguments.substr(at, end - at));
        at = end + 1;
    }
    return options;
}

/// Why the executable cannot be written there; "" when it can. Better known before the compiler has worked.
std::string outputProblem(const std::string& output) {
    std::error_code ignored;
    if (fs::is_directory(output, ignored)) return fmt::format("{} is a folder", output);
    if (fs::exists(output, ignored) && !fs::is_regular_file(output, ignored))
        return fmt::format("{} is a device or a pipe", output);
    const fs::path folder = fs::path(output).parent_path();
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) == 0) return {};
    return fmt::format("cannot write {}: {}", output, std::strerror(errno));
}

/// --robot and --conveyor become those of the executable; its own options come first.
void keepOptions(Compilation& compilation, const std::string& option,
                 const std::vector<std::string>& values) {
    if (values.empty()) return;
    std::string text = "RAPIDC:CFG_1.0:7:0::\n#\nOPTIONS:\n";
    for (const std::string& value : values)
        text += fmt::format("\n      -{} \"{}\"\n", option, value);
    compilation.configNames.push_back("--" + option);
    compilation.configTexts.push_back(std::move(text));
}

/// Object file and executable are made in a folder beside the output, which is replaced in one step: whatever goes
/// wrong, the old one is whole.
bool makeExecutable(const BuildSettings& settings, const codegen::CodegenOptions& options,
                    const ir::Module& module, bool wholeLibrary, std::string& error) {
    std::error_code missing;
    const fs::path real = fs::canonical(settings.output, missing); // a link stays a link
    const fs::path output = missing ? fs::path(settings.output) : real;
    rapid::config::removeLeftoversBeside({output.string()});
    rapid::config::TemporaryFolder folder;
    if (const int problem = folder.makeBeside(output.parent_path(), output.filename().string());
        problem != 0) {
        error = fmt::format("cannot write {}: {}", settings.output, std::strerror(problem));
        return false;
    }
    const std::string executable = (fs::path(folder.path()) / "program").string();
    const auto compileAndLink = [&](const codegen::CodegenOptions& how) {
        std::vector<std::string> objects;
        error.clear();
        return codegen::emitObjects(module, folder.path(), how, objects, error) &&
               codegen::linkExecutable(objects, executable, linkOptions(settings.strip, wholeLibrary), error);
    };
    if (!compileAndLink(options)) {
        if (!error.starts_with(codegen::kLinkingFailed) || options.cacheFolder.empty() ||
            module.instructionCount() <= options.partsAbove)
            return false;
        codegen::CodegenOptions again = options; // an object of the cache may be damaged
        again.trustCache = false;
        again.prepare = {}; // has been done
        if (!compileAndLink(again)) return false;
    }
    std::error_code problem;
    fs::rename(executable, output, problem);
    if (problem) error = fmt::format("cannot write {}: {}", settings.output, problem.message());
    return !problem;
}

int build(BuildSettings& settings) {
    settings.inputs.requireMain = true;
    const auto compilation = checkInputs(settings.inputs);
    if (!compilation->usageErrors.empty()) return usageErrors("build", compilation->usageErrors);
    if (settings.output.empty()) settings.output = nameOfProgram(settings.inputs);
    if (settings.output.empty()) settings.output = "a.out";
    if (const std::string problem = outputProblem(settings.output); !problem.empty())
        return usageError("build", problem + "; name the executable with -o FILE");
    if (const std::string conflict = outputConflict(*compilation, {{"-o", settings.output}});
        !conflict.empty())
        return usageError("build", conflict);
    keepOptions(*compilation, "robot", settings.inputs.robots);
    keepOptions(*compilation, "conveyor", settings.inputs.conveyors);
    std::error_code ignored;
    compilation->folder = fs::current_path(ignored).string();
    compilation->overflowChecks = !settings.withoutOverflowChecks;
    ir::Module module;
    codegen::CodegenOptions options = codegenOptions(!settings.noOptimise);
    options.debugInfo = !settings.strip;
    options.cacheFolder = settings.noCache ? "" : cacheFolder();
    if (settings.inParts) options.partsAbove = 0;
    settings.stepping = settings.stepping || timesStatements(*compilation);
    const bool lowered = !compilation->sink.hasErrors() &&
                         lowerToIr(*compilation, fs::path(settings.output).filename().string(),
                                   settings.stepping, module, options.partsAbove + 1);
    printDiagnostics(*compilation);
    if (!lowered) return static_cast<int>(rt::ExitStatus::BadProgram);
    const bool loads = compilation->program->uses(rapid::sema::Trait::NeedsSources);
    if (loads) module.sources = pack(*sourcesOf(*compilation, settings.stepping, !settings.noOptimise));
    dropProgram(*compilation);
    runPassesInParts(options, module, irPasses(*compilation, settings.stepping));
    std::string error;
    if (!makeExecutable(settings, options, module, loads, error)) {
        fmt::print(stderr, "rapidc build: {}\n", error);
        return static_cast<int>(rt::ExitStatus::BadProgram);
    }
    return 0;
}

} // namespace

void addBuildCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<BuildSettings>();
    const rt::Command command =
        line.addCommand("build", "Compile to a native executable", [settings] { return build(*settings); });
    addInputArgument(command, settings->inputs);
    command.add("-o,--output", settings->output, "The executable to write");
    addAssumeSignalsOption(command, settings->inputs);
    addWarningOption(command, settings->inputs);
    addTaskOption(command, settings->inputs);
    addConfigOption(command, settings->inputs);
    addRobotOption(command, settings->inputs);
    command.addFlag("--no-optimise", settings->noOptimise, "Leave out the optimiser");
    command.addFlag("--stepping", settings->stepping,
                    "Compile for the stepping profile: the program can be stepped forward and backward");
    command.addFlag("--strip", settings->strip, "Leave out debug information");
    command.addFlag("--no-cache", settings->noCache,
                    "Compile every module of a large program again, and keep nothing in the cache");
    command.addFlag("--in-parts", settings->inParts, "Compile each module by itself, even in a small program")
        .hide(); // for tests
    command
        .addFlag("--without-overflow-checks", settings->withoutOverflowChecks,
                 "For benchmarks only: results out of range go unnoticed")
        .hide(); // not in the help
}

} // namespace rapidc
