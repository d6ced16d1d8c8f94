#include "runtime/report/picture_labels.h"

#include <algorithm>
#include <cmath>

namespace rt::report {
namespace {

constexpr double kCharacter = 6.4, kHeight = 11; // of the 10 px font, at most

} // namespace

void LabelGroups::add(double x, double y, const std::string& text) {
    constexpr double kSamePlace = 3; // px
    const auto near = [&](const Group& g) { return std::hypot(g.x - x, g.y - y) <= kSamePlace; };
    auto group = std::find_if(groups_.begin(), groups_.end(), near);
    if (group == groups_.end()) group = groups_.insert(groups_.end(), {x, y, {}});
    if (std::find(group->texts.begin(), group->texts.end(), text) == group->texts.end())
        group->texts.push_back(text);
}

std::string LabelGroups::textOf(const Group& group, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < group.texts.size() && i < most; ++i)
        text += (i == 0 ? "" : ", ") + group.texts[i];
    if (group.texts.size() > most) text += " +" + std::to_string(group.texts.size() - most);
    return text;
}

double PlacedLabel::widthOf(const std::string& text) {
    return kCharacter * static_cast<double>(text.size());
}

void LabelPlacer::keepFree(double x, double y, double radius) {
    taken_.push_back({x - radius, y - radius, x + radius, y + radius});
}

bool LabelPlacer::isFree(const Box& box) const {
    if (box.left < left_ || box.right > right_ || box.top < top_ || box.bottom > bottom_) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&box](const Box& other) {
        return box.left < other.right && other.left < box.right && box.top < other.bottom &&
               other.top < box.bottom;
    });
}

PlacedLabel LabelPlacer::place(double x, double y, const std::string& text) {
    const double width = PlacedLabel::widthOf(text);
    constexpr double kAngle = 0.7854; // eighths of a turn
    for (const double distance : {8.0, 18.0, 32.0, 48.0, 66.0}) {
        for (const int eighth : {7, 1, 0, 5, 3, 4, 6, 2}) {
            const double dx = std::cos(eighth * kAngle) * distance,
                         dy = -std::sin(eighth * kAngle) * distance;
            const double left = dx > 1 ? x + dx : dx < -1 ? x + dx - width : x - width / 2;
            const Box box{left, y + dy - kHeight / 2, left + width, y + dy + kHeight / 2};
            if (!isFree(box)) continue;
            taken_.push_back(box);
            return {left, y + dy + kHeight / 2 - 2, x, y, true};
        }
    }
    return {};
}

} // namespace rt::report
