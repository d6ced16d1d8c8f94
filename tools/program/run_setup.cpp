#include "tools/program/run_setup.h"

#include "config/read_file.h"

#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc {

namespace fs = std::filesystem;

void takeOptions(rapid::workspace::Inputs& inputs, const rt::RunOptions& options) {
    inputs.tasks = options.tasks;
    inputs.configFiles = options.configFiles;
    inputs.robots = options.robots;
    inputs.conveyors = options.conveyors;
    inputs.cameras = options.cameras;
    inputs.home = options.home;
}

void findStimulus(rt::RunOptions& options, const std::vector<std::string>& inputs) {
    if (!options.stimulus.empty() || inputs.size() != 1) return;
    const fs::path beside = fs::path(inputs[0]) / "stimulus.csv";
    std::error_code ignored;
    if (fs::is_regular_file(beside, ignored)) options.stimulus = beside.string();
}

std::string copyHome(const std::string& from, rapid::config::TemporaryFolder& folder, std::string& error) {
    if (const int problem = folder.make("home"); problem != 0) {
        error = fmt::format("cannot make a folder for HOME: {}", std::strerror(problem));
        return {};
    }
    std::error_code code;
    fs::copy(from, folder.path(), fs::copy_options::recursive | fs::copy_options::skip_symlinks, code);
    if (code) error = fmt::format("cannot copy '{}': {}", from, code.message());
    return code ? std::string() : folder.path();
}

bool readStimulus(rt::RunOptions& options, std::string& error) {
    if (options.stimulus.empty()) return true;
    const std::string problem = rapid::config::readStream(options.stimulus, options.stimulusText.emplace());
    if (!problem.empty())
        error = fmt::format("--stimulus: '{}' cannot be read: {}", options.stimulus, problem);
    return problem.empty();
}

} // namespace rapidc
