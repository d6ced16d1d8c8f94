#include "stdlib/impl/guided_motion/egm_process.h"

#include "stdlib/impl/guided_motion/udp_devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace rt::lib {

EgmProcess::State EgmProcess::state() const {
    if (!isConnected_) return State::Disconnected;
    return phase_ == Phase::None && !isCorrecting() ? State::Connected : State::Running;
}

void EgmProcess::connect(GuidanceMode mode, std::unique_ptr<Partner> partner,
                         const ExternalMotionData& defaults, Time timeout) {
    disconnect();
    mode_ = mode;
    partner_ = std::move(partner);
    defaults_ = defaults;
    timeout_ = timeout;
    isConnected_ = true;
}

void EgmProcess::disconnect() {
    finish();
    session_.streams = false;
    endSession();
    partner_.reset();
    settings_.reset();
    exchanged_ = {};
    forgetData();
    isConnected_ = timedOut_ = false;
}

void EgmProcess::forgetData() {
    data_ = {};
    hasData_ = false;
}

void EgmProcess::lose() {
    const bool wasGuiding = phase_ != Phase::None;
    disconnect();
    timedOut_ = wasGuiding;
}

void EgmProcess::activate(const GuidanceSettings& settings, const RapidExchange& exchanged, Time period) {
    settings_ = settings;
    exchanged_ = exchanged;
    noteTool();
    // A target that came while the program streamed counts until another comes: a client may send it once.
    if (!session_.streams || mode_ == GuidanceMode::PathCorrection) forgetData();
    correction_ = {};
    hasNewData_ = true; // signals have a value already
    if (mode_ == GuidanceMode::PathCorrection) corrections().setOffset({});
    beginSession(period);
}

std::string EgmProcess::startStream(Time period) {
    session_.streams = true;
    beginSession(period);
    std::string problem = sendState();
    session_.next = addTime(controller_.scheduler().now(), session_.period);
    if (!problem.empty()) stopStream();
    return problem;
}

void EgmProcess::stopStream() {
    session_.streams = false;
    if (phase_ == Phase::None) endSession();
}

void EgmProcess::run(const GuidanceOrder& order) {
    if (!session_.isOpen) beginSession(session_.period);
    order_ = order;
    noteTool();
    arm_ = std::make_unique<GuidedArm>(motion(), *settings_, order);
    phase_ = Phase::Following;
    awaitsCondition_ = !order.continues;
    timedOut_ = false;
    began_ = lastAnswer_ = controller_.scheduler().now();
    convergedSince_ = kNever;
    limits_ = {};
    schedule();
}

void EgmProcess::stop(bool rampDown, std::optional<double> rampOut) {
    if (phase_ != Phase::Following) return;
    phase_ = Phase::Braking;
    wayBack_.isWanted = rampDown;
    wayBack_.rampOut = rampOut.value_or(order_->rampOut);
    schedule();
}

void EgmProcess::awaitCondition() {
    awaitsCondition_ = true;
    wake();
}

void EgmProcess::wake() {
    hasNewData_ = true;
    if (phase_ != Phase::None || mode_ == GuidanceMode::PathCorrection) schedule();
}

void EgmProcess::pause(bool paused) {
    isPaused_ = paused;
    // Questions that were not answered while the program was stopped do not count.
    lastAnswer_ = controller_.scheduler().now();
    wake();
}

void EgmProcess::beginSession(Time period) {
    endSession();
    session_.period = period;
    session_.isOpen = true;
    session_.next = 0;
    if (partner_) partner_->begin();
    schedule();
}

void EgmProcess::endSession() {
    if (!std::exchange(session_.isOpen, false)) return;
    if (partner_) partner_->end();
    controller_.scheduler().cancel(std::exchange(session_.tick, 0));
}

/// Periods lie at whole multiples of 4 ms, as the samples of the trace.
void EgmProcess::schedule() {
    if (session_.tick != 0 || !session_.isOpen || !mustTick()) return;
    const Time now = controller_.scheduler().now();
    session_.tick = controller_.scheduler().at((now / GuidedArm::kPeriod + 1) * GuidedArm::kPeriod, [this] {
        session_.tick = 0;
        tick();
    });
}

/// With signals alone there is nothing to do while the robot is where it is asked to be.
bool EgmProcess::mustTick() const {
    if (partner_ && partner_->answers()) return true;
    if (mode_ == GuidanceMode::PathCorrection) return hasNewData_ && isActivated();
    if (phase_ == Phase::None) return false;
    if (hasNewData_) return true;
    if (isPaused_) return !arm_->isStanding();
    const bool isCounting = awaitsCondition_ && convergedSince_ != kNever;
    return phase_ != Phase::Following || !arm_->isSteady() || isCounting;
}

void EgmProcess::tick() {
    const Time now = controller_.scheduler().now();
    if (phase_ == Phase::None && owner_.state() == TaskState::Finished) {
        session_.streams = false;
        endSession();
        return;
    }
    takeData(now);
    const bool isNew = std::exchange(hasNewData_, false);
    if (mode_ == GuidanceMode::PathCorrection && isActivated()) correct(now, isNew);
    if (phase_ != Phase::None) guide(now);
    if (session_.isOpen && now >= session_.next) exchange();
    schedule();
}

void EgmProcess::takeData(Time now) {
    SensorData received;
    if (!partner_ || !partner_->receive(received)) return;
    lastAnswer_ = now;
    exchanged_.receive(owner_, received);
    if (!received.hasTarget) return;
    data_ = std::move(received);
    hasData_ = hasNewData_ = true;
}

void EgmProcess::exchange() {
    const Time now = controller_.scheduler().now();
    session_.next = addTime(now, session_.period);
    const std::string problem = sendState();
    if (problem.empty())
        failures_.note();
    else if (failures_.begins(now))
        controller_.log().write(EventId::EgmNotSent, &owner_, {partner_->name(), problem});
}

std::string EgmProcess::sendState() {
    return partner_ ? partner_->send(robotData()) : std::string();
}

namespace {

RobotPlace placeOf(const motion::MotionState& state, const motion::Pose& pose) {
    RobotPlace place;
    place.pose = pose;
    const auto axes = state.numberedAxes();
    const auto firstExternal = axes.begin() + place.joints.size();
    std::copy(axes.begin(), firstExternal, place.joints.begin());
    const auto isThere = [](double axis) { return motion::isConnected(axis); };
    const auto last = std::find_if(axes.rbegin(), std::make_reverse_iterator(firstExternal), isThere);
    for (auto axis = firstExternal; axis != last.base(); ++axis)
        place.external.push_back(isThere(*axis) ? *axis : 0);
    return place;
}

/// Of the fastest axis, in percent of its highest speed.
double utilization(const motion::MotionState& state, const robot::RobotModel& model) {
    double most = 0;
    for (std::size_t i = 0; i < state.jointSpeed.size(); ++i)
        most = std::max(most, std::fabs(state.jointSpeed[i]) / model.maxSpeed[i] * 100);
    return most;
}

} // namespace

void EgmProcess::noteTool() {
    const motion::FrameSetup frames = basedFrames(motion(), settings_->frames);
    toolAtStart_ = guidedTcp(motion(), frames, motion().system().currentJoints());
}

/// The frame in which messages say where the robot is, in world.
motion::Pose EgmProcess::correctionFrame() const {
    const GuidanceSettings settings = settings_.value_or(GuidanceSettings{});
    if (settings.correctionType == kToolFrame) return toolAtStart_ * settings.correctionFrame;
    return guidanceFrame(motion(), basedFrames(motion(), settings.frames), settings.correctionType) *
           settings.correctionFrame;
}

RobotData EgmProcess::robotData() {
    RobotData data;
    motion::MotionSystem& arm = motion().system();
    const motion::MotionState state = arm.current();
    const GuidanceSettings settings = settings_.value_or(GuidanceSettings{});
    const motion::FrameSetup frames = basedFrames(motion(), settings.frames);
    data.feedback =
        placeOf(state, inverse(correctionFrame()) * guidedTcp(motion(), frames, arm.currentJoints()));
    data.planned = data.feedback;
    data.nanoseconds = controller_.scheduler().now();
    data.calendar = controller_.calendarSeconds();
    data.motorsOn = controller_.motorsOn();
    data.isGuided = phase_ != Phase::None || isCorrecting();
    data.isConverged = arm_ && phase_ != Phase::None && hasData_ && arm_->isConverged();
    data.programRuns = owner_.isExecuting();
    data.utilization = utilization(state, motion().model());
    data.moveIndex = static_cast<uint32_t>(arm.lastOrdered());
    exchanged_.send(owner_, data);
    return data;
}

// ---- Path corrections --------------------------------------------------------------------------------------------

namespace {

/// The corrections of EGM on the path of a robot, whichever process gives them.
struct EgmCorrections {
    std::shared_ptr<motion::PathCorrections> path;
};

} // namespace

motion::PathCorrections& EgmProcess::corrections() const {
    auto& service = motion().service<EgmCorrections>();
    if (service.path == nullptr) {
        service.path = std::make_shared<motion::PathCorrections>();
        motion().system().addModifier(service.path);
    }
    return *service.path;
}

void EgmProcess::beginMove(const motion::Pose& tool) {
    correction_.ahead = looksAhead_ ? norm(settings_->sensorFrame.pos - tool.pos) : 0;
    if (!isCorrecting()) lastAnswer_ = controller_.scheduler().now();
    ++correction_.ordering;
    schedule();
}

void EgmProcess::endMove() {
    --correction_.ordering;
    correction_.latest = motion().system().lastOrdered();
}

motion::MoveCommand EgmProcess::corrected(motion::MoveCommand command) {
    command.modifications.push_back(corrections().modification());
    return command;
}

bool EgmProcess::isCorrecting() const {
    if (mode_ != GuidanceMode::PathCorrection || !isActivated()) return false;
    return correction_.ordering > 0 ||
           (correction_.latest != 0 && !motion().system().isDone(correction_.latest));
}

/// One period: y and z of the newest data displace the path; the place along the path is the program's.
void EgmProcess::correct(Time now, bool isNew) {
    if (partner_ && partner_->answers() && isCorrecting() && !isPaused_) {
        const bool isSilent = now - lastAnswer_ >= timeout_;
        if (isSilent && !std::exchange(correction_.isSilent, true))
            controller_.log().write(
                EventId::EgmNoData, &owner_,
                {partner_->name(), "EGMSetupUC", fmt::format("{:g}", toSeconds(timeout_))});
        if (!isSilent) correction_.isSilent = false;
    }
    if (!isNew || !hasData_) return;
    const motion::Vec3 offset{0, data_.pose[1].value_or(0), data_.pose[2].value_or(0)};
    motion().refresh();
    if (correction_.ahead > 0)
        corrections().setOffsetAhead(offset, correction_.ahead);
    else
        corrections().setOffset(offset);
    motion().refresh();
}

// ---- Guidance ----------------------------------------------------------------------------------------------------

void EgmProcess::guide(Time now) {
    if (isPaused_) {
        arm_->brake();
        convergedSince_ = kNever;
        return;
    }
    switch (phase_) {
    case Phase::Following: followOn(now); break;
    case Phase::Braking:
        arm_->brake();
        if (!arm_->isStanding()) break;
        if (!wayBack_.isWanted) return finish();
        beginWayBack(now);
        break;
    case Phase::WayBack: {
        const double seconds = toSeconds(now - wayBack_.began);
        arm_->placeOnWayBack(wayBack_.seconds > 0 ? seconds / wayBack_.seconds : 1);
        if (seconds >= wayBack_.seconds) return finish();
        break;
    }
    case Phase::None: break;
    }
    if (!arm_ || !arm_->isLost()) return;
    controller_.log().write(
        EventId::EgmMisused, &owner_,
        {"A movement was ordered while the robot was guided, so the guidance has ended. Use "
         "EGMStop or EGMWaitCond before the next movement."});
    finish();
}

void EgmProcess::beginWayBack(Time now) {
    phase_ = Phase::WayBack;
    wayBack_.began = now;
    const double least = arm_->beginWayBack();
    wayBack_.seconds = std::max(wayBack_.rampOut, least);
    if (wayBack_.rampOut > 0 && least > wayBack_.rampOut)
        controller_.log().write(EventId::EgmRampIncreased, &owner_,
                                {fmt::format("{:.2f}", wayBack_.rampOut), fmt::format("{:.2f}", least)});
}

void EgmProcess::followOn(Time now) {
    if (partner_ && partner_->answers() && now - lastAnswer_ >= timeout_) {
        controller_.log().write(EventId::EgmNoData, &owner_,
                                {partner_->name(), "EGMSetupUC", fmt::format("{:g}", toSeconds(timeout_))});
        const bool isFatal = order_->continues;
        timedOut_ = !isFatal;
        finish();
        if (isFatal) {
            controller_.log().write(EventId::EgmStopsProgram, &owner_);
            owner_.stop(StopCause::Error);
            controller_.taskFailed(owner_);
        }
        return;
    }
    const double rampIn = order_->rampIn;
    arm_->follow(data_, rampIn > 0 ? std::min(1.0, toSeconds(now - began_) / rampIn) : 1);
    if (arm_->limit().empty())
        limits_.note();
    else if (limits_.begins(now))
        controller_.log().write(EventId::EgmLimited, &owner_, {arm_->limit()});
    if (!hasData_ || !arm_->isConverged())
        convergedSince_ = kNever;
    else if (convergedSince_ == kNever)
        convergedSince_ = now;
    if (!awaitsCondition_ || convergedSince_ == kNever ||
        now - convergedSince_ < fromSeconds(order_->conditionTime))
        return;
    stop(order_->rampDown, order_->rampOut);
}

/// The guidance is over, and with it the messages, unless they were asked for by themselves.
void EgmProcess::finish() {
    if (std::exchange(phase_, Phase::None) == Phase::None) return;
    arm_.reset();
    if (session_.streams) forgetData();
    if (session_.streams)
        (void)sendState();
    else
        endSession();
    changed_.notifyAll();
}

// ---- All of them -------------------------------------------------------------------------------------------------

EgmProcesses& EgmProcesses::of(Controller& controller) {
    auto& processes = controller.service<EgmProcesses>();
    if (processes.controller_ == nullptr) processes.open(controller);
    return processes;
}

void EgmProcesses::open(Controller& controller) {
    controller_ = &controller;
    controller.onShutDown([this] {
        for (auto& [handle, process] : processes_)
            process->lose();
        controller_->service<UdpDevices>().closeAll();
    });
}

EgmProcess* EgmProcesses::reserve(Task& owner, Handle& identity) {
    if (processes_.size() >= kMost) return nullptr;
    MotionDriver& motion = controller_->motion(owner);
    if (watched_.insert(&motion).second)
        motion.addListener([this, &motion](ArmChange news) {
            if (news != ArmChange::StopOnPath && news != ArmChange::MotorsOff && news != ArmChange::Start)
                return;
            for (auto& [handle, process] : processes_)
                if (&controller_->motion(process->owner()) == &motion)
                    process->pause(news != ArmChange::Start);
        });
    identity = processes_.create(std::make_unique<EgmProcess>(*controller_, owner));
    return find(identity);
}

EgmProcess* EgmProcesses::find(Handle identity) {
    const auto* process = processes_.find(identity);
    return process == nullptr ? nullptr : process->get();
}

EgmProcess* EgmProcesses::guiding(const MotionDriver& motion) {
    for (auto& [handle, process] : processes_)
        if (!process->hasFinished() && &controller_->motion(process->owner()) == &motion)
            return process.get();
    return nullptr;
}

void EgmProcesses::releaseAll(const Task& owner) {
    std::vector<Handle> released;
    for (const auto& [handle, process] : processes_)
        if (&process->owner() == &owner) released.push_back(handle);
    for (const Handle handle : released)
        processes_.erase(handle);
}

void endGuidance(Task& task) {
    task.controller().service<EgmProcesses>().releaseAll(task);
}

} // namespace rt::lib
