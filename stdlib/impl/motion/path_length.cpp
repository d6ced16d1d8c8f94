// PathLengthStart and its like: how far the TCP has moved. Counted in the period of the trace while the arm moves, so a bend
// counts as its chords.

#include "stdlib/impl/motion/state.h"

#include "stdlib_natives.h"

using namespace rt;

namespace {

constexpr Time kPeriod = 4 * kMillisecond;

class PathLength {
  public:
    void start(Controller& controller, MotionDriver& motion) {
        if (motion_ == nullptr) {
            motion_ = &motion;
            motion.addListener([this, &controller](ArmNews) { count(controller); });
        }
        isOn_ = true;
        last_ = tcp();
    }
    void stop(Controller& controller) {
        count(controller);
        isOn_ = false;
    }
    void reset() {
        length_ = 0;
        if (isOn_) last_ = tcp();
    }
    double length(Controller& controller) {
        count(controller);
        return length_;
    }

  private:
    motion::Vec3 tcp() const { return motion_->system().current().tcp.pos; }

    void count(Controller& controller) {
        if (!isOn_) return;
        const motion::Vec3 here = tcp();
        length_ += norm(here - last_);
        last_ = here;
        if (tick_ != 0 || !motion_->system().isMoving()) return;
        const Time next = (controller.scheduler().now() / kPeriod + 1) * kPeriod;
        tick_ = controller.scheduler().at(next, [this, &controller] {
            tick_ = 0;
            count(controller);
        });
    }

    MotionDriver* motion_ = nullptr; // known from the first start on
    motion::Vec3 last_;
    double length_ = 0; // mm
    bool isOn_ = false;
    EventToken tick_ = 0;
};

PathLength& pathLengthOf(TaskCore* task) {
    return lib::motionOf(task).service<PathLength>();
}

} // namespace

extern "C" {

Status rt_PathLengthStart(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    pathLengthOf(task).start(taskOf(task).controller(), lib::motionOf(task));
    return kOk;
}

Status rt_PathLengthStop(TaskCore* task) {
    pathLengthOf(task).stop(taskOf(task).controller());
    return kOk;
}

Status rt_PathLengthReset(TaskCore* task) {
    pathLengthOf(task).reset();
    return kOk;
}

Status rt_PathLengthGet(TaskCore* task, float* result) {
    *result = static_cast<float>(pathLengthOf(task).length(taskOf(task).controller()));
    return kOk;
}
}
