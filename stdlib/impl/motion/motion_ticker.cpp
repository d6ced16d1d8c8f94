#include "stdlib/impl/motion/motion_ticker.h"

#include <utility>

namespace rt::lib {

void MotionTicker::start(Controller& controller, MotionDriver& motion, std::function<bool()> look) {
    if (isStarted()) return;
    controller_ = &controller;
    motion_ = &motion;
    look_ = std::move(look);
    motion.addListener([this](ArmChange) { this->look(); });
}

void MotionTicker::look() {
    if (!look_() || tick_ != 0 || !motion_->system().isMoving()) return;
    Scheduler& clock = controller_->scheduler();
    const Time next = (clock.now() / motion_->tick() + 1) * motion_->tick();
    tick_ = clock.at(next, [this] {
        tick_ = 0;
        look();
    });
}

} // namespace rt::lib
