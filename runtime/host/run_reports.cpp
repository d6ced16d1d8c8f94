#include "runtime/host/run_reports.h"

#include "runtime/base/output_file.h"
#include "runtime/host/controller.h"
#include "runtime/report/page.h"
#include "runtime/report/path_picture.h"
#include "runtime/report/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace rt {
namespace {

constexpr std::size_t kMostMarkers = 20'000; // on the page

/// Stations that are never active together share axes, which have one curve then.
void addAxis(report::RobotRecord& robot, const MechanicalUnit::Axis& axis) {
    for (report::ExternalAxis& known : robot.external) {
        if (known.index != axis.index) continue;
        known.name += " / " + axis.single;
        return;
    }
    robot.external.push_back(
        {axis.single, axis.index, axis.limits.rotating, axis.limits.maxSpeed, axis.limits.maxAcceleration});
}

} // namespace

bool RunReports::areWanted(const RunOptions& options) {
    return options.outputs.summary || !options.outputs.report.empty() || !options.outputs.compare.empty() ||
           !options.outputs.picture.empty();
}

std::string RunReports::prepare(Controller& controller, const ProgramDesc& program) {
    if (!options_.outputs.compare.empty()) {
        if (const std::string problem = report::readRecording(options_.outputs.compare, recordings_);
            !problem.empty())
            return "--compare: " + problem;
    }
    recorder_ = std::make_unique<report::RunRecorder>(program.name);
    recorder_->setFolder(program.folder != nullptr ? program.folder : "");
    addRobots(controller);
    if (const std::string problem = writeFiles(report::robotReports(recorder_->record(), {}));
        !problem.empty())
        return problem;
    listen(controller);
    return {};
}

/// Every motion group with its external axes.
void RunReports::addRobots(Controller& controller) {
    for (const auto& motion : controller.motions()) {
        report::RobotRecord robot;
        robot.unit = motion->unitName();
        robot.robot = motion->model();
        robot.hasArm = !robot.unit.empty();
        for (const auto& unit : controller.units().all()) {
            if (unit->group != motion->group() || unit->own.empty()) continue;
            if (robot.unit.empty()) robot.unit = unit->name;
            for (const MechanicalUnit::Axis& axis : unit->own)
                addAxis(robot, axis);
        }
        motion->addTrace(recorder_->addRobot(std::move(robot)));
    }
}

void RunReports::listen(Controller& controller) {
    IoSystem& io = controller.io();
    for (std::size_t i = 0; i < io.size(); ++i) {
        const auto id = static_cast<SignalId>(i);
        recorder_->addSignal(io.config(id).name, signalTypeName(io.config(id).type), io.value(id));
    }
    Scheduler& clock = controller.scheduler();
    report::RunRecorder& recorder = *recorder_;
    io.addListener(-1, [&recorder, &clock](SignalId id, double, double value) {
        recorder.signalChanged(static_cast<std::size_t>(id), clock.now(), value);
    });
    const auto add = [&recorder](report::Marker marker) {
        if (recorder.record().markers.size() < kMostMarkers) recorder.add(std::move(marker));
    };
    controller.log().addListener([add](const Event& event) {
        std::string text = event.text;
        if (event.place.line != 0) text += fmt::format(" ({})", event.place.reference());
        add({toSeconds(event.time), typeName(event.type), event.number, event.title, std::move(text)});
    });
    controller.panel().onLine([add, &clock](std::string_view line) {
        add({toSeconds(clock.now()), "line", 0, {}, std::string(line)});
    });
}

/// Returns the problem, with the option; empty: success.
std::string RunReports::writeFiles(const std::vector<report::RobotReport>& robots) const {
    const report::RunRecord& record = recorder_->record();
    if (!options_.outputs.picture.empty()) {
        const std::string problem = writeWhole(options_.outputs.picture, report::pathPicture(record));
        if (!problem.empty()) return "--picture: " + problem;
    }
    if (options_.outputs.report.empty()) return {};
    const std::string problem = writeWhole(options_.outputs.report, report::reportPage({record, robots}));
    return problem.empty() ? problem : "--report: " + problem;
}

void RunReports::printSummary(const std::vector<report::RobotReport>& robots) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
    fmt::print(stderr, "\ncycle time  {:.3f} s (virtual), simulated in {:.3f} s\n{}",
               recorder_->record().end(), wall.count(), report::summaryText(recorder_->record(), robots));
    const std::pair<const char*, const std::string&> files[] = {
        {"trace", options_.outputs.trace},   {"signals", options_.outputs.signals},
        {"events", options_.outputs.events}, {"picture", options_.outputs.picture},
        {"report", options_.outputs.report}, {"errors", options_.outputs.errors},
    };
    const bool hasTable = std::any_of(robots.begin(), robots.end(),
                                      [](const auto& robot) { return !robot.analysis.moves.empty(); });
    const char* lineBefore = hasTable ? "\n" : "";
    for (const auto& [what, file] : files) {
        if (file.empty()) continue;
        fmt::print(stderr, "{}{:<12}{}\n", std::exchange(lineBefore, ""), what, file);
    }
}

bool RunReports::finish(Time end) {
    recorder_->finish(end);
    const std::vector<report::RobotReport> robots = report::robotReports(recorder_->record(), recordings_);
    const std::string problem = writeFiles(robots);
    if (options_.outputs.summary) printSummary(robots);
    if (!options_.outputs.compare.empty())
        fmt::print(stderr, "\n{}", report::comparisonText(recorder_->record(), robots, recordings_));
    if (!problem.empty()) fmt::print(stderr, "error: {}\n", problem);
    return problem.empty();
}

} // namespace rt
