#include "stdlib/impl/arc/weave_pattern.h"

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <cmath>

namespace rt::lib {
namespace {

/// A whole number from 0 on, at most `most`; -1 for others.
int kindOf(float value, int most) {
    return value >= 0 && value <= static_cast<float>(most) && value == std::floor(value)
               ? static_cast<int>(value)
               : -1;
}

/// The error of the pattern, or null.
const char* problemOf(const motion::WeavePattern& p) {
    for (const double number : {p.length, p.width, p.height, p.dwellLeft, p.dwellCenter, p.dwellRight,
                                p.direction, p.tilt, p.orientation, p.bias})
        if (!std::isfinite(number)) return "the components of weavedata must be numbers";
    if (!(p.length > 0)) return "weave_length of weavedata must be above 0";
    if (p.width < 0 || p.height < 0) return "weave_width and weave_height of weavedata must not be negative";
    if (p.dwellLeft < 0 || p.dwellCenter < 0 || p.dwellRight < 0)
        return "the dwell lengths of weavedata must not be negative";
    if (!(p.dwells() < p.length))
        return "the dwell lengths of weavedata together must be shorter than a cycle (weave_length)";
    if (p.shape == motion::WeaveShape::Zigzag && std::fabs(p.bias) > 0.5 * p.width)
        return "weave_bias of weavedata must not be greater than half the weave_width";
    return nullptr;
}

} // namespace

Status weavePattern(TaskCore* task, const data::Weavedata& data, double speed,
                    motion::WeavePattern& pattern) {
    const int shape = kindOf(data.weave_shape, 4);
    if (shape < 0) return fail(task, err::ERR_ARGVALERR, "weave_shape of weavedata must be 0, 1, 2, 3 or 4");
    pattern = {};
    if (shape == 0) return kOk;
    const int type = kindOf(data.weave_type, 3);
    if (type < 0) return fail(task, err::ERR_ARGVALERR, "weave_type of weavedata must be 0, 1, 2 or 3");
    constexpr int kByFrequency = 2; // types from here on have Hz as weave_length
    pattern.shape = static_cast<motion::WeaveShape>(shape);
    pattern.length = type < kByFrequency     ? static_cast<double>(data.weave_length)
                     : data.weave_length > 0 ? speed / data.weave_length
                                             : 0;
    pattern.width = data.weave_width;
    pattern.height = data.weave_height;
    pattern.dwellLeft = data.dwell_left;
    pattern.dwellCenter = data.dwell_center;
    pattern.dwellRight = data.dwell_right;
    pattern.direction = data.weave_dir;
    pattern.tilt = data.weave_tilt;
    pattern.orientation = data.weave_ori;
    pattern.bias = data.weave_bias;
    const char* problem = problemOf(pattern);
    if (problem != nullptr) return fail(task, err::ERR_ARGVALERR, problem);
    pattern.roundFor(speed);
    return kOk;
}

} // namespace rt::lib
