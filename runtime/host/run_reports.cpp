#include "runtime/host/run_reports.h"

#include "runtime/base/output_file.h"
#include "runtime/host/controller.h"
#include "runtime/report/page.h"
#include "runtime/report/path_picture.h"
#include "runtime/report/summary.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace rt {
namespace {

constexpr std::size_t kMostMarkers = 20'000; // on the page

} // namespace

bool RunReports::areWanted(const RunOptions& options) {
    return options.summary || !options.report.empty() || !options.compare.empty() || !options.picture.empty();
}

std::string RunReports::prepare(Controller& controller, const ProgramDesc& program) {
    if (!options_.compare.empty()) {
        if (const std::string problem = report::readRecording(options_.compare, recording_); !problem.empty())
            return "--compare: " + problem;
    }
    recorder_ = std::make_unique<report::RunRecorder>(program.name, controller.motions().front()->model());
    recorder_->setFolder(program.folder != nullptr ? program.folder : "");
    if (const std::string problem = writeFiles({}, nullptr); !problem.empty()) return problem;
    listen(controller);
    return {};
}

void RunReports::listen(Controller& controller) {
    controller.motions().front()->addTrace(*recorder_);
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
std::string RunReports::writeFiles(const report::Analysis& analysis,
                                   const report::Comparison* comparison) const {
    const report::RunRecord& record = recorder_->record();
    if (!options_.picture.empty()) {
        const std::string problem = writeWhole(options_.picture, report::pathPicture(record));
        if (!problem.empty()) return "--picture: " + problem;
    }
    if (options_.report.empty()) return {};
    const report::ReportContent content{record, analysis, &recording_, comparison};
    const std::string problem = writeWhole(options_.report, report::reportPage(content));
    return problem.empty() ? problem : "--report: " + problem;
}

void RunReports::printSummary(const report::Analysis& analysis) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
    fmt::print(stderr, "\ncycle time  {:.3f} s (virtual), simulated in {:.3f} s\n{}", analysis.cycle,
               wall.count(), report::summaryText(recorder_->record(), analysis));
    const std::pair<const char*, const std::string&> files[] = {
        {"trace", options_.trace},     {"signals", options_.signals}, {"events", options_.events},
        {"picture", options_.picture}, {"report", options_.report},
    };
    const char* lineBefore = analysis.moves.empty() ? "" : "\n";
    for (const auto& [what, file] : files) {
        if (file.empty()) continue;
        fmt::print(stderr, "{}{:<12}{}\n", std::exchange(lineBefore, ""), what, file);
    }
}

bool RunReports::finish(Time end) {
    recorder_->finish(end);
    const report::Analysis analysis = report::analyse(recorder_->record());
    report::Comparison comparison;
    const bool compares = !options_.compare.empty();
    if (compares) comparison = report::compare(recorder_->record(), analysis, recording_);
    const std::string problem = writeFiles(analysis, compares ? &comparison : nullptr);
    if (options_.summary) printSummary(analysis);
    if (compares) fmt::print(stderr, "\n{}", report::comparisonText(comparison, recording_));
    if (!problem.empty()) fmt::print(stderr, "error: {}\n", problem);
    return problem.empty();
}

} // namespace rt
