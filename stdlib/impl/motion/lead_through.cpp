// Lead-through: the arm gives way to a hand. The simulated arm is not led, which keeps its place; the program sees the same
// states, and the path is stopped, thrown away and released as on a controller.

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "natives/additional.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

/// A service of the motion group.
class LeadThrough {
  public:
    void set(MotionDriver& motion, bool on) {
        isSet_ = on;
        if (isListening_) return;
        isListening_ = true;
        motion.addListener([this](ArmChange news) {
            if (news == ArmChange::MotorsOff) isSet_ = false;
        });
    }
    bool isSet() const { return isSet_; }
    /// The arm has to stand before it gives way.
    bool isActive(const MotionDriver& motion) const { return isSet_ && !motion.isMoving(); }

  private:
    bool isSet_ = false, isListening_ = false;
};

} // namespace

extern "C" {

/// Without a switch: on. The motors going off ends it.
Status rt_SetLeadThrough(TaskCore* task, bool On, bool Off, bool NoStopMove, bool NoStartMove,
                         bool NoClearPath) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (On && Off) return lib::fail(task, err::ERR_ARGVALERR, "SetLeadThrough takes one of \\On and \\Off");
    if (!Off && (NoStartMove || NoClearPath))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "SetLeadThrough: \\NoStartMove and \\NoClearPath are for \\Off only");
    if (Off && NoStopMove)
        return lib::fail(task, err::ERR_ARGVALERR, "SetLeadThrough: \\NoStopMove is for \\On only");
    MotionDriver& motion = lib::motionOf(task);
    motion.service<LeadThrough>().set(motion, !Off);
    if (!Off) {
        if (!NoStopMove) motion.stopMove();
        return kOk;
    }
    if (!NoClearPath) motion.clearLevel();
    if (!NoStartMove) motion.startMove();
    return kOk;
}

Status rt_IsLeadThrough(TaskCore* task, bool* result, Handle* MecUnit, bool, bool Set) {
    MotionDriver* motion = &lib::motionOf(task);
    if (MecUnit != nullptr) {
        Status status = kOk;
        const MechanicalUnit* unit = lib::unitOf(task, *MecUnit, status);
        if (unit == nullptr) return status;
        motion = taskOf(task).controller().motions()[unit->group].get();
    }
    const auto& state = motion->service<LeadThrough>();
    *result = Set ? state.isSet() : state.isActive(*motion);
    return kOk;
}
}
