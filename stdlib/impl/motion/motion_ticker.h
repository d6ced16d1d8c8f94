#pragma once
// MotionTicker: looks at the arm after every motion event, and in the period of motion (MotionDriver::tick) while it moves.

#include "runtime/host/controller.h"

#include <functional>

namespace rt::lib {

class MotionTicker {
  public:
    /// `look` returns whether it wants to be called again while the arm moves. The first call takes effect; the arm has to
    /// outlive this, as it does for its services.
    void start(Controller& controller, MotionDriver& motion, std::function<bool()> look);
    bool isStarted() const { return motion_ != nullptr; }
    /// Looks now.
    void look();

  private:
    Controller* controller_ = nullptr;
    MotionDriver* motion_ = nullptr;
    std::function<bool()> look_;
    EventToken tick_ = 0;
};

} // namespace rt::lib
