#include "stdlib/impl/arc/arc_process.h"
#include "stdlib/impl/arc/weave_pattern.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

namespace rt::lib {
namespace {

/// The inputs that are 1 while the equipment is in order, and what each of them means.
constexpr std::pair<ArcInput, const char*> kSupervised[] = {
    {ArcInput::GasOk, "gas"},   {ArcInput::WaterOk, "cooling water"}, {ArcInput::WireOk, "wire"},
    {ArcInput::GunOk, "torch"}, {ArcInput::VoltOk, "voltage"},        {ArcInput::CurrentOk, "current"}};

/// Voltage and current are there only while the arc is on.
bool isBeforeArc(ArcInput input) {
    return input != ArcInput::VoltOk && input != ArcInput::CurrentOk;
}

Status checkTimes(TaskCore* task, const data::Seamdata& seam) {
    for (const float time :
         {seam.purge_time, seam.preflow_time, seam.ign_move_delay, seam.heat_time, seam.cool_time,
          seam.fill_time, seam.bback_time, seam.rback_time, seam.postflow_time})
        if (!(time >= 0 && std::isfinite(time)))
            return fail(task, err::ERR_ARGVALERR,
                        "the times of seamdata must be numbers of seconds from 0 on");
    return kOk;
}

} // namespace

ArcProcess& ArcProcess::of(TaskCore* task) {
    auto& process = motionOf(task).service<ArcProcess>();
    if (process.controller_ == nullptr) process.open(task);
    return process;
}

void ArcProcess::open(TaskCore* task) {
    controller_ = &taskOf(task).controller();
    motion_ = &motionOf(task);
    weaving_ = std::make_shared<motion::Weaving>();
    motion_->system().addModifier(weaving_);
    motion_->addListener([this](ArmChange news) { take(news); });
    controller_->io().addListener(-1, [this](SignalId id, double, double) { inputChanged(id); });
}

double ArcProcess::speed(const data::Welddata& weld) const {
    return refreshedSpeed_ > 0 ? refreshedSpeed_ : weld.weld_speed;
}

Status ArcProcess::prepare(TaskCore* task, int system, const data::Seamdata& seam, data::Welddata* weld) {
    kill();
    if (const Status status = checkTimes(task, seam)) return status;
    if (const std::string problem = equipment_.read(*controller_, system); !problem.empty())
        return taskOf(task).fatal(static_cast<int>(EventId::ArcMisused), problem);
    system_ = system;
    weaving_->restart();
    weaves_.clear();
    seam_ = seam;
    weld_ = weld;
    refreshedSpeed_ = 0;
    refreshedWidth_.reset();
    inhibited_ = equipment_.input(ArcInput::WeldInhib).value_or(false);
    phase_ = Phase::Preparing;
    return kOk;
}

void ArcProcess::openGas() {
    if (inhibited_ || gasSince_ != kNever || phase_ == Phase::Off) return;
    gasSince_ = controller_->scheduler().now();
    equipment_.set(ArcOutput::GasOn, true);
}

Status ArcProcess::checkEquipment(TaskCore* task, Status error) const {
    if (equipment_.input(ArcInput::StopProc).value_or(false))
        return fail(task, err::AW_STOP_ERR, "the input StopProc of the arc equipment is set");
    for (const auto& [input, what] : kSupervised)
        if (isBeforeArc(input) && !equipment_.input(input).value_or(true))
            return fail(task, error, fmt::format("the supervision of the {} is not in order", what));
    return kOk;
}

Status ArcProcess::ignite(TaskCore* task, Status notReady) {
    if (inhibited_) {
        phase_ = Phase::Welding;
        return kOk;
    }
    Task& owner = taskOf(task);
    openGas();
    Status status = owner.sleepUntil(addTime(gasSince_, fromSeconds(gasTime())));
    if (status == kOk) status = checkEquipment(task, notReady);
    if (status != kOk) {
        kill();
        return status;
    }
    arcOn(seam_.ign_arc);
    if (const SignalId arc = equipment_.idOf(ArcInput::ArcEst); arc >= 0) {
        WaitSpec spec;
        spec.queues = {&controller_->io().changed(arc)};
        spec.condition = [this] { return equipment_.input(ArcInput::ArcEst).value_or(true); };
        spec.deadline = addTime(owner.now(), equipment_.ignitionTime());
        WaitResult result{};
        status = owner.waitFor(spec, result);
        if (status == kOk && result == WaitResult::Timeout)
            status = fail(task, err::AW_IGNI_ERR,
                          fmt::format("the arc was not established within {:g} s (input ArcEst)",
                                      toSeconds(equipment_.ignitionTime())));
    }
    if (status == kOk) status = owner.sleepFor(fromSeconds(seam_.ign_move_delay));
    if (status == kOk && seam_.heat_time > 0) {
        apply(seam_.heat_arc);
        status = owner.sleepFor(fromSeconds(seam_.heat_time));
    }
    if (status != kOk) {
        kill();
        return status;
    }
    phase_ = Phase::Welding;
    weaving_->setOn(true);
    established_ = equipment_.input(ArcInput::ArcEst).value_or(false);
    weldWith(weld_);
    return kOk;
}

Status ArcProcess::resume(TaskCore* task) {
    if (phase_ != Phase::Interrupted) return kOk;
    phase_ = Phase::Preparing;
    if (const Status status = ignite(task, err::AW_EQIP_ERR)) {
        if (phase_ == Phase::Off) phase_ = Phase::Interrupted; // RETRY ignites once more
        return status;
    }
    equipment_.set(ArcOutput::AwError, false);
    motion_->startMove();
    return kOk;
}

void ArcProcess::weldWith(data::Welddata* weld) {
    weld_ = weld;
    if (phase_ == Phase::Welding && !stopped_) apply(weld->main_arc);
}

Status ArcProcess::close(TaskCore* task, const data::Seamdata& seam) {
    if (const Status status = checkTimes(task, seam)) return status;
    phase_ = Phase::Closing; // supervised no more
    Task& owner = taskOf(task);
    Status status = kOk;
    // In the order of the weld: what is on, and for how long.
    const auto wait = [&](float seconds) {
        if (status == kOk && seconds > 0) status = owner.sleepFor(fromSeconds(seconds));
    };
    if (!inhibited_) {
        if (seam.cool_time > 0) {
            arcOff();
            wait(seam.cool_time);
        }
        if (seam.fill_time > 0) {
            arcOn(seam.fill_arc);
            wait(seam.fill_time);
        }
        equipment_.set(ArcOutput::FeedOn, false);
        if (seam.bback_time > 0) {
            apply(seam.bback_arc);
            wait(seam.bback_time);
        }
        arcOff();
        equipment_.set(ArcOutput::FeedOnBwd, seam.rback_time > 0);
        wait(seam.rback_time);
        equipment_.set(ArcOutput::FeedOnBwd, false);
        if (status == kOk) wait(seam.postflow_time);
    }
    const bool sticks = !inhibited_ && equipment_.input(ArcInput::WireStickErr).value_or(false);
    kill();
    if (status != kOk || !sticks) return status;
    equipment_.set(ArcOutput::AwError, true);
    return fail(task, err::AW_WIRE_ERR, "the wire sticks to the seam (input WireStickErr)");
}

void ArcProcess::kill() {
    if (std::exchange(phase_, Phase::Off) == Phase::Off) return;
    controller_->scheduler().cancel(std::exchange(ignition_, 0));
    motion_->refresh();
    weaving_->setOn(false);
    arcOff();
    equipment_.set(ArcOutput::FeedOnBwd, false);
    equipment_.set(ArcOutput::GasOn, false);
    gasSince_ = kNever;
    established_ = stopped_ = false;
}

/// A width that ArcRefresh gave takes the place of the one in the data.
Status ArcProcess::patternOf(TaskCore* task, const data::Weavedata& data, double speed,
                             motion::WeavePattern& pattern) const {
    data::Weavedata refreshed = data;
    if (refreshedWidth_) refreshed.weave_width = static_cast<float>(*refreshedWidth_);
    return weavePattern(task, refreshed, speed, pattern);
}

Status ArcProcess::weave(TaskCore* task, const data::Weavedata* data, double speed, bool isLast,
                         std::shared_ptr<const motion::Modification>& modification) {
    if (data == nullptr) return kOk;
    const auto weave = std::make_shared<motion::Weave>();
    weave->isLast = isLast;
    if (const Status status = patternOf(task, *data, speed, weave->pattern)) return status;
    std::erase_if(weaves_, [](const Ordered& ordered) { return ordered.weave.expired(); });
    weaves_.push_back({data, speed, weave});
    modification = weave;
    return kOk;
}

Status ArcProcess::refresh(TaskCore* task, double speed, std::optional<double> weaveWidth) {
    motion_->refresh();
    if (weaveWidth) refreshedWidth_ = weaveWidth;
    for (const Ordered& ordered : weaves_) {
        const auto weave = ordered.weave.lock();
        if (weave == nullptr) continue;
        motion::WeavePattern pattern;
        if (const Status status = patternOf(task, *ordered.data, ordered.speed, pattern)) return status;
        weave->pattern = pattern;
    }
    if (speed > 0) refreshedSpeed_ = speed;
    if (phase_ == Phase::Welding && weld_ != nullptr) weldWith(weld_);
    return kOk;
}

void ArcProcess::apply(const data::Arcdata& arc) const {
    if (inhibited_) return;
    equipment_.refer(ArcReference::Schedule, arc.sched);
    equipment_.refer(ArcReference::Mode, arc.mode);
    equipment_.refer(ArcReference::Voltage, arc.voltage);
    equipment_.refer(ArcReference::Feed, arc.wirefeed);
    equipment_.refer(ArcReference::Current, arc.current);
}

void ArcProcess::arcOn(const data::Arcdata& arc) {
    apply(arc);
    equipment_.set(ArcOutput::WeldOn, true);
    equipment_.set(ArcOutput::FeedOn, true);
}

void ArcProcess::arcOff() {
    equipment_.set(ArcOutput::WeldOn, false);
    equipment_.set(ArcOutput::FeedOn, false);
}

void ArcProcess::putOut() {
    if (phase_ != Phase::Welding) return;
    controller_->scheduler().cancel(std::exchange(ignition_, 0));
    phase_ = Phase::Interrupted;
    established_ = false;
    arcOff();
    equipment_.set(ArcOutput::GasOn, false);
    gasSince_ = kNever;
    if (!inhibited_) equipment_.set(ArcOutput::AwError, true);
}

/// The robot stops on its path, and the weld instruction in progress raises the error. RETRY ignites and continues there.
void ArcProcess::interrupt(Status error) {
    putOut();
    motion_->raiseProcessError(error);
}

void ArcProcess::inputChanged(SignalId id) {
    if (phase_ != Phase::Welding || inhibited_ || stopped_) return;
    if (id == equipment_.idOf(ArcInput::ArcEst)) {
        if (equipment_.input(ArcInput::ArcEst).value_or(false)) {
            established_ = true;
            controller_->scheduler().cancel(std::exchange(ignition_, 0));
        } else if (established_) {
            interrupt(err::AW_WELD_ERR);
        }
        return;
    }
    if (id == equipment_.idOf(ArcInput::StopProc) && equipment_.input(ArcInput::StopProc).value_or(false))
        return interrupt(err::AW_STOP_ERR);
    for (const auto& [input, what] : kSupervised)
        if (id == equipment_.idOf(input) && !equipment_.input(input).value_or(true))
            return interrupt(err::AW_EQIP_ERR);
}

/// A stop of the program puts the arc out; when the robot continues the arc is ignited again on the way.
void ArcProcess::take(ArmChange news) {
    if (phase_ != Phase::Welding || inhibited_) return;
    if (news == ArmChange::StopOnPath || news == ArmChange::MotorsOff) {
        if (std::exchange(stopped_, true)) return;
        established_ = false;
        arcOff();
        equipment_.set(ArcOutput::GasOn, false);
    } else if (news == ArmChange::Start && std::exchange(stopped_, false)) {
        equipment_.set(ArcOutput::GasOn, true);
        arcOn(weld_->main_arc);
        superviseIgnition();
    }
}

void ArcProcess::superviseIgnition() {
    established_ = equipment_.input(ArcInput::ArcEst).value_or(false);
    if (established_ || equipment_.idOf(ArcInput::ArcEst) < 0) return;
    ignition_ = controller_->scheduler().after(equipment_.ignitionTime(), [this] {
        ignition_ = 0;
        if (phase_ == Phase::Welding && !established_ && !stopped_) interrupt(err::AW_IGNI_ERR);
    });
}

void endWeld(Task& task) {
    if (task.isMotionTask()) task.controller().motion(task).service<ArcProcess>().kill();
}

} // namespace rt::lib
