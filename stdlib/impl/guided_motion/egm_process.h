#pragma once
// EgmProcess: one EGM process of a controller, which an egmident names (EGMGetId): its source of data, its session of
// messages and its guidance. EgmProcesses has all of them.

#include "stdlib/impl/guided_motion/event_burst.h"
#include "stdlib/impl/guided_motion/guided_arm.h"
#include "stdlib/impl/guided_motion/rapid_exchange.h"

#include "runtime/motion/path_corrections.h"

#include "runtime/host/controller.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace rt::lib {

/// EXT_MOTION_DATA of MOC.cfg.
struct ExternalMotionData {
    double gain = 40;      ///< 1/s
    double filterHz = 20;  ///< Hz
    double rampTime = 0.5; ///< s
};

// Size: the settings of six instructions, which EGMRun reads together.
class EgmProcess {
  public:
    enum class State : uint8_t { Disconnected, Connected, Running };

    EgmProcess(Controller& controller, Task& owner) : controller_(controller), owner_(owner) {}
    ~EgmProcess() { disconnect(); }
    EgmProcess(const EgmProcess&) = delete;
    EgmProcess& operator=(const EgmProcess&) = delete;

    State state() const;
    const Task& owner() const { return owner_; }
    GuidanceMode mode() const { return mode_; }
    const ExternalMotionData& defaults() const { return defaults_; }
    bool isActivated() const { return settings_.has_value(); }
    const GuidanceSettings& settings() const { return *settings_; }

    /// EGMSetup...: a new source of data; `partner` null: one that never sends anything. `timeout`: \CommTimeout.
    void connect(GuidanceMode mode, std::unique_ptr<Partner> partner, const ExternalMotionData& defaults,
                 Time timeout);
    /// \LATR: the sensor of path corrections measures in front of the TCP.
    void setLookAhead(bool looksAhead) { looksAhead_ = looksAhead; }
    /// EGMReset: the guidance ends where the robot is.
    void disconnect();
    /// The power has failed: as disconnect(), and an instruction that waits raises the error of a time-out.
    void lose();
    /// EGMAct...: the session begins. `period` of the messages.
    void activate(const GuidanceSettings& settings, const RapidExchange& exchanged, Time period);
    /// EGMStreamStart: messages without guidance. Returns why none can be sent, or "".
    std::string startStream(Time period);
    void stopStream();
    /// EGMRun...: guidance begins; only when activated, with the arm at rest.
    void run(const GuidanceOrder& order);
    /// EGMMoveL, EGMMoveC: around the order of a movement, `corrected` by what the sensor sends. `tool`: of the movement.
    void beginMove(const motion::Pose& tool);
    void endMove();
    motion::MoveCommand corrected(motion::MoveCommand command);
    /// EGMStop. `rampOut`: s; none: as the order says.
    void stop(bool rampDown, std::optional<double> rampOut);

    /// No answer came in time, or the power has failed; once.
    bool takeTimeout() { return std::exchange(timedOut_, false); }
    /// The guidance is over, or its condition has been met.
    bool hasFinished() const { return phase_ == Phase::None; }
    /// Notified when the guidance ends.
    WaitQueue& changed() { return changed_; }
    /// EGMWaitCond: the guidance ends when its condition is met, even when the program did not wait for that before.
    void awaitCondition();
    /// The source has other data.
    void wake();
    /// The program stops or starts again.
    void pause(bool paused);

  private:
    enum class Phase : uint8_t { None, Following, Braking, WayBack };

    MotionDriver& motion() const { return controller_.motion(owner_); }
    void beginSession(Time period);
    void endSession();
    motion::PathCorrections& corrections() const;
    void correct(Time now, bool isNew);
    bool isCorrecting() const;
    void tick();
    void schedule();
    void takeData(Time now);
    void forgetData();
    void exchange();
    std::string sendState();
    RobotData robotData();
    motion::Pose correctionFrame() const;
    void noteTool();
    void guide(Time now);
    void beginWayBack(Time now);
    void followOn(Time now);
    void finish();
    bool mustTick() const;

    Controller& controller_;
    Task& owner_;
    GuidanceMode mode_ = GuidanceMode::Joint;
    ExternalMotionData defaults_;
    Time timeout_ = kSecond;
    bool isConnected_ = false;
    std::unique_ptr<Partner> partner_;
    std::optional<GuidanceSettings> settings_;
    motion::Pose toolAtStart_; ///< TCP in world: frames of the type EGM_FRAME_TOOL stay where they were
    RapidExchange exchanged_;
    std::optional<GuidanceOrder> order_;
    std::unique_ptr<GuidedArm> arm_;
    SensorData data_;
    bool hasData_ = false; ///< since EGMAct... or, when messages were streamed before, since EGMStreamStart
    struct Session {
        bool isOpen = false;
        bool streams = false; ///< lasts beyond the guidance (EGMStreamStart)
        Time period = GuidedArm::kPeriod, next = 0;
        EventToken tick = 0;
    };
    struct WayBack {
        bool isWanted = false;
        double rampOut = 0, seconds = 0; ///< as asked for, and as it takes
        Time began = 0;
    };
    struct Correction {            ///< of the path
        int ordering = 0;          ///< movement instructions that wait
        motion::MoveId latest = 0; ///< movement that has been ordered last
        double ahead = 0;          ///< mm from the TCP to where the sensor measures
        bool isSilent = false;     ///< reported
    };
    Correction correction_;
    bool looksAhead_ = false;
    Phase phase_ = Phase::None;
    Session session_;
    WayBack wayBack_;
    bool timedOut_ = false, isPaused_ = false;
    bool hasNewData_ = false;     ///< the source may have other data than at the latest period
    bool awaitsCondition_ = true; ///< the guidance ends when its condition is met
    Time began_ = 0, lastAnswer_ = 0, convergedSince_ = kNever;
    EventBurst limits_, failures_; ///< targets that are not followed, messages that cannot be sent
    WaitQueue changed_;
};

class EgmProcesses {
  public:
    static constexpr std::size_t kMost = 4;

    static EgmProcesses& of(Controller& controller);
    /// Null when none is free.
    EgmProcess* reserve(Task& owner, Handle& identity);
    /// Null when the variable names none.
    EgmProcess* find(Handle identity);
    void release(Handle identity) { processes_.erase(identity); }
    /// The process that guides this robot now; null when there is none.
    EgmProcess* guiding(const MotionDriver& motion);
    /// The program of the task begins again: what it left is released.
    void releaseAll(const Task& owner);

  private:
    void open(Controller& controller);

    Controller* controller_ = nullptr;
    HandleTable<std::unique_ptr<EgmProcess>> processes_;
    std::set<const MotionDriver*> watched_; ///< whose stops and starts are listened to
};

/// The program of a task begins again.
void endGuidance(Task& task);

} // namespace rt::lib
