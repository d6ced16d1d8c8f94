#include "runtime/report/page_data.h"

#include "config/json_text.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace rt::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTimeUnit = 1e-4;  // s
constexpr double kAngleUnit = 1e-5; // deg: accelerations are second differences at 4 ms
constexpr double kLengthUnit = 1e-3, kSpeedUnit = 0.01;

/// Enough for people, and no tail of digits.
double rounded(double value) {
    return std::round(value * 1e6) / 1e6;
}

template <class Value>
void appendSeries(std::string& text, const char* name, double unit, std::size_t count, Value value) {
    fmt::format_to(std::back_inserter(text), ",\"{}\":{{\"unit\":{},\"d\":[", name, unit);
    long long before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const long long now = std::llround(value(i) / unit);
        fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : ",", now - before);
        before = now;
    }
    text += "]}";
}

void appendSamples(std::string& text, const RobotRecord& robot) {
    const std::vector<Sample>& samples = robot.samples;
    const std::size_t count = samples.size();
    appendSeries(text, "time", kTimeUnit, count, [&](std::size_t i) { return samples[i].time; });
    const std::size_t axes = samples.empty() ? 0 : samples.front().joints.size();
    for (std::size_t axis = 0; axis < axes; ++axis)
        appendSeries(text, fmt::format("j{}", axis + 1).c_str(), kAngleUnit, count,
                     [&](std::size_t i) { return samples[i].joints[axis]; });
    for (const ExternalAxis& axis : robot.external)
        appendSeries(text, fmt::format("e{}", axis.index + 1).c_str(), kAngleUnit, count, [&](std::size_t i) {
            const double place = samples[i].external[axis.index];
            return motion::isConnected(place) ? place : 0;
        });
    appendSeries(text, "x", kLengthUnit, count, [&](std::size_t i) { return samples[i].position.x; });
    appendSeries(text, "y", kLengthUnit, count, [&](std::size_t i) { return samples[i].position.y; });
    appendSeries(text, "z", kLengthUnit, count, [&](std::size_t i) { return samples[i].position.z; });
    appendSeries(text, "speed", kSpeedUnit, count, [&](std::size_t i) { return samples[i].speed; });
    appendSeries(text, "move", 1, count, [&](std::size_t i) { return static_cast<double>(samples[i].move); });
}

void appendComparison(std::string& text, const Comparison& comparison) {
    const std::vector<PathPoint>& points = comparison.points;
    const Track& track = comparison.track;
    appendSeries(text, "pathTime", kTimeUnit, points.size(), [&](std::size_t i) { return points[i].time; });
    appendSeries(text, "pathDistance", kLengthUnit, points.size(),
                 [&](std::size_t i) { return points[i].distance; });
    appendSeries(text, "pathDelay", kTimeUnit, points.size(), [&](std::size_t i) { return points[i].delay; });
    appendSeries(text, "otherTime", kTimeUnit, track.size(), [&](std::size_t i) { return track[i].time; });
    appendSeries(text, "otherX", kLengthUnit, track.size(),
                 [&](std::size_t i) { return track[i].position.x; });
    appendSeries(text, "otherY", kLengthUnit, track.size(),
                 [&](std::size_t i) { return track[i].position.y; });
    appendSeries(text, "otherZ", kLengthUnit, track.size(),
                 [&](std::size_t i) { return track[i].position.z; });
}

Json lossesOf(const std::vector<Loss>& losses) {
    Json list = Json::array();
    for (const Loss& loss : losses)
        list.push_back({causeText(loss), rounded(loss.seconds)});
    return list;
}

Json moveOf(const Move& move, const MoveResult* result) {
    Json json = {{"n", move.number},
                 {"place", placeName(move)},
                 {"what", instructionName(move)},
                 {"point", pointName(move)},
                 {"zone", move.stopPoint ? 0 : rounded(move.zone)},
                 {"stop", move.stopPoint},
                 {"speed", rounded(move.speed)},
                 {"end", {rounded(move.end.x), rounded(move.end.y), rounded(move.end.z)}}};
    if (move.duration > 0) json["duration"] = rounded(move.duration);
    if (result == nullptr) return json;
    json["from"] = rounded(result->start);
    json["to"] = rounded(result->end);
    json["reached"] = rounded(result->reached);
    json["length"] = rounded(result->length);
    json["atSpeed"] = rounded(result->atProgrammed);
    json["verdict"] = verdict(*result);
    json["losses"] = lossesOf(result->losses);
    return json;
}

Json movesOf(const RobotRecord& record, const Analysis& analysis) {
    Json list = Json::array();
    auto result = analysis.moves.begin(); // in order of their numbers, unless the robot went back
    for (const Move& move : record.moves) {
        const auto found = std::find_if(result, analysis.moves.end(),
                                        [&move](const MoveResult& r) { return r.move == &move; });
        list.push_back(moveOf(move, found != analysis.moves.end() ? &*found : nullptr));
        if (found == result && found != analysis.moves.end()) ++result;
    }
    return list;
}

Json signalsOf(const RunRecord& record) {
    Json list = Json::array();
    for (const SignalTrack& signal : record.signals) {
        if (signal.changes.empty()) continue;
        Json changes = Json::array();
        for (const SignalTrack::Change& change : signal.changes)
            changes.push_back({rounded(change.time), change.value});
        list.push_back({{"name", signal.name},
                        {"type", signal.type},
                        {"initial", signal.initial},
                        {"changes", changes}});
    }
    return list;
}

Json markersOf(const RunRecord& record) {
    Json list = Json::array();
    for (const Marker& marker : record.markers) {
        Json json = {{"time", rounded(marker.time)}, {"kind", marker.kind}, {"text", marker.text}};
        if (marker.number != 0) json["number"] = marker.number;
        if (!marker.title.empty()) json["title"] = marker.title;
        list.push_back(std::move(json));
    }
    return list;
}

Json comparisonOf(const Comparison& comparison, const Recording& recording) {
    Json json = {
        {"file", recording.file}, {"samples", recording.samples.size()}, {"atFlange", comparison.atFlange}};
    if (!comparison.problem.empty()) {
        json["problem"] = comparison.problem;
        return json;
    }
    json["here"] = rounded(comparison.here);
    json["there"] = rounded(comparison.there);
    json["median"] = rounded(comparison.median);
    json["most"] = rounded(comparison.most);
    json["worst"] = rounded(comparison.worst);
    json["worstTime"] = rounded(comparison.worstTime);
    const robot::Vec3& place = comparison.worstPlace;
    json["worstPlace"] = {rounded(place.x), rounded(place.y), rounded(place.z)};
    Json rows = Json::array();
    for (const TimeDifference& part : comparison.differences)
        rows.push_back({{"n", part.move->move->number},
                        {"waiting", part.waiting},
                        {"here", rounded(part.here)},
                        {"there", rounded(part.there)}});
    json["parts"] = std::move(rows);
    return json;
}

Json totalsOf(const Analysis& analysis) {
    return {{"cycle", rounded(analysis.cycle)},
            {"moving", rounded(analysis.moving)},
            {"waiting", rounded(analysis.waiting)},
            {"length", rounded(analysis.length)},
            {"losses", lossesOf(analysis.losses)}};
}

/// The data from which the page finds the acceleration limits of a posture (runtime/robot/dynamics.h); m, rad/s^2.
Json dynamicsOf(const robot::RobotModel& robot) {
    Json axes = Json::array();
    for (std::size_t i = 0; i < robot.maxSpeed.size(); ++i) {
        const robot::AccelerationLimit& limit = robot.dynamics.axes[i];
        axes.push_back({{"scale", limit.scale},
                        {"most", limit.cap},
                        {"base", limit.base},
                        {"elbow", limit.elbow},
                        {"wrist", limit.wrist},
                        {"reach", limit.reach}});
    }
    const robot::OpwParameters& g = robot.geometry;
    return {{"axes", std::move(axes)},
            {"a1", 0.001 * g.a1},
            {"a2", 0.001 * g.a2},
            {"c2", 0.001 * g.c2},
            {"c3", 0.001 * g.c3}};
}

Json externalOf(const RobotRecord& record) {
    Json list = Json::array();
    for (const ExternalAxis& axis : record.external)
        list.push_back({{"name", axis.name},
                        {"number", axis.index + 1},
                        {"rotating", axis.rotating},
                        {"speed", rounded(axis.maxSpeed)}});
    return list;
}

std::string robotData(const RobotRecord& record, const RobotReport& report) {
    Json json = {{"unit", record.unit},
                 {"robot", record.robot.name},
                 {"hasArm", record.hasArm},
                 {"limits",
                  {{"speed", record.robot.maxSpeed},
                   {"dynamics", dynamicsOf(record.robot)},
                   {"tcp", record.robot.maxTcpSpeed},
                   {"assumed", record.robot.provisional}}},
                 {"external", externalOf(record)},
                 {"totals", totalsOf(report.analysis)},
                 {"moves", movesOf(record, report.analysis)}};
    if (report.recording != nullptr) json["comparison"] = comparisonOf(report.comparison, *report.recording);
    std::string text = rapid::config::textOf(json);
    text.pop_back(); // the brace, after the series
    appendSamples(text, record);
    if (report.recording != nullptr) appendComparison(text, report.comparison);
    return text + "}";
}

} // namespace

std::vector<RobotReport> robotReports(const RunRecord& record, const std::vector<Recording>& recordings) {
    const std::vector<const Recording*> theirs = recordingsFor(record.robots, recordings);
    std::vector<RobotReport> reports(record.robots.size());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        reports[i].analysis = analyse(record.robots[i]);
        reports[i].recording = theirs[i];
    }
    for (std::size_t i = 0; i < reports.size(); ++i) // the comparisons name movements of the analyses
        if (theirs[i] != nullptr)
            reports[i].comparison = compare(record.robots[i], reports[i].analysis, *theirs[i]);
    return reports;
}

std::string pageData(const ReportContent& content) {
    const RunRecord& record = content.record;
    const Json json = {{"program", record.program},
                       {"end", rounded(record.end())},
                       {"signals", signalsOf(record)},
                       {"markers", markersOf(record)}};
    std::string text = rapid::config::textOf(json);
    text.pop_back(); // the brace, after the robots
    text += ",\"robots\":[";
    for (std::size_t i = 0; i < record.robots.size(); ++i) {
        if (i > 0) text += ",";
        text += robotData(record.robots[i], content.robots[i]);
    }
    text += "]}";
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    }
    return safe;
}

} // namespace rt::report
