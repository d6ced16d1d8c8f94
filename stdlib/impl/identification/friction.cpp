// Friction identification (Advanced Shape Tuning). The simulated arm follows its path exactly whatever the friction levels are, so
// the configured level, 100 percent, is the best one.

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "natives/servo_tools.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

using namespace rt;

namespace {

constexpr float kLeastLevel = 1, kMostLevel = 500, kConfigured = 100; // percent

/// A service of the motion group.
struct FrictionLevels {
    bool isStarted = false;
    motion::MoveId first = 0; ///< ordered last when the sequence began
    std::array<float, robot::kMostJoints> levels{};
};

Status fatal(TaskCore* task, std::string_view text) {
    return lib::fail(task, err::ERR_FRICTUNE_FATAL, text);
}

/// The robot of the task has these axes; else ERR_FRICTUNE_FATAL.
Status checkAxes(TaskCore* task, Handle* unit, int32_t count) {
    if (!lib::movesRobot(taskOf(task))) return fatal(task, "the task does not move a robot");
    const MotionDriver& motion = lib::motionOf(task);
    if (unit != nullptr) {
        Status status = kOk;
        const MechanicalUnit* asked = lib::unitOf(task, *unit, status);
        if (asked == nullptr) return status;
        if (!asked->isRobot || asked->group != motion.group())
            return fatal(task, "friction is tuned for the robot of the task only");
    }
    const auto axes = static_cast<int32_t>(motion.model().lowerDeg.size());
    if (count >= axes) return kOk;
    return fatal(task, fmt::format("FricLevels needs an element for each of the {} axes", axes));
}

} // namespace

extern "C" {

Status rt_FricIdInit(TaskCore* task) {
    MotionDriver& motion = lib::motionOf(task);
    if (const Status status = motion.waitIdle(taskOf(task))) return status;
    auto& friction = motion.service<FrictionLevels>();
    friction.isStarted = true;
    friction.first = motion.system().lastOrdered();
    return kOk;
}

Status rt_FricIdEvaluate(TaskCore* task, float* FricLevels, int32_t FricLevelsDim1, Handle* MechUnit,
                         const data::Speeddata*, bool NoPrint, const float* FricLevelMax,
                         const float* FricLevelMin, const float* OptTolerance) {
    if (const Status status = checkAxes(task, MechUnit, FricLevelsDim1)) return status;
    MotionDriver& motion = lib::motionOf(task);
    auto& friction = motion.service<FrictionLevels>();
    if (!friction.isStarted) return fatal(task, "FricIdEvaluate ends a sequence that FricIdInit began");
    if (motion.system().lastOrdered() == friction.first)
        return fatal(task, "the robot has not moved since FricIdInit");
    const float most = FricLevelMax != nullptr ? *FricLevelMax : kMostLevel;
    const float least = FricLevelMin != nullptr ? *FricLevelMin : kLeastLevel;
    if (!(least >= kLeastLevel && least < most && most <= kMostLevel))
        return fatal(task, "\\FricLevelMin must be below \\FricLevelMax, both within 1 to 500 percent");
    if (OptTolerance != nullptr && !(*OptTolerance > 0)) return fatal(task, "\\OptTolerance must be above 0");
    if (const Status status = motion.waitIdle(taskOf(task))) return status;
    friction.isStarted = false;
    const float best = std::clamp(kConfigured, least, most);
    for (std::size_t i = 0; i < motion.model().lowerDeg.size(); ++i) {
        FricLevels[i] = best;
        if (!NoPrint)
            taskOf(task).controller().panel().writeLine(
                fmt::format("Axis {}: friction level {:g} %", i + 1, best));
    }
    return kOk;
}

Status rt_FricIdSetFricLevels(TaskCore* task, const float* FricLevels, int32_t FricLevelsDim1,
                              Handle* MechUnit) {
    if (const Status status = checkAxes(task, MechUnit, FricLevelsDim1)) return status;
    MotionDriver& motion = lib::motionOf(task);
    const std::size_t axes = motion.model().lowerDeg.size();
    for (std::size_t i = 0; i < axes; ++i)
        if (!(FricLevels[i] >= kLeastLevel && FricLevels[i] <= kMostLevel))
            return fatal(task, "friction levels lie within 1 to 500 percent");
    std::copy_n(FricLevels, axes, motion.service<FrictionLevels>().levels.begin());
    return kOk;
}
}
