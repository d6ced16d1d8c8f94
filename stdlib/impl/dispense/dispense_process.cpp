#include "stdlib/impl/dispense/dispense_process.h"

#include "stdlib/impl/motion/speed_outputs.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace rt::lib {
namespace {

using Kind = ProcessSignal::Kind;

enum Signal : std::size_t { On, Active, ErrorOut, Flow1, Flow2, ErrorIn };
constexpr ProcessSignal kSignals[] = {
    {"On", "doEqu{}On", Kind::Output},       {"Active", "doEqu{}Active", Kind::Output},
    {"Error", "doEqu{}Err", Kind::Output},   {"Flow1", "aoEqu{}F1", Kind::Reference},
    {"Flow2", "aoEqu{}F2", Kind::Reference}, {"EquipError", "diEqu{}Err", Kind::Input}};
constexpr int kMostEquipments = 4;
constexpr float kProportional = 2; // flow1_type

bool isFlowType(float type) {
    return type == 0 || type == 1 || type == kProportional;
}

} // namespace

DispenseProcess& DispenseProcess::of(TaskCore* task) {
    auto& process = motionOf(task).service<DispenseProcess>();
    if (process.task_ == nullptr) process.open(task);
    return process;
}

void DispenseProcess::open(TaskCore* task) {
    task_ = &taskOf(task);
    motion_ = &motionOf(task);
    motion_->addListener([this](ArmChange news) { take(news); });
    task_->controller().io().addListener(-1, [this](SignalId id, double, double) { inputChanged(id); });
}

Status DispenseProcess::prepare(TaskCore* task, const data::Beaddata& bead) {
    const float equipment = bead.equip_no;
    if (!(equipment >= 1 && equipment <= kMostEquipments && std::trunc(equipment) == equipment))
        return failWith(task, err::ERR_ARGVALERR, "equip_no of beaddata is {}, but must be from 1 to {}",
                        equipment, kMostEquipments);
    if (!isFlowType(bead.flow1_type) || !isFlowType(bead.flow2_type))
        return fail(task, err::ERR_ARGVALERR, "flow1_type and flow2_type of beaddata must be 0, 1 or 2");
    if (!std::isfinite(bead.flow1) || !std::isfinite(bead.flow2))
        return fail(task, err::ERR_ARGVALERR, "flow1 and flow2 of beaddata must be numbers");
    if (phase_ == Phase::On && equipment != bead_.equip_no)
        return fail(task, err::ERR_ARGVALERR,
                    "a bead cannot change its equipment (equip_no); end it with \\Off first");
    const std::string problem =
        signals_.read(taskOf(task).controller(), "DISP", static_cast<int>(equipment), kSignals);
    return problem.empty() ? kOk : fail(task, err::DISP_EQUIP_ERR, problem);
}

Status DispenseProcess::resume(TaskCore* task) {
    if (phase_ != Phase::Interrupted) return kOk;
    if (signals_.input(ErrorIn).value_or(false))
        return fail(task, err::DISP_EQUIP_ERR,
                    "the dispensing equipment still reports an error (input EquipError)");
    signals_.set(ErrorOut, 0);
    phase_ = Phase::On;
    flowOn();
    motion_->startMove();
    return kOk;
}

void DispenseProcess::begin(const data::Beaddata& bead, double speed) {
    bead_ = bead;
    speed_ = speed;
    phase_ = Phase::On;
    signals_.set(ErrorOut, 0);
    flowOn();
}

void DispenseProcess::end() {
    if (std::exchange(phase_, Phase::Off) == Phase::Off) return;
    flowOff();
    signals_.set(Active, 0);
}

void DispenseProcess::interrupt() {
    if (phase_ != Phase::On) return;
    phase_ = Phase::Interrupted;
    flowOff();
}

void DispenseProcess::flow(std::size_t signal, double value, double type) {
    const SignalId id = signals_.id(signal);
    if (id < 0) return;
    const bool follows = type == kProportional && speed_ > 0;
    bool& followed = follows_[signal - Flow1];
    // The scale 0 ends what followed the speed before.
    if (follows || followed)
        followSpeed(*task_, IoSystem::handleOf(id), {follows ? value / speed_ : 0, 0, 0});
    followed = follows;
    if (!follows) signals_.set(signal, type == 0 ? 0 : value);
}

void DispenseProcess::flowOn() {
    signals_.set(Active, 1);
    signals_.set(On, 1);
    flow(Flow1, bead_.flow1, bead_.flow1_type);
    flow(Flow2, bead_.flow2, bead_.flow2_type);
}

void DispenseProcess::flowOff() {
    signals_.set(On, 0);
    flow(Flow1, 0, 0);
    flow(Flow2, 0, 0);
}

/// The robot stops on its path, and the instruction in progress raises the error. RETRY continues the bead there.
void DispenseProcess::inputChanged(SignalId id) {
    if (phase_ != Phase::On || id != signals_.id(ErrorIn) || !signals_.input(ErrorIn).value_or(false)) return;
    interrupt();
    signals_.set(ErrorOut, 1);
    motion_->raiseProcessError(err::DISP_EQUIP_ERR);
}

/// A stop of the program interrupts the bead, and the start continues it.
void DispenseProcess::take(ArmChange news) {
    if (news == ArmChange::StopOnPath || news == ArmChange::MotorsOff) {
        if (phase_ != Phase::On) return;
        phase_ = Phase::Stopped;
        flowOff();
    } else if (news == ArmChange::Start && phase_ == Phase::Stopped) {
        phase_ = Phase::On;
        flowOn();
    }
}

void endBead(Task& task) {
    if (!task.isMotionTask()) return;
    auto& process = task.controller().motion(task).service<DispenseProcess>();
    process.end();
    process.setOrdered(false);
}

} // namespace rt::lib
