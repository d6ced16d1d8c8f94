#include "runtime/report/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace rt::report {
namespace {

constexpr std::size_t kMostMoves = 60;  // more are put together by instruction
constexpr std::size_t kMostLines = 200; // of the table
constexpr std::size_t kMostCauses = 5;
constexpr std::size_t kWidth = 34; // of an instruction
constexpr double kShown = 0.0005;  // s

struct Row {
    std::string place, instruction, zone, speed, count;
    double time = 0, reached = 0;
    std::vector<Loss> losses;
    std::size_t moves = 0;
    std::string slowedBy;
};

/// "stop point 0.310 s, acceleration of axis 2 0.020 s".
std::string lossText(const std::vector<Loss>& losses, std::size_t most) {
    std::string text;
    for (const Loss& loss : losses) {
        if (loss.seconds < kShown || most-- == 0) break;
        text += fmt::format("{}{} {:.3f} s", text.empty() ? "" : ", ", causeText(loss), loss.seconds);
    }
    return text;
}

std::string shortened(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end; // not within a character
    return text.substr(0, end) + "...";
}

Row rowOf(const MoveResult& result) {
    const Move& move = *result.move;
    Row row;
    row.place = placeName(move);
    row.instruction = shortened(instructionName(move), kWidth);
    row.zone = move.stopPoint ? "fine" : fmt::format("{:g} mm", move.zone);
    row.speed = move.duration > 0 ? fmt::format("{:g} s", move.duration) : fmt::format("{:.0f}", move.speed);
    row.time = result.end - result.start;
    row.reached = result.reached;
    row.moves = 1;
    row.losses = result.losses;
    if (result.main.seconds <= 0) {
        row.slowedBy = causeText(result.main);
        const std::string lost = lossText(result.losses, 2);
        if (!lost.empty()) row.slowedBy += "; " + lost;
    } else {
        row.slowedBy = lossText(result.losses, 3);
    }
    return row;
}

std::vector<Row> rowsByInstruction(const Analysis& analysis) {
    std::vector<Row> rows;
    std::map<std::pair<std::string, uint32_t>, std::size_t> known;
    for (const MoveResult& result : analysis.moves) {
        const Row row = rowOf(result);
        const auto [at, isNew] = known.try_emplace({row.place, result.move->place.column}, rows.size());
        if (isNew) {
            rows.push_back(row);
            continue;
        }
        Row& sum = rows[at->second];
        sum.time += row.time;
        sum.reached = std::max(sum.reached, row.reached);
        ++sum.moves;
        for (const Loss& loss : row.losses)
            addLoss(sum.losses, loss);
        if (sum.speed != row.speed) sum.speed = "varies";
        if (sum.zone != row.zone) sum.zone = "varies";
    }
    for (Row& row : rows) {
        if (row.moves == 1) continue;
        row.count = fmt::format(" x {}", row.moves);
        const std::string lost = lossText(row.losses, 3);
        row.slowedBy = lost.empty() ? "programmed speed" : lost;
    }
    return rows;
}

void appendTable(std::string& text, const std::vector<Row>& rows) {
    constexpr const char* kLine = "{:<{}}  {:<{}}  {:>7}  {:>9}  {:>9}  {:>9}  {}\n";
    std::size_t place = 5, instruction = 8;
    for (const Row& row : rows) {
        place = std::max(place, row.place.size() + row.count.size());
        instruction = std::max(instruction, row.instruction.size());
    }
    fmt::format_to(std::back_inserter(text), fmt::runtime(kLine), "place", place, "movement", instruction,
                   "zone", "mm/s", "reached", "time", "slowed by");
    for (std::size_t i = 0; i < rows.size() && i < kMostLines; ++i) {
        const Row& row = rows[i];
        fmt::format_to(std::back_inserter(text), fmt::runtime(kLine), row.place + row.count, place,
                       row.instruction, instruction, row.zone, row.speed, fmt::format("{:.0f}", row.reached),
                       fmt::format("{:.3f} s", row.time), row.slowedBy);
    }
    if (rows.size() > kMostLines)
        text += fmt::format("and {} more; --report shows all of them\n", rows.size() - kMostLines);
}

std::string robotSummary(const Analysis& analysis) {
    const double whole = std::max(analysis.cycle, 1e-9);
    std::string text =
        fmt::format("moving      {:.3f} s ({:.0f} %), {} movements, {:.0f} mm\n", analysis.moving,
                    100 * analysis.moving / whole, analysis.moves.size(), analysis.length);
    text += fmt::format("waiting     {:.3f} s\n", analysis.waiting);
    if (analysis.moves.empty()) return text;
    const std::string lost = lossText(analysis.losses, kMostCauses);
    text += fmt::format("lost to     {}\n\n", lost.empty() ? "nothing, all at programmed speed" : lost);
    std::vector<Row> rows;
    if (analysis.moves.size() > kMostMoves)
        rows = rowsByInstruction(analysis);
    else
        for (const MoveResult& result : analysis.moves)
            rows.push_back(rowOf(result));
    appendTable(text, rows);
    return text;
}

std::string robotComparison(const Comparison& comparison, const Recording& recording) {
    std::string text =
        fmt::format("compared    with {} ({} samples{})\n", recording.file, recording.samples.size(),
                    comparison.atFlange ? ", axis angles: positions are those of the flange" : "");
    if (!comparison.problem.empty()) return text + fmt::format("            {}\n", comparison.problem);
    double difference = comparison.here - comparison.there;
    if (std::fabs(difference) < kShown) difference = 0; // and without a sign
    text += fmt::format(
        "time        {:.3f} s here, {:.3f} s there: {:+.3f} s ({:+.1f} %), from 1 mm after the start to 1 mm "
        "before the end\n",
        comparison.here, comparison.there, difference, 100 * difference / std::max(comparison.there, 1e-9));
    text += fmt::format("path        median {:.3f} mm, 95 % within {:.3f} mm, worst {:.3f} mm",
                        comparison.median, comparison.most, comparison.worst);
    if (comparison.worst >= kShown && comparison.worstMove != nullptr)
        text +=
            fmt::format(" at {:.3f} s ({}, {})", comparison.worstTime, placeName(*comparison.worstMove->move),
                        shortened(instructionName(*comparison.worstMove->move), kWidth));
    text += "\n";
    const std::vector<TimeDifference> largest = comparison.largest(8);
    if (largest.empty()) text += "differences none of a millisecond or more\n";
    for (std::size_t i = 0; i < largest.size(); ++i) {
        const TimeDifference& part = largest[i];
        text += fmt::format("{:<12}{:+.3f} s ({:.3f} here, {:.3f} there)  {}, {}{}\n",
                            i == 0 ? "differences" : "", part.difference(), part.here, part.there,
                            placeName(*part.move->move), shortened(instructionName(*part.move->move), kWidth),
                            part.waiting ? ", waiting at its end" : "");
    }
    return text;
}

} // namespace

std::string summaryText(const RunRecord& record, const std::vector<RobotReport>& robots) {
    if (robots.size() == 1) return robotSummary(robots.front().analysis);
    std::string text;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        const RobotRecord& robot = record.robots[i];
        text += fmt::format("{}robot       {}{}\n{}", i == 0 ? "" : "\n", robot.unit,
                            robot.hasArm ? fmt::format(" ({})", robot.robot.name) : "",
                            robotSummary(robots[i].analysis));
    }
    return text;
}

std::string comparisonText(const RunRecord& record, const std::vector<RobotReport>& robots,
                           const std::vector<Recording>& recordings) {
    std::string text;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        if (robots[i].recording == nullptr) continue;
        if (robots.size() > 1)
            text += fmt::format("{}robot       {}\n", text.empty() ? "" : "\n", record.robots[i].unit);
        text += robotComparison(robots[i].comparison, *robots[i].recording);
    }
    if (!text.empty() || recordings.empty()) return text;
    std::string here, there;
    for (const RobotRecord& robot : record.robots)
        here += (here.empty() ? "" : ", ") + robot.unit;
    for (const Recording& recording : recordings)
        there += (there.empty() ? "" : ", ") + recording.unit;
    return fmt::format("compared    with {}: nothing; its column of robots names {}, the run has {}\n",
                       recordings.front().file, there, here);
}

} // namespace rt::report
