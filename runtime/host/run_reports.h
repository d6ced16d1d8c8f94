#pragma once
// RunReports: what a run is followed by for people: report, picture of the path, comparison, summary.

#include "runtime/host/run_options.h"
#include "runtime/report/page_data.h"
#include "runtime/report/run_recorder.h"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace rt {

class Controller;
struct ProgramDesc;

class RunReports {
  public:
    explicit RunReports(const RunOptions& options) : options_(options) {}

    /// Something of it was asked for.
    static bool areWanted(const RunOptions& options);
    /// Reads the recording, sees that the files can be written, and records from now on. The robot and the signals are there
    /// already. Returns what is wrong, with the option; empty: success.
    [[nodiscard]] std::string prepare(Controller& controller, const ProgramDesc& program);
    /// Writes the files and, on stderr, what was asked for. False when a file could not be written, which is reported.
    bool finish(Time end);

  private:
    void listen(Controller& controller);
    void addRobots(Controller& controller);
    std::string writeFiles(const std::vector<report::RobotReport>& robots) const;
    void printSummary(const std::vector<report::RobotReport>& robots) const;

    const RunOptions& options_;
    std::unique_ptr<report::RunRecorder> recorder_;
    std::vector<report::Recording> recordings_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace rt
