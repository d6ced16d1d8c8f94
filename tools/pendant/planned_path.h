#pragma once
// PlannedPath: the movements of a robot that are ordered and not finished, as points to draw. On the controller's thread.

#include "runtime/host/motion_driver.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::pendant {

class PlannedPath {
  public:
    struct Move {
        motion::MoveId id = 0;
        motion::MoveKind kind = motion::MoveKind::AbsJoint;
        std::vector<robot::Vec3> points; ///< TCP in world, from beginning to end
        robot::Pose to;                  ///< TCP in world
        std::string module;
        uint32_t line = 0; ///< of the instruction; 0: not known
    };

    /// Notes every movement that is ordered from now on, as long as this object lives.
    explicit PlannedPath(rt::MotionDriver& motion);
    PlannedPath(const PlannedPath&) = delete;
    PlannedPath& operator=(const PlannedPath&) = delete;

    /// Those that are not finished, in order.
    const std::deque<Move>& moves();

  private:
    static constexpr std::size_t kMost = 256;
    void note(const rt::MotionDriver::Ordered& ordered);
    void dropFinished();

    rt::MotionDriver& motion_;
    std::deque<Move> moves_;
    std::shared_ptr<int> alive_ = std::make_shared<int>(0); ///< the driver keeps its listeners
};

} // namespace rapidc::pendant
