// PathLengthStart and its like: how far the TCP has moved. Counted in the period of the trace while the arm moves, so a bend
// counts as its chords.

#include "stdlib/impl/motion/motion_ticker.h"
#include "stdlib/impl/motion/state.h"

#include "natives/additional.h"

using namespace rt;

namespace {

class PathLength {
  public:
    void start(Controller& controller, MotionDriver& motion) {
        motion_ = &motion;
        ticker_.start(controller, motion, [this] { return count(); });
        isOn_ = true;
        last_ = tcp();
    }
    void stop() {
        count();
        isOn_ = false;
    }
    void reset() {
        length_ = 0;
        if (isOn_) last_ = tcp();
    }
    double length() {
        count();
        return length_;
    }

  private:
    motion::Vec3 tcp() const { return motion_->system().current().tcp.pos; }

    bool count() {
        if (!isOn_) return false;
        const motion::Vec3 here = tcp();
        length_ += norm(here - last_);
        last_ = here;
        return true;
    }

    lib::MotionTicker ticker_;
    MotionDriver* motion_ = nullptr; // known from the first start on
    motion::Vec3 last_;
    double length_ = 0; // mm
    bool isOn_ = false;
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
    pathLengthOf(task).stop();
    return kOk;
}

Status rt_PathLengthReset(TaskCore* task) {
    pathLengthOf(task).reset();
    return kOk;
}

Status rt_PathLengthGet(TaskCore* task, float* result) {
    *result = static_cast<float>(pathLengthOf(task).length());
    return kOk;
}
}
