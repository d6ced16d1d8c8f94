#include "frontend/workspace/configuration.h"

#include "config/letter_case.h"
#include "config/text_util.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/project/system_parameters.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace rapid::workspace {

namespace fs = std::filesystem;
namespace say = diag::say;
using config::CfgAttribute;
using config::CfgFile;
using config::CfgInstance;
using config::CfgProblem;
using config::CfgSection;

namespace {

SourceRange lineRange(const SourceFile& file, uint32_t line) {
    if (line == 0 || line > file.lineCount()) return {};
    const uint32_t start = file.lineStart(line);
    const std::string_view text = file.lineText(line);
    const size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {start, start};
    const size_t last = text.find_last_not_of(" \t");
    return {start + static_cast<uint32_t>(first), start + static_cast<uint32_t>(last + 1)};
}

/// Reports problems of the file `name` with the content `text`.
void reportConfigurationProblems(diag::Sink& sink, const std::string& name, const std::string& text,
                                 std::span<const CfgProblem> problems) {
    std::shared_ptr<const SourceFile> file;
    for (const CfgProblem& problem : problems) {
        if (problem.file != name) continue;
        if (!file) file = std::make_shared<const SourceFile>(name, text);
        sink.report(problem.warning ? say::ConfigurationDoubt : say::ConfigurationProblem, file,
                    lineRange(*file, problem.line), {problem.message});
    }
}

/// A text without any system parameters: programs of other kinds have files called .cfg, too.
bool isForeign(Compilation& compilation, const std::string& path, const std::string& text,
               const CfgFile& cfg) {
    if (!cfg.domain.empty()) return false;
    compilation.sink.report(say::ForeignConfiguration, std::make_shared<SourceFile>(path, text), {},
                            {fs::path(path).filename().string()});
    return true;
}

} // namespace

void readConfiguration(Compilation& compilation, const Environment& environment, const Inputs& inputs,
                       const std::vector<std::string>& files, bool withSignals) {
    sema::CheckOptions& options = compilation.options;
    std::vector<CfgProblem> problems;
    for (size_t i = 0; i < files.size(); ++i) {
        const std::string& path = files[i];
        std::string bytes;
        compilation.filesRead.push_back(path);
        if (const std::string problem = project::readText(inputs.texts, path, bytes); !problem.empty()) {
            compilation.usageErrors.push_back(
                fmt::format("cannot read the configuration file '{}': {}", path, problem));
            continue;
        }
        std::vector<CfgProblem> found;
        const CfgFile cfg = config::parseCfg(bytes, path, found);
        if (i >= inputs.configFiles.size() && isForeign(compilation, path, bytes, cfg)) continue;
        problems.insert(problems.end(), found.begin(), found.end());
        compilation.configNames.push_back(path);
        compilation.configTexts.push_back(bytes);
        if (config::upperCase(cfg.domain) == "MOC")
            for (const char* type : {"ROBOT", "MECHANICAL_UNIT"})
                for (const CfgSection* section : cfg.find(type))
                    for (const CfgInstance& unit : section->instances)
                        options.signals.push_back({unit.text("name"), "mecunit"});
        if (config::upperCase(cfg.domain) != "EIO") continue;
        options.configurationKnown = true;
        for (const CfgSection* section : cfg.find("EIO_SIGNAL"))
            for (const CfgInstance& signal : section->instances) {
                options.signals.push_back(
                    {signal.text("Name"), "signal" + config::lowerCase(signal.text("SignalType"))});
            }
    }
    if (withSignals) environment.judgeSignals(problems, compilation.configNames, compilation.configTexts);
    config::limitProblems(problems);
    for (size_t i = 0; i < compilation.configNames.size() && !problems.empty(); ++i)
        reportConfigurationProblems(compilation.sink, compilation.configNames[i], compilation.configTexts[i],
                                    problems);
}

void addConveyors(Compilation& compilation, const Environment& environment,
                  const std::vector<std::string>& conveyors) {
    std::vector<sema::SignalInfo>& known = compilation.options.signals;
    std::vector<std::string> units;
    for (const sema::SignalInfo& unit : known)
        if (unit.type == "mecunit" && environment.isConveyor(unit.name)) units.push_back(unit.name);
    units.insert(units.end(), conveyors.begin(), conveyors.end());
    for (const std::string& unit : units) {
        const ConveyorNames names = environment.conveyor(unit);
        if (!names.problem.empty()) {
            compilation.usageErrors.push_back(fmt::format("--conveyor={}: {}", unit, names.problem));
            continue;
        }
        const auto add = [&known](const std::string& name, const std::string& type) {
            const auto same = [&](const sema::SignalInfo& other) {
                return config::sameName(other.name, name);
            };
            if (std::none_of(known.begin(), known.end(), same)) known.push_back({name, type});
        };
        add(names.unit, "mecunit");
        for (const auto& [name, type] : names.signals)
            add(name, type);
    }
}

void readTaskSettings(Compilation& compilation) {
    for (size_t i = 0; i < compilation.configTexts.size(); ++i) {
        std::vector<CfgProblem> ignored;
        const CfgFile cfg = config::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        for (const CfgSection* section : cfg.find("SYSSIG_IN"))
            for (const CfgInstance& input : section->instances)
                if (config::sameName(input.text("Action"), "Interrupt"))
                    compilation.eventRoutines.insert(config::lowerCase(input.text("Arg1")));
        if (config::upperCase(cfg.domain) != "SYS") continue;
        for (const CfgSection* section : cfg.find("CAB_EXEC_HOOKS"))
            for (const CfgInstance& hook : section->instances)
                compilation.eventRoutines.insert(config::lowerCase(hook.text("Routine")));
        for (const project::ConfiguredModule& module :
             project::readTaskParameters(compilation.configTexts[i]).modules)
            if (module.shared) compilation.options.sharedModules.insert(config::lowerCase(module.name));
    }
}

void configureTasks(Compilation& compilation, const std::set<std::string>& typesGiven, bool isBackup) {
    for (const std::string& text : compilation.configTexts) {
        for (const project::ConfiguredTask& configured : project::readTaskParameters(text).tasks) {
            for (sema::TaskInput& task : compilation.tasks) {
                if (!config::sameName(task.name, configured.name)) continue;
                task.bindsLate = !configured.bindsReferences;
                if (isBackup) continue;
                task.entry = configured.entry;
                if (!typesGiven.contains(task.name)) task.type = configured.type;
            }
        }
    }
}

void configureRobot(Compilation& compilation, const std::string& option) {
    if (option.empty()) return;
    compilation.configNames.emplace_back("backinfo.txt");
    compilation.configTexts.push_back(fmt::format(
        "MOC:CFG_1.0:7:0::\n#\nROBOT:\n\n      -name \"ROB_1\" -use_robot_type \"{}\"\n", option));
}

void checkRobot(Compilation& compilation, const Environment& environment, const std::string& option) {
    std::string robot = option;
    for (size_t i = 0; i < compilation.configTexts.size() && robot.empty(); ++i) {
        std::vector<CfgProblem> ignored;
        const CfgFile cfg = config::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        if (cfg.domain != "MOC") continue;
        for (const CfgSection* section : cfg.find("ROBOT"))
            for (const CfgInstance& instance : section->instances)
                if (robot.empty()) robot = instance.text("use_robot_type");
    }
    if (robot.empty()) return;
    if (!environment.robotProblem(robot).empty())
        compilation.sink.report(
            say::RobotUnknown, nullptr, {},
            {robot, "a model like it takes its place when there is one; --robot names another one"});
}

std::set<std::string> namedByConfiguration(const Compilation& compilation) {
    std::set<std::string> names;
    for (size_t i = 0; i < compilation.configTexts.size(); ++i) {
        std::vector<CfgProblem> ignored;
        const CfgFile cfg = config::parseCfg(compilation.configTexts[i], compilation.configNames[i], ignored);
        for (const CfgSection& section : cfg.sections)
            for (const CfgInstance& instance : section.instances)
                for (const CfgAttribute& attribute : instance.attributes)
                    for (const std::string& value : attribute.values)
                        names.insert(config::lowerCase(value));
    }
    return names;
}

} // namespace rapid::workspace
