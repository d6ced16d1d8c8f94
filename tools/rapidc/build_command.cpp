// rapidc build: a native executable that needs no rapidc.

#include "tools/rapidc/commands.h"
#include "tools/rapidc/pipeline.h"
#include "tools/rapidc/program_sources.h"

#include "codegen/codegen.h"
#include "runtime/host/run_options.h"

#include <CLI/CLI.hpp>
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
    for (const char* name : {"rapidc_host_main", "rapidc_runtime", "rapidc_motion", "rapidc_config"})
        options.libraries.push_back(path(name));
    (wholeLibrary ? options.wholeLibraries : options.libraries).push_back(path("rapidc_stdlib"));
    options.libraries.emplace_back(RAPIDC_BOOST_CONTEXT);
    options.stripDebug = strip;
    const std::string arguments = RAPIDC_LINK_ARGUMENTS;
    for (size_t at = 0; at < arguments.size();) {
        const size_t end = std::min(arguments.find(' ', at), arguments.size());
        options.extraArguments.push_back(arguments.substr(at, end - at));
        at = end + 1;
    }
    return options;
}

/// Removes the object file however the command ends.
struct TemporaryFile {
    std::string path;
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
};

/// Why the executable cannot be written there; "" when it can. Better known before the compiler has worked.
std::string outputProblem(const std::string& output) {
    std::error_code ignored;
    if (fs::is_directory(output, ignored)) return fmt::format("{} is a folder", output);
    const fs::path folder = fs::path(output).parent_path();
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) == 0) return {};
    return fmt::format("cannot write {}: {}", output, std::strerror(errno));
}

/// Modules may come, or references have to be checked, while the program runs.
bool needsSources(const ir::Module& module) {
    constexpr std::string_view kUsers[] = {"rt_Load", "rt_StartLoad", "rt_CheckProgRef", "rt_EraseModule"};
    return std::any_of(module.natives.begin(), module.natives.end(), [&](const ir::Native& native) {
        return std::find(std::begin(kUsers), std::end(kUsers), native.symbol) != std::end(kUsers);
    });
}

int build(BuildSettings& settings) {
    settings.inputs.requireMain = true;
    const auto compilation = checkInputs(settings.inputs);
    if (!compilation->usageErrors.empty()) {
        for (const std::string& problem : compilation->usageErrors)
            fmt::print(stderr, "rapidc build: {}\n", problem);
        return static_cast<int>(rt::ExitStatus::BadUsage);
    }
    if (settings.output.empty()) settings.output = fs::path(settings.inputs.paths[0]).stem().string();
    if (settings.output.empty()) settings.output = "a.out";
    if (const std::string problem = outputProblem(settings.output); !problem.empty()) {
        fmt::print(stderr, "rapidc build: {}; name the executable with -o FILE\n", problem);
        return static_cast<int>(rt::ExitStatus::BadUsage);
    }
    std::error_code ignored;
    compilation->folder = fs::current_path(ignored).string();
    ir::Module module;
    const bool lowered =
        !compilation->sink.hasErrors() &&
        lowerToIr(*compilation, fs::path(settings.output).filename().string(), settings.stepping, module);
    printDiagnostics(*compilation);
    if (!lowered) return static_cast<int>(rt::ExitStatus::BadProgram);
    const bool loads = needsSources(module);
    if (loads) module.sources = pack(*sourcesOf(*compilation, settings.stepping, !settings.noOptimise));
    const TemporaryFile object{fmt::format("{}.{}.o", settings.output, getpid())};
    codegen::CodegenOptions options;
    options.optimise = !settings.noOptimise;
    options.debugInfo = !settings.strip;
    std::string error;
    if (!codegen::emitObject(module, object.path, options, error) ||
        !codegen::linkExecutable(object.path, settings.output, linkOptions(settings.strip, loads), error)) {
        fmt::print(stderr, "rapidc build: {}\n", error);
        return static_cast<int>(rt::ExitStatus::BadProgram);
    }
    return 0;
}

} // namespace

void addBuildCommand(CLI::App& app, int& status) {
    auto settings = std::make_shared<BuildSettings>();
    CLI::App* command = app.add_subcommand("build", "Compile to a native executable");
    command->add_option("input", settings->inputs.paths, "Modules, folders, .pgf programs, backups")
        ->required();
    command->add_option("-o,--output", settings->output, "The executable to write");
    addAssumeSignalsOption(*command, settings->inputs);
    addWarningOption(*command, settings->inputs);
    command->add_option("--task", settings->inputs.tasks, "NAME[:TYPE]=INPUT: a further task")
        ->allow_extra_args(false);
    command->add_option("--config", settings->inputs.configFiles, "Parameters (.cfg) kept in the executable")
        ->allow_extra_args(false);
    command->add_flag("--no-optimise", settings->noOptimise, "Leave out the optimiser");
    command->add_flag("--stepping", settings->stepping,
                      "Compile for the stepping profile: the program can be stepped forward and backward");
    command->add_flag("--strip", settings->strip, "Leave out debug information");
    command->callback([settings, &status] { status = build(*settings); });
}

} // namespace rapidc
