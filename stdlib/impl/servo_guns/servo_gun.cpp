#include "stdlib/impl/servo_guns/servo_gun.h"

#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/fail.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include "stdlib_constants.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace rt::lib {
namespace {

constexpr double kFast = 5000, kSlow = 20; // mm/s; the limits of the axis hold
constexpr Time kRamp = 100 * kMillisecond; // of the force

} // namespace

ServoGun::ServoGun(Controller& controller, MechanicalUnit& unit, GunSetup setup)
    : controller_(controller), unit_(unit), setup_(std::move(setup)),
      motion_(*controller.motions()[unit.group]) {
    motion_.addListener([this](ArmChange news) { take(news); });
    auto& around = controller.service<Surroundings>();
    isInitialized_ = around.value(unit.name, Surroundings::kInitialized, 1) != 0;
    isSynchronized_ = around.value(unit.name, Surroundings::kSynchronized, 1) != 0;
    around.addListener([this](const Surroundings::Name& name, double value) {
        if (!sameName(name.unit, unit_.name)) return;
        if (sameName(name.quantity, Surroundings::kInitialized)) isInitialized_ = value != 0;
        if (sameName(name.quantity, Surroundings::kSynchronized)) isSynchronized_ = value != 0;
    });
}

double ServoGun::wear() const {
    return controller_.service<Surroundings>().value(unit_.name, Surroundings::kTipWear);
}

void ServoGun::enter(Phase phase) {
    phase_ = phase;
    changed_.notifyAll();
}

/// Motors that go off end the force, and the movement is an error although it continues later.
void ServoGun::take(ArmChange news) {
    if (news != ArmChange::MotorsOff && news != ArmChange::PowerFailed) return;
    if (news == ArmChange::MotorsOff && phase_ == Phase::Open) return;
    if (news == ArmChange::PowerFailed && interrupted_ == kOk) return;
    interrupted_ = news == ArmChange::MotorsOff ? err::ERR_SGUN_ESTOP : err::ERR_SGUN_MOTOFF;
    controller_.scheduler().cancel(std::exchange(ready_, 0));
    if (phase_ == Phase::Building || phase_ == Phase::Closed) enter(Phase::Open);
}

/// The gun has met the sheet.
void ServoGun::met() {
    if (interrupted_ != kOk) return enter(Phase::Open);
    enter(Phase::Building);
    const auto ramp = static_cast<Time>(static_cast<double>(kRamp) * rampPercent_ / 100);
    ready_ = controller_.scheduler().after(addTime(ramp, fromSeconds(setup_.readyDelay)), [this] {
        ready_ = 0;
        enter(Phase::Closed);
    });
}

Status ServoGun::order(TaskCore* task, double position, double speed, bool conc,
                       std::function<void()> atEnd) {
    const MotionState& state = motionState(task);
    const data::Tooldata tool = state.tool;
    const data::Wobjdata workObject = state.workObject;
    const auto mmPerSecond = static_cast<float>(speed);
    const data::Speeddata speeds{mmPerSecond, 500, mmPerSecond, 1000};
    static const data::Zonedata kFine{true, 0, 0, 0, 0, 0, 0};
    data::Jointtarget target{{0, 0, 0, 0, 0, 0}, {9e9F, 9e9F, 9e9F, 9e9F, 9e9F, 9e9F}};
    float* const axes[] = {&target.extax.eax_a, &target.extax.eax_b, &target.extax.eax_c,
                           &target.extax.eax_d, &target.extax.eax_e, &target.extax.eax_f};
    *axes[unit_.own.front().index] = static_cast<float>(position);
    MoveArguments move;
    move.conc = conc;
    move.speed = &speeds;
    move.zone = &kFine;
    move.tool = &tool;
    move.workObject = &workObject;
    move.movesGun = true;
    PathAction end;
    end.act = std::move(atEnd);
    std::vector<PathAction> actions;
    actions.push_back(std::move(end));
    return orderMove(task, externalMove(task, target, false, nullptr), move, std::move(actions));
}

/// As long as an instruction lasts that ends with its movement.
class ServoGun::Awaited {
  public:
    Awaited(ServoGun& gun, bool conc) : gun_(gun) { gun_.isAwaited_ = !conc; }
    ~Awaited() { gun_.isAwaited_ = false; }
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;

  private:
    ServoGun& gun_;
};

/// A movement begins, unless an earlier process ended in it.
Status ServoGun::begin(TaskCore* task, Phase phase) {
    if (std::exchange(wasCutOff_, false))
        return fail(task, err::ERR_SGUN_MOTOFF, "the motors went off during the movement of the servo gun");
    interrupted_ = kOk;
    enter(phase);
    return kOk;
}

/// Until the gun is in this phase, or the motors' end has taken it out of its movement.
Status ServoGun::waitPhase(TaskCore* task, Phase phase) {
    WaitSpec spec;
    spec.queues = {&changed_};
    spec.condition = [this, phase] { return phase_ == phase || interrupted_ != kOk; };
    WaitResult result{};
    if (const Status status = taskOf(task).waitFor(spec, result)) return status;
    const Status why = std::exchange(interrupted_, kOk);
    if (why == kOk) return kOk;
    return fail(task, why,
                why == err::ERR_SGUN_ESTOP ? "an emergency stop interrupted the movement of the servo gun"
                                           : "the motors went off during the movement of the servo gun");
}

Status ServoGun::close(TaskCore* task, double expected, bool conc) {
    if (const Status status = begin(task, Phase::Closing)) return status;
    const Awaited awaited(*this, conc);
    const double sheet =
        controller_.service<Surroundings>().value(unit_.name, Surroundings::kThickness, expected);
    thickness_ = std::max(sheet - (wear() - wearKnown_), 0.0);
    openAt_ = motion_.system().plannedEnd().extax[unit_.own.front().index];
    if (const Status status = order(task, thickness_, kFast, conc, [this] { met(); })) {
        enter(Phase::Open);
        return status;
    }
    return conc ? kOk : waitPhase(task, Phase::Closed);
}

Status ServoGun::open(TaskCore* task, bool conc) {
    if (const Status status = begin(task, Phase::Opening)) return status;
    const Awaited awaited(*this, conc);
    controller_.scheduler().cancel(std::exchange(ready_, 0));
    if (const Status status = order(task, openAt_, kFast, conc, [this] { enter(Phase::Open); }))
        return status;
    return conc ? kOk : waitPhase(task, Phase::Open);
}

Status ServoGun::calibrate(TaskCore* task, Calibration kind, double prePos, bool conc) {
    if (const Status status = begin(task, Phase::Calibrating)) return status;
    const Awaited awaited(*this, conc);
    const double from = motion_.system().plannedEnd().extax[unit_.own.front().index];
    const auto found = [this, kind] {
        if (interrupted_ != kOk) return;
        isSynchronized_ = true;
        adjustment_ = wear() - wearKnown_;
        wearKnown_ = wear();
        if (kind != Calibration::TipWear) wearBase_ = wearKnown_;
        tipWear_ = wearKnown_ - wearBase_;
    };
    Status status = kOk;
    if (prePos >= 0) status = order(task, prePos, kFast, conc, [] {});
    if (status == kOk && interrupted_ == kOk) status = order(task, 0, kSlow, conc, found);
    if (status == kOk && interrupted_ == kOk)
        status = order(task, from, kFast, conc, [this] { enter(Phase::Open); });
    if (status != kOk || interrupted_ != kOk) enter(Phase::Open);
    return status != kOk || conc ? status : waitPhase(task, Phase::Open);
}

Status ServoGun::moveAlone(TaskCore* task, double position) {
    motionState(task).independentExternal.set(unit_.own.front().index);
    return order(task, position, kFast, true, [] {});
}

bool ServoGun::isIndependent() const {
    return motion_.service<MotionState>().independentExternal[unit_.own.front().index];
}

void ServoGun::endIndependence() {
    motion_.service<MotionState>().independentExternal.reset(unit_.own.front().index);
}

void ServoGun::reset() {
    wasCutOff_ = false;
    if (phase_ == Phase::Building || phase_ == Phase::Closed) return;
    interrupted_ = kOk;
    enter(Phase::Open);
}

void ServoGuns::reset() {
    for (const auto& [unit, gun] : guns_)
        if (gun) gun->reset();
}

ServoGun* ServoGuns::find(Controller& controller, std::string_view unit) {
    MechanicalUnit* found = controller.units().find(unit);
    if (found == nullptr) return nullptr;
    const auto known = guns_.find(found);
    if (known != guns_.end()) return known->second.get();
    std::unique_ptr<ServoGun>& gun = guns_[found];
    if (auto setup = gunSetup(controller, *found))
        gun = std::make_unique<ServoGun>(controller, *found, std::move(*setup));
    return gun.get();
}

} // namespace rt::lib
