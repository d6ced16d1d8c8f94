#include "stdlib/impl/motion/collisions.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

namespace rt::lib {
namespace {

constexpr double kCollision = 20; // percent of the greatest torque, at a supervision level of 100 percent
constexpr Time kSettling = 100 * kMillisecond;  // of the arm at the end of a movement
constexpr Time kPeriod = 4 * kMillisecond;      // of the supervision
constexpr double kBackoff = 2, kBackSpeed = 20; // mm, mm/s: away from what was hit

/// A service of the motion group.
class CollisionWatch {
  public:
    /// From the first torque on; `look` again after each.
    void look(Controller& controller, MotionDriver& motion) {
        if (std::exchange(motion_, &motion) == nullptr) {
            controller_ = &controller;
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
        if (!state.motionSupervision || allowed_ || isBacking_ || !motion_->system().isMoving() ||
            motion_->isStopMoveActive())
            return false;
        return largestExternalTorque(*controller_, *motion_, axis) >=
               kCollision * state.supervisionLevel / 100;
    }

    /// A torque counts when it lasts for a period: what a movement that begins wants is known by then.
    void check() {
        std::size_t axis = 0;
        if (isSuspicious_ || !isHit(axis)) return;
        isSuspicious_ = true;
        controller_->scheduler().after(kPeriod, [this] {
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
