#include "tools/rapidc/path_picture.h"

#include "runtime/base/output_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace rapidc {

namespace {

using Sample = PathPicture::Sample;

/// One projection: picture coordinates from two world axes, same scale on both.
struct View {
    const char* title;
    const char *horizontal, *vertical;
    double Sample::* u;
    double Sample::* v;
    double left, top;
};

constexpr double kSize = 420, kMargin = 50;

struct Bounds {
    double lowU, lowV, span;
};

Bounds boundsOf(const std::vector<Sample>& samples, const View& view) {
    auto [minU, maxU] =
        std::minmax_element(samples.begin(), samples.end(),
                            [&](const Sample& a, const Sample& b) { return a.*view.u < b.*view.u; });
    auto [minV, maxV] =
        std::minmax_element(samples.begin(), samples.end(),
                            [&](const Sample& a, const Sample& b) { return a.*view.v < b.*view.v; });
    const double span =
        std::max({(*maxU).*view.u - (*minU).*view.u, (*maxV).*view.v - (*minV).*view.v, 10.0}) * 1.08;
    return {((*maxU).*view.u + (*minU).*view.u - span) / 2, ((*maxV).*view.v + (*minV).*view.v - span) / 2,
            span};
}

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
    for (double at = std::ceil(bounds.lowU / step) * step; at < bounds.lowU + bounds.span; at += step) {
        const double x = view.left + (at - bounds.lowU) / bounds.span * kSize;
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' class='grid'/>"
                           "<text x='{0:.1f}' y='{3}' class='mid'>{4:g}</text>\n",
                           x, view.top, view.top + kSize, view.top + kSize + 14, at);
    }
    for (double at = std::ceil(bounds.lowV / step) * step; at < bounds.lowV + bounds.span; at += step) {
        const double y = view.top + kSize - (at - bounds.lowV) / bounds.span * kSize;
        svg += fmt::format("<line x1='{0}' y1='{1:.1f}' x2='{2}' y2='{1:.1f}' class='grid'/>"
                           "<text x='{3}' y='{4:.1f}' class='end'>{5:g}</text>\n",
                           view.left, y, view.left + kSize, view.left - 4, y + 3, at);
    }
    svg += fmt::format("<text x='{}' y='{}' class='end'>{} (mm)</text>\n", view.left + kSize,
                       view.top + kSize + 28, view.horizontal);
    svg += fmt::format("<text x='{}' y='{}'>{} (mm)</text>\n", view.left + 4, view.top + 12, view.vertical);
}

void drawPath(std::string& svg, const View& view, const Bounds& bounds, const std::vector<Sample>& samples,
              double top) {
    auto point = [&](const Sample& s) {
        return fmt::format("{:.1f},{:.1f}", view.left + (s.*view.u - bounds.lowU) / bounds.span * kSize,
                           view.top + kSize - (s.*view.v - bounds.lowV) / bounds.span * kSize);
    };
    constexpr int kShades = 16;
    // The active tool may change: the TCP is then somewhere else at once, without having moved.
    auto jumps = [&](size_t k) {
        const Sample &a = samples[k], &b = samples[k + 1];
        const double way = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
        return way > 1 && way > 2 * std::max(a.speed, b.speed) * (b.time - a.time);
    };
    size_t i = 0;
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
    for (size_t k = 1; k < samples.size(); ++k)
        if (samples[k].move != samples[k - 1].move) {
            const std::string at = point(samples[k - 1]);
            svg += fmt::format("<circle cx='{}' cy='{}' r='2.4' fill='#222'/>\n", at.substr(0, at.find(',')),
                               at.substr(at.find(',') + 1));
        }
}

} // namespace

void PathPicture::sample(rt::Time time, std::string_view /*unit*/, const motion::MotionState& state) {
    const Sample next{rt::toSeconds(time), state.tcp.pos.x, state.tcp.pos.y,
                      state.tcp.pos.z,     state.tcpSpeed,  static_cast<int>(state.tag)};
    const auto same = [&next](const Sample& s) {
        return s.x == next.x && s.y == next.y && s.z == next.z && s.speed == next.speed &&
               s.move == next.move;
    };
    // While the arm stands, the first and the last sample say all.
    const size_t count = samples_.size();
    if (count >= 2 && same(samples_[count - 1]) && same(samples_[count - 2]))
        samples_.back() = next;
    else
        samples_.push_back(next);
}

std::string PathPicture::write(const std::string& svgFile) const {
    return rt::writeWhole(svgFile, drawing());
}

std::string PathPicture::drawing() const {
    std::vector<Sample> samples = samples_;
    if (samples.empty()) samples.emplace_back(); // the program took no time
    double top = 1;
    for (const Sample& s : samples)
        top = std::max(top, s.speed);
    const View views[] = {
        {"Top view", "x", "y", &Sample::x, &Sample::y, kMargin, kMargin},
        {"Side view", "x", "z", &Sample::x, &Sample::z, 2 * kMargin + kSize + 10, kMargin},
    };
    std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' width='{}'>\n",
                                  3 * kMargin + 2 * kSize, 2 * kMargin + kSize + 30, 3 * kMargin + 2 * kSize);
    svg +=
        "<style>text{font:11px sans-serif;fill:#333}.title{font:bold 14px sans-serif}.mid{text-anchor:middle}"
        ".end{text-anchor:end}.grid{stroke:#ddd}</style>\n<rect width='100%' height='100%' fill='white'/>\n";
    for (const View& view : views) {
        const Bounds bounds = boundsOf(samples, view);
        drawGrid(svg, view, bounds);
        drawPath(svg, view, bounds, samples, top);
    }
    svg += fmt::format("<text x='{}' y='{}'>TCP path, {:.3f} s; blue = standing, red = {:.0f} mm/s; dots: "
                       "end of a move</text>\n",
                       kMargin, 2 * kMargin + kSize + 20, samples.back().time, top);
    svg += "</svg>\n";
    return svg;
}

} // namespace rapidc
