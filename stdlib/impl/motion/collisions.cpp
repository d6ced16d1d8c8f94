#include "stdlib/impl/motion/collisions.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace rt::lib {
namespace {

constexpr double kCollision = 20; // percent of the greatest torque, at a supervision level of 100 percent
constexpr Time kSettling = 100 * kMillisecond;  // of the arm at the end of a movement
constexpr double kBackoff = 2, kBackSpeed = 20; // mm, mm/s: away from what was hit

/// Supervision as MOC.cfg has it; MotionSup works within it (2.6).
struct Supervision {
    bool isOn = true;
    double level = 100, most = 300; ///< percent

    double levelWith(double tuned) const { return std::min(level * tuned / 100, most); }
};

/// MOTION_SUP that the planner of a motion group names; controllers name them rob1, rob2 ...
Supervision supervisionOf(const Controller& controller, std::size_t group) {
    std::string name = fmt::format("rob{}", group + 1);
    const std::string planner = fmt::format("motion_planner_{}", group + 1);
    for (const auto* instance : controller.instances("MOC", "MOTION_PLANNER"))
        if (sameName(instance->text("name"), planner)) name = instance->text("use_motion_sup", name);
    Supervision supervision;
    for (const auto* instance : controller.instances("MOC", "MOTION_SUP")) {
        if (!sameName(instance->text("name"), name)) continue;
        supervision.isOn = instance->flag("path_col_detect_on");
        instance->number("path_col_detect_level", supervision.level);
        instance->number("motion_sup_max_level", supervision.most);
    }
    return supervision;
}

/// A service of the motion group.
class CollisionWatch {
  public:
    /// From the first torque on; `look` again after each.
    void look(Controller& controller, MotionDriver& motion) {
        if (std::exchange(motion_, &motion) == nullptr) {
            controller_ = &controller;
            supervision_ = supervisionOf(controller, motion.group());
            motion.addListener([this](ArmChange news) { take(news); });
        }
        check();
    }
    void allowContact(Controller& controller, bool allowed) {
        ++orders_;
        if (allowed) {
            allowed_ = true;
            return;
        }
        controller.scheduler().after(kSettling, [this, order = orders_] {
            if (order != orders_) return;
            allowed_ = false;
            if (motion_ != nullptr) check();
        });
    }

  private:
    void take(ArmChange news) {
        if (news != ArmChange::Event) return;
        if (backsOff_ && !motion_->system().isMoving()) {
            backsOff_ = false;
            if (motion_->system().stepBack(kBackoff, kBackSpeed)) {
                isBacking_ = true;
                motion_->refresh();
            }
            return;
        }
        if (isBacking_ && !motion_->system().isMoving()) isBacking_ = false;
        check();
    }

    /// An arm that is at rest or already brakes does not collide any more.
    bool isHit(std::size_t& axis) {
        const auto& state = motion_->service<MotionState>();
        if (!supervision_.isOn || !state.motionSupervision || allowed_ || isBacking_ ||
            !motion_->system().isMoving() || motion_->isStopMoveActive())
            return false;
        return largestExternalTorque(*controller_, *motion_, axis) >=
               kCollision * supervision_.levelWith(state.supervisionLevel) / 100;
    }

    /// A torque counts when it lasts for a period: what a movement that begins wants is known by then.
    void check() {
        std::size_t axis = 0;
        if (isSuspicious_ || !isHit(axis)) return;
        isSuspicious_ = true;
        controller_->scheduler().after(motion::kModifierPeriod, [this] {
            isSuspicious_ = false;
            confirm();
        });
    }

    void confirm() {
        std::size_t axis = 0;
        if (!isHit(axis)) return;
        controller_->log().write(EventId::Collision, nullptr,
                                 {std::to_string(axis + 1), motion_->unitName()});
        backsOff_ = motion_->service<MotionState>().backsOff;
        motion_->raiseProcessError(err::ERR_COLL_STOP);
    }

    Controller* controller_ = nullptr;
    MotionDriver* motion_ = nullptr;
    Supervision supervision_;
    bool allowed_ = false, backsOff_ = false, isBacking_ = false, isSuspicious_ = false;
    uint64_t orders_ = 0; // of allowContact
};

} // namespace

void superviseCollisions(Controller& controller) {
    controller.service<Surroundings>().addListener([&controller](const Surroundings::Name& name, double) {
        constexpr std::string_view kQuantity = Surroundings::kExternalTorque;
        if (!sameName(std::string_view(name.quantity).substr(0, kQuantity.size()), kQuantity)) return;
        for (const auto& motion : controller.motions())
            if (sameName(motion->unitName(), name.unit))
                motion->service<CollisionWatch>().look(controller, *motion);
    });
}

void allowContact(Controller& controller, MotionDriver& motion, bool allowed) {
    motion.service<CollisionWatch>().allowContact(controller, allowed);
}

double largestExternalTorque(Controller& controller, const MotionDriver& motion, std::size_t& axis) {
    double largest = 0;
    const robot::RobotModel& model = motion.model();
    for (std::size_t i = 0; i < model.lowerDeg.size(); ++i) {
        const double torque = std::abs(externalTorque(controller, motion, i));
        if (!(torque > 0)) continue;
        const double percent = 100 * torque / greatestTorque(model, i);
        if (percent <= largest) continue;
        largest = percent;
        axis = i;
    }
    return largest;
}

} // namespace rt::lib
