// ContactL: a line that ends where the robot meets something. Contact is a torque from outside on some axis (collisions.h).

#include "stdlib/impl/motion/collisions.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/fail.h"

#include "runtime/sim/surroundings.h"

#include "natives/additional.h"
#include "stdlib_constants.h"

#include <memory>
#include <utility>

using namespace rt;

namespace {

/// Looks for contact while the movement runs.
class ContactWatch {
  public:
    ContactWatch(Controller& controller, MotionDriver& motion, double percent)
        : controller_(controller), motion_(motion), percent_(percent) {}
    ~ContactWatch() { end(); }
    ContactWatch(const ContactWatch&) = delete;
    ContactWatch& operator=(const ContactWatch&) = delete;

    void begin() {
        if (isOver_ || listener_ != 0) return;
        level_ = motion_.pathLevel();
        listener_ = surroundings().addListener([this](const Surroundings::Name&, double) { look(); });
        look();
    }
    void end() {
        isOver_ = true;
        if (listener_ != 0) surroundings().removeListener(std::exchange(listener_, 0));
    }
    bool wasHit() const { return hit_; }

  private:
    Surroundings& surroundings() { return controller_.service<Surroundings>(); }
    void look() {
        std::size_t axis = 0;
        if (hit_ || motion_.pathLevel() != level_ ||
            lib::largestExternalTorque(controller_, motion_, axis) < percent_)
            return;
        hit_ = true;
        motion_.breakOff(BreakOff::OnPath);
    }

    Controller& controller_;
    MotionDriver& motion_;
    double percent_;
    uint64_t listener_ = 0;
    int level_ = 0;
    bool hit_ = false, isOver_ = false;
};

PathAction actionAt(bool start, std::function<void()> act) {
    PathAction action;
    action.place.fromStart = start;
    action.act = std::move(act);
    return action;
}

/// With contact as the goal: positive without an error means that it was found.
Status seekContact(TaskCore* task, motion::MoveCommand command, const lib::MoveArguments& move,
                   double percent) {
    Task& owner = taskOf(task);
    MotionDriver& driver = owner.controller().motion(owner);
    const auto watch = std::make_shared<ContactWatch>(owner.controller(), driver, percent);
    if (driver.continuesMovement(owner)) watch->begin();
    lib::allowContact(owner.controller(), driver, true);
    std::vector<PathAction> actions;
    actions.push_back(actionAt(true, [watch] { watch->begin(); }));
    Status status = lib::orderMove(task, std::move(command), move, std::move(actions));
    watch->end();
    if (status == kOk && watch->wasHit()) status = driver.waitZeroSpeed(owner);
    lib::allowContact(owner.controller(), driver, false);
    if (status != kOk || watch->wasHit()) return status;
    return lib::fail(task, err::ERR_CONTACTL, "the robot reached the end of the movement without contact");
}

} // namespace

extern "C" {

Status rt_ContactL(TaskCore* task, const float* DesiredTorque, const data::Robtarget* ToPoint,
                   const float* ID, const data::Speeddata* Speed, const data::Zonedata* Zone,
                   data::Tooldata* Tool, data::Wobjdata* WObj) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    static const data::Zonedata kFine{true, 0, 0, 0, 0, 0, 0};
    if (DesiredTorque != nullptr && !(*DesiredTorque > 0))
        return lib::fail(task, err::ERR_ARGVALERR, "ContactL: \\DesiredTorque must be above 0 percent");
    MotionDriver& driver = lib::motionOf(task);
    lib::MoveArguments move;
    move.speed = Speed;
    move.tool = Tool;
    move.workObject = WObj;
    move.zone = Zone != nullptr && DesiredTorque == nullptr ? Zone : &kFine;
    motion::MoveCommand command = lib::linearMove(task, *ToPoint, ID);
    if (DesiredTorque != nullptr && !driver.isBackward())
        return seekContact(task, std::move(command), move, *DesiredTorque);
    Controller& controller = taskOf(task).controller();
    std::vector<PathAction> actions;
    actions.push_back(
        actionAt(true, [&controller, &driver] { lib::allowContact(controller, driver, true); }));
    actions.push_back(
        actionAt(false, [&controller, &driver] { lib::allowContact(controller, driver, false); }));
    return lib::orderMove(task, std::move(command), move, std::move(actions));
}

/// The movement of MoveL.
Status rt_PaintL(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                 const data::Speeddata* Speed, const data::Zonedata* Zone, data::Tooldata* Tool,
                 data::Wobjdata* WObj) {
    lib::MoveArguments move;
    move.speed = Speed;
    move.zone = Zone;
    move.tool = Tool;
    move.workObject = WObj;
    return lib::orderMove(task, lib::linearMove(task, *ToPoint, ID), move);
}
}
