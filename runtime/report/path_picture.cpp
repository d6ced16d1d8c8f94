#include "runtime/report/path_picture.h"

#include "runtime/report/analysis.h"
#include "runtime/report/markup.h"
#include "runtime/report/picture_labels.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <set>

namespace rt::report {
namespace {

constexpr const char* kStyle =
    "<style>text{font:11px sans-serif;fill:#333}.title{font:bold 14px sans-serif}.mid{text-anchor:middle}"
    ".end{text-anchor:end}.grid{stroke:#ddd}.zone{fill:#7a5cc0;fill-opacity:.1;stroke:#7a5cc0;stroke-width:."
    "8}"
    ".point{fill:#222}.lead{stroke:#999;stroke-width:.5}.name{font-size:10px;fill:#111}"
    ".name,.change{paint-order:stroke;stroke:#fafafa;stroke-width:2.5px}.change{font-size:10px;fill:#0a6b2e}."
    "signal{fill:#0a6b2e}</style>\n"
    "<rect width='100%' height='100%' fill='white'/>\n";

/// One projection: picture coordinates from two world axes, same scale on both.
struct View {
    const char* title;
    const char *horizontal, *vertical;
    double motion::Vec3::* u;
    double motion::Vec3::* v;
    double left, top;
};

constexpr double kSize = 420, kMargin = 50;

struct Bounds {
    double lowU, lowV, span;
};

Bounds boundsOf(const RunRecord& record, const View& view) {
    double minU = 1e12, maxU = -1e12, minV = 1e12, maxV = -1e12;
    const auto take = [&](const motion::Vec3& place, double radius) {
        minU = std::min(minU, place.*view.u - radius), maxU = std::max(maxU, place.*view.u + radius);
        minV = std::min(minV, place.*view.v - radius), maxV = std::max(maxV, place.*view.v + radius);
    };
    for (const RobotRecord& robot : record.robots) {
        if (!robot.hasArm) continue;
        for (const Sample& sample : robot.samples)
            take(sample.position, 0);
        for (const Move& move : robot.moves)
            if (!move.stopPoint) take(move.end, move.zone);
    }
    if (minU > maxU) minU = maxU = minV = maxV = 0; // the program took no time
    const double span = std::max({maxU - minU, maxV - minV, 10.0}) * 1.08;
    return {(maxU + minU - span) / 2, (maxV + minV - span) / 2, span};
}

/// World coordinates to those of the picture.
struct Projection {
    const View& view;
    const Bounds& bounds;
    double x(const motion::Vec3& place) const {
        return view.left + (place.*view.u - bounds.lowU) / bounds.span * kSize;
    }
    double y(const motion::Vec3& place) const {
        return view.top + kSize - (place.*view.v - bounds.lowV) / bounds.span * kSize;
    }
};

std::string colourOf(double share) {
    const double s = std::clamp(share, 0.0, 1.0); // blue = slow, red = fast
    return fmt::format("hsl({:.0f},85%,45%)", 220 * (1 - s));
}

void drawGrid(std::string& svg, const View& view, const Bounds& bounds) {
    double step = std::pow(10, std::floor(std::log10(bounds.span)));
    if (bounds.span / step < 3) step /= 2;
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='#fafafa' stroke='#999'/>\n",
                       view.left, view.top, kSize, kSize);
    svg += fmt::format("<text x='{}' y='{}' class='title'>{}</text>\n", view.left, view.top - 12, view.title);
    // A sum with 0 is never -0.
    for (double at = std::ceil(bounds.lowU / step) * step + 0.0; at < bounds.lowU + bounds.span; at += step) {
        const double x = view.left + (at - bounds.lowU) / bounds.span * kSize;
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' class='grid'/>"
                           "<text x='{0:.1f}' y='{3}' class='mid'>{4:g}</text>\n",
                           x, view.top, view.top + kSize, view.top + kSize + 14, at);
    }
    for (double at = std::ceil(bounds.lowV / step) * step + 0.0; at < bounds.lowV + bounds.span; at += step) {
        const double y = view.top + kSize - (at - bounds.lowV) / bounds.span * kSize;
        svg += fmt::format("<line x1='{0}' y1='{1:.1f}' x2='{2}' y2='{1:.1f}' class='grid'/>"
                           "<text x='{3}' y='{4:.1f}' class='end'>{5:g}</text>\n",
                           view.left, y, view.left + kSize, view.left - 4, y + 3, at);
    }
    svg += fmt::format("<text x='{}' y='{}' class='end'>{} (mm)</text>\n", view.left + kSize,
                       view.top + kSize + 28, view.horizontal);
    svg += fmt::format("<text x='{}' y='{}'>{} (mm)</text>\n", view.left + 4, view.top + 12, view.vertical);
}

/// Colours of robots, also those of the page of --report.
const char* robotColour(std::size_t robot) {
    constexpr const char* kColours[] = {"#1456b8", "#c24e00", "#007a58", "#a8367f", "#7d6a00", "#4a4f9e"};
    return kColours[robot % std::size(kColours)];
}

/// Which path is whose: a broad line below the one that shows the speed.
void drawHalo(std::string& svg, const Projection& to, const std::vector<Sample>& samples,
              const char* colour) {
    std::string points, last;
    const auto flush = [&] {
        if (points.find(' ') != std::string::npos)
            svg += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-opacity='.25' "
                               "stroke-width='7'/>\n",
                               points, colour);
        points.clear();
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i > 0 && toolChanged(samples[i - 1], samples[i])) flush();
        std::string next = fmt::format("{:.1f},{:.1f}", to.x(samples[i].position), to.y(samples[i].position));
        if (!points.empty() && next == last) continue;
        points += (points.empty() ? "" : " ") + next;
        last = std::move(next);
    }
    flush();
}

void drawPath(std::string& svg, const Projection& to, const std::vector<Sample>& samples, double top) {
    const auto point = [&](const Sample& s) {
        return fmt::format("{:.1f},{:.1f}", to.x(s.position), to.y(s.position));
    };
    constexpr int kShades = 16;
    const auto jumps = [&](std::size_t k) { return toolChanged(samples[k], samples[k + 1]); };
    std::size_t i = 0;
    while (i + 1 < samples.size()) {
        if (jumps(i)) {
            ++i;
            continue;
        }
        const int shade = static_cast<int>(samples[i + 1].speed / top * kShades);
        std::string points = point(samples[i]);
        std::string last = points;
        while (i + 1 < samples.size() && !jumps(i) &&
               static_cast<int>(samples[i + 1].speed / top * kShades) == shade) {
            const std::string next = point(samples[++i]);
            if (next != last) points += " " + next;
            last = next;
        }
        svg += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.6'/>\n", points,
                           colourOf(static_cast<double>(shade) / kShades));
    }
}

/// The same for places that look alike: each is drawn once, however often the robot comes there.
std::string keyOf(const motion::Vec3& place, const std::string& text) {
    return fmt::format("{:.0f},{:.0f},{:.0f} {}", place.x, place.y, place.z, text);
}

void drawZones(std::string& svg, const Projection& to, const RobotRecord& record) {
    std::set<std::string> drawn;
    for (const Move& move : record.moves) {
        if (move.stopPoint || move.zone <= 0) continue;
        const std::string circle =
            fmt::format("<circle class='zone' cx='{:.1f}' cy='{:.1f}' r='{:.1f}'/>\n", to.x(move.end),
                        to.y(move.end), move.zone / to.bounds.span * kSize);
        if (drawn.insert(circle).second) svg += circle;
    }
}

void drawLabels(std::string& svg, LabelPlacer& labels, const LabelGroups& groups, const char* kind,
                std::size_t most) {
    for (const LabelGroups::Group& group : groups.groups()) {
        const std::string text = LabelGroups::textOf(group, most);
        const PlacedLabel label = labels.place(group.x, group.y, text);
        if (!label.placed) continue;
        const double end = std::clamp(group.x, label.x, label.x + PlacedLabel::widthOf(text));
        svg += fmt::format("<line class='lead' x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}'/>"
                           "<text class='{}' x='{:.1f}' y='{:.1f}'>{}</text>\n",
                           group.x, group.y, end, label.y - 3.5, kind, label.x, label.y, escaped(text));
    }
}

void drawPoints(std::string& svg, const Projection& to, const RobotRecord& record, LabelPlacer& labels) {
    std::set<std::string> drawn;
    LabelGroups names;
    for (const Move& move : record.moves) // names say more than lines
        if (move.text.isName) names.add(to.x(move.end), to.y(move.end), pointName(move));
    for (const Move& move : record.moves) {
        if (!drawn.insert(keyOf(move.end, pointName(move))).second) continue;
        const double x = to.x(move.end), y = to.y(move.end);
        svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.4' class='point'/>\n", x, y);
        labels.keepFree(x, y, 3);
        names.add(x, y, pointName(move));
    }
    drawLabels(svg, labels, names, "name", 3);
}

motion::Vec3 placeAt(const std::vector<Sample>& samples, double time) {
    const auto after = std::upper_bound(samples.begin(), samples.end(), time,
                                        [](double t, const Sample& sample) { return t < sample.time; });
    return after == samples.begin() ? samples.front().position : (after - 1)->position;
}

const RobotRecord* firstArm(const RunRecord& record) {
    for (const RobotRecord& robot : record.robots)
        if (robot.hasArm) return &robot;
    return nullptr;
}

/// Which colour is which robot.
void drawLegend(std::string& svg, const RunRecord& record) {
    double x = 3 * kMargin + 2 * kSize;
    for (std::size_t i = record.robots.size(); i-- > 0;) {
        const RobotRecord& robot = record.robots[i];
        if (!robot.hasArm) continue;
        x -= PlacedLabel::widthOf(robot.unit) + 24;
        svg += fmt::format("<line x1='{0:.1f}' y1='20' x2='{1:.1f}' y2='20' stroke='{2}' stroke-opacity='.5' "
                           "stroke-width='7'/><text x='{3:.1f}' y='24'>{4}</text>\n",
                           x, x + 12, robotColour(i), x + 16, escaped(robot.unit));
    }
}

void drawSignals(std::string& svg, const Projection& to, const RunRecord& record, LabelPlacer& labels) {
    const RobotRecord* robot = firstArm(record); // signals belong to no robot
    if (robot == nullptr || robot->samples.empty()) return;
    std::set<std::string> drawn;
    LabelGroups changes;
    for (const SignalTrack& signal : record.signals) {
        for (const SignalTrack::Change& change : signal.changes) {
            const motion::Vec3 place = placeAt(robot->samples, change.time);
            const std::string text = fmt::format("{}={:g}", signal.name, change.value);
            if (!drawn.insert(keyOf(place, text)).second) continue;
            const double x = to.x(place), y = to.y(place);
            svg += fmt::format("<path class='signal' d='M{:.1f} {:.1f}l3.5 3.5l-3.5 3.5l-3.5 -3.5z'/>\n", x,
                               y - 3.5);
            changes.add(x, y, text);
        }
    }
    drawLabels(svg, labels, changes, "change", 2);
}

} // namespace

std::string pathPicture(const RunRecord& record) {
    double top = 1;
    for (const RobotRecord& robot : record.robots)
        for (const Sample& sample : robot.samples)
            top = std::max(top, sample.speed);
    const auto arms = std::count_if(record.robots.begin(), record.robots.end(),
                                    [](const RobotRecord& robot) { return robot.hasArm; });
    using motion::Vec3;
    const View views[] = {
        {"Top view", "x", "y", &Vec3::x, &Vec3::y, kMargin, kMargin},
        {"Side view", "x", "z", &Vec3::x, &Vec3::z, 2 * kMargin + kSize + 10, kMargin},
    };
    double lastTime = 0;
    for (const RobotRecord& robot : record.robots)
        if (!robot.samples.empty()) lastTime = std::max(lastTime, robot.samples.back().time);
    std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' width='{}'>\n",
                                  3 * kMargin + 2 * kSize, 2 * kMargin + kSize + 30, 3 * kMargin + 2 * kSize);
    svg += kStyle;
    for (const View& view : views) {
        const Bounds bounds = boundsOf(record, view);
        const Projection to{view, bounds};
        LabelPlacer labels(view.left, view.top + 16, kSize, kSize - 16);
        drawGrid(svg, view, bounds);
        for (std::size_t i = 0; i < record.robots.size(); ++i) {
            const RobotRecord& robot = record.robots[i];
            if (!robot.hasArm) continue;
            if (arms > 1) drawHalo(svg, to, robot.samples, robotColour(i));
            drawZones(svg, to, robot);
            drawPath(svg, to, robot.samples, top);
        }
        for (const RobotRecord& robot : record.robots)
            if (robot.hasArm) drawPoints(svg, to, robot, labels);
        drawSignals(svg, to, record, labels);
    }
    if (arms > 1) drawLegend(svg, record);
    svg += fmt::format(
        "<text x='{}' y='{}'>TCP path, {:.3f} s; blue = at rest, red = {:.0f} mm/s; dots: end of a "
        "move; circles: zones; diamonds: a signal changes</text>\n",
        kMargin, 2 * kMargin + kSize + 20, lastTime, top);
    svg += "</svg>\n";
    return svg;
}

} // namespace rt::report
