// Manual 1.7, 1.8: the system variables that tell which settings are in force and which robot the task controls.

#include "runtime/abi/support_natives.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"

#include "runtime/base/text_util.h"

#include <algorithm>
#include <cstring>

using namespace rt;

namespace {

constexpr float kNoLimit = -1; // what a limit is that is switched off

/// Handle of the robot that the task controls; 0 for none.
Handle robotOf(const Task& task) {
    if (!lib::movesRobot(task)) return 0;
    const auto& units = task.controller().units().all();
    const auto found = std::find_if(units.begin(), units.end(), [&](const auto& unit) {
        return unit->isRobot && static_cast<int>(unit->group) == task.motionGroup();
    });
    return found == units.end() ? 0 : static_cast<Handle>(found - units.begin()) + 1;
}

float limitOr(double limit) {
    return limit > 0 ? static_cast<float>(limit) : kNoLimit;
}

data::Motsetdata motionSettings(const lib::MotionState& state, double maxRobotSpeed) {
    const motion::MotionSettings& s = state.settings;
    data::Motsetdata out{};
    out.vel = {static_cast<float>(s.velocityPercent),
               static_cast<float>(std::min(s.maxTcpSpeed, maxRobotSpeed))};
    out.acc = {static_cast<float>(s.accelerationPercent), static_cast<float>(s.rampPercent),
               static_cast<float>(s.finePointRampPercent)};
    const bool deviates = state.singWrist || state.singLockAxis4;
    out.sing = {state.singWrist, state.singLockAxis4, false, !deviates};
    out.conf.jsup = state.confJ;
    out.conf.lsup = state.confL;
    out.pathresol = static_cast<float>(state.pathResolution);
    out.motionsup = state.motionSupervision;
    out.tunevalue = static_cast<float>(state.supervisionLevel);
    out.acclim = s.pathAcceleration > 0;
    out.accmax = limitOr(s.pathAcceleration);
    out.decellim = s.pathDeceleration > 0;
    out.decelmax = limitOr(s.pathDeceleration);
    out.cirpathreori = static_cast<float>(state.circleOrientation); // numbered in the order of the switches
    out.worldacclim = s.worldAcceleration > 0;
    out.worldaccmax = limitOr(s.worldAcceleration);
    out.evtbufferact = state.eventBuffer;
    return out;
}

data::Progdisp displacement(const lib::MotionState& state) {
    data::Progdisp out{};
    out.pdisp = lib::toPose(state.displacement);
    float* const axes[] = {&out.eoffs.eax_a, &out.eoffs.eax_b, &out.eoffs.eax_c,
                           &out.eoffs.eax_d, &out.eoffs.eax_e, &out.eoffs.eax_f};
    for (size_t i = 0; i < state.axisOffsets.size(); ++i)
        *axes[i] = static_cast<float>(state.axisOffsets[i]);
    return out;
}

} // namespace

extern "C" Status rt_systemData(TaskCore* task, void* data, const String* name) {
    Task& owner = taskOf(task);
    const lib::MotionState& state = lib::motionState(task);
    if (sameName(name->view(), "C_MOTSET")) {
        const double most = owner.controller().motion(owner).system().model().maxTcpSpeed;
        const data::Motsetdata settings = motionSettings(state, most);
        std::memcpy(data, &settings, sizeof settings);
        return kOk;
    }
    if (sameName(name->view(), "C_PROGDISP")) {
        const data::Progdisp value = displacement(state);
        std::memcpy(data, &value, sizeof value);
        return kOk;
    }
    if (sameName(name->view(), "ROB_ID")) {
        const Handle unit = robotOf(owner);
        std::memcpy(data, &unit, sizeof unit);
        return kOk;
    }
    return rt_notImplemented(task, name);
}
