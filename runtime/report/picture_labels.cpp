#include "runtime/report/picture_labels.h"

#include <algorithm>
#include <cmath>

namespace rt::report {
namespace {

constexpr double kCharacter = 5.6, kHeight = 11; // of the 10 px font, about

} // namespace

void LabelPlacer::keepFree(double x, double y, double radius) {
    taken_.push_back({x - radius, y - radius, x + radius, y + radius});
}

bool LabelPlacer::isFree(const Box& box) const {
    if (box.left < left_ || box.right > right_ || box.top < top_ || box.bottom > bottom_) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&box](const Box& other) {
        return box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom;
    });
}

PlacedLabel LabelPlacer::place(double x, double y, const std::string& text) {
    const double width = kCharacter * static_cast<double>(text.size());
    constexpr double kAngle = 0.7854; // eighths of a turn
    for (const double distance : {8.0, 18.0, 32.0, 48.0, 66.0}) {
        for (const int eighth : {7, 1, 0, 5, 3, 4, 6, 2}) {
            const double dx = std::cos(eighth * kAngle) * distance, dy = -std::sin(eighth * kAngle) * distance;
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
