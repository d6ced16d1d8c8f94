#include "runtime/host/run_files.h"

namespace rt {

void guardOutputs(const RunOptions& options, rapid::config::OutputGuard& guard) {
    for (const std::string& path : options.configFiles)
        guard.reads(path, "the configuration");
    if (options.stimulus != "-") guard.reads(options.stimulus, "the stimulus");
    for (const std::string& robot : options.robots)
        if (const std::string model = robot.substr(robot.find('=') + 1); model.ends_with(".json"))
            guard.reads(model, "the robot model");
    guard.reads(options.outputs.compare, "the recording");
    guard.writes(options.outputs.trace, "--trace");
    guard.writes(options.outputs.signals, "--signals");
    guard.writes(options.outputs.events, "--events");
    guard.writes(options.outputs.errors, "--errors");
    guard.writes(options.outputs.picture, "--picture");
    guard.writes(options.outputs.report, "--report");
    if (options.state.empty()) return;
    for (const char* name : {kStateFile, kStateAside, kStateLock})
        guard.writes(options.state + "/" + name, "--state");
}

} // namespace rt
