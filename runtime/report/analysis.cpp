#include "runtime/report/analysis.h"

#include "runtime/robot/angles.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace rt::report {
namespace {

constexpr double kPeak = 0.97;   // of the largest speed: the ramps of a movement end there
constexpr double kAtRest = 0.05; // of the largest speed

/// The time between two samples in motion.
struct Step {
    std::size_t to = 0; ///< index of the second sample
    double seconds = 0;
    double speed = 0;     ///< mm/s
    double turnSpeed = 0; ///< deg/s
    double external = 0;  ///< fastest external axis, of its programmed speed
    double ratio = 0;     ///< of the programmed speed
    Loss limit;           ///< what held it there
};

motion::Joints jointSpeeds(const Sample& a, const Sample& b) {
    motion::Joints result{};
    const double seconds = b.time - a.time;
    for (std::size_t axis = 0; axis < result.size(); ++axis)
        result[axis] = seconds > 0 ? (b.joints[axis] - a.joints[axis]) / seconds : 0;
    return result;
}

/// Position of an external axis; 0 while it is not connected.
double placeOf(const Sample& sample, const ExternalAxis& axis) {
    const double place = sample.external[axis.index];
    return motion::isConnected(place) ? place : 0;
}

/// Speed of an external axis between two samples, deg/s or mm/s.
double externalSpeed(const Sample& a, const Sample& b, const ExternalAxis& axis) {
    const double seconds = b.time - a.time;
    return seconds > 0 ? (placeOf(b, axis) - placeOf(a, axis)) / seconds : 0;
}

/// Of the change of speed at `i`; zero where the samples around it are missing.
motion::Joints jointAccelerations(const std::vector<Sample>& samples, std::size_t i) {
    if (i == 0 || i + 1 >= samples.size()) return {};
    const motion::Joints before = jointSpeeds(samples[i - 1], samples[i]);
    motion::Joints result = jointSpeeds(samples[i], samples[i + 1]);
    const double seconds = (samples[i + 1].time - samples[i - 1].time) / 2;
    for (std::size_t axis = 0; axis < result.size(); ++axis)
        result[axis] = seconds > 0 ? (result[axis] - before[axis]) / seconds : 0;
    return result;
}

class MoveAnalysis {
  public:
    MoveAnalysis(const RobotRecord& record, MoveResult& result)
        : record_(record),
          accelerations_(record.hasArm ? robot::AccelerationMap(record.robot) : robot::AccelerationMap()),
          samples_(record.samples), result_(result), move_(*result.move) {}

    void run() {
        for (std::size_t i = result_.first + 1; i <= result_.last; ++i)
            addStep(i);
        if (steps_.empty()) return;
        findRamps();
        for (std::size_t k = 0; k < steps_.size(); ++k)
            steps_[k].limit = limitOf(k);
        addUp();
    }

  private:
    double programmedSpeed() const {
        // With a programmed time there is no programmed speed; the largest one reached takes its place.
        const double speed =
            move_.duration > 0 ? result_.reached : std::min(move_.speed, record_.robot.maxTcpSpeed);
        return std::max(speed, 1e-9);
    }

    void addStep(std::size_t i) {
        const Sample &a = samples_[i - 1], &b = samples_[i];
        if (!hasMoved(a, b)) return;
        Step step;
        step.to = i;
        step.seconds = b.time - a.time;
        step.speed = toolChanged(a, b) ? b.speed : std::max(a.speed, b.speed);
        step.turnSpeed = toolChanged(a, b) ? 0 : turnBetween(a.rotation, b.rotation) / step.seconds;
        for (const ExternalAxis& axis : record_.external) {
            const double programmed = axis.rotating ? move_.externalTurnSpeed : move_.externalSpeed;
            if (programmed > 0)
                step.external = std::max(step.external, std::fabs(externalSpeed(a, b, axis)) / programmed);
        }
        result_.moving += step.seconds;
        if (!toolChanged(a, b)) result_.length += norm(b.position - a.position);
        result_.reached = std::max(result_.reached, step.speed);
        result_.turnReached = std::max(result_.turnReached, step.turnSpeed);
        steps_.push_back(step);
    }

    /// Speeds as shares of what is programmed; where the movement has come up to speed, and begins to brake.
    void findRamps() {
        double largest = 0;
        for (Step& step : steps_) {
            const double turn = move_.turnSpeed > 0 ? step.turnSpeed / move_.turnSpeed : 0;
            step.ratio = std::max({step.speed / programmedSpeed(), turn, step.external});
            largest = std::max(largest, step.ratio);
        }
        const auto isUp = [largest](const Step& step) { return step.ratio >= kPeak * largest; };
        upFrom_ = static_cast<std::size_t>(std::find_if(steps_.begin(), steps_.end(), isUp) - steps_.begin());
        const auto last = std::find_if(steps_.rbegin(), steps_.rend(), isUp);
        upTo_ = steps_.size() - static_cast<std::size_t>(last - steps_.rbegin());
        const std::size_t before = steps_.front().to - 1;
        startsAtRest_ = before == 0 || !hasMoved(samples_[before - 1], samples_[before]) ||
                        (steps_.front().ratio < kAtRest * largest && !turnsBackFlyingBy(before));
        const std::size_t after = steps_.back().to;
        endsAtRest_ = move_.stopPoint || after + 1 >= samples_.size() ||
                      !hasMoved(samples_[after], samples_[after + 1]) ||
                      (steps_.back().ratio < kAtRest * largest && !turnsBackFlyingBy(after));
    }

    /// The TCP is at rest for a moment only, because its path turns back on itself in a zone.
    bool turnsBackFlyingBy(std::size_t sample) const {
        const std::size_t first = std::max<std::size_t>(sample, 2) - 1;
        const auto* ending = record_.find(samples_[first - 1].move);
        if (ending == nullptr || ending->stopPoint) return false;
        for (std::size_t i = first; i <= sample + 1 && i + 1 < samples_.size(); ++i) {
            const motion::Vec3 before = samples_[i].position - samples_[i - 1].position;
            const motion::Vec3 after = samples_[i + 1].position - samples_[i].position;
            if (dot(before, after) < 0) return true;
        }
        return false;
    }

    Loss limitOf(std::size_t k) const {
        const Step& step = steps_[k];
        if (step.ratio >= kSpeedReached && move_.duration <= 0) return {Cause::Programmed, 0, 0};
        if (const Loss joint = jointLimit(step); joint.axis != 0) return joint;
        if (const Loss path = pathLimit(step); path.cause != Cause::Other) return path;
        if (k < upFrom_) return {startsAtRest_ ? Cause::StopPoint : Cause::Zone, 0, 0};
        if (k >= upTo_) return {endsAtRest_ ? Cause::StopPoint : Cause::Zone, 0, 0};
        return {move_.isTogether ? Cause::OtherRobots : Cause::Other, 0, 0};
    }

    /// The axis that is nearest to its limit: of speed, else of acceleration.
    Loss jointLimit(const Step& step) const {
        const motion::Joints speeds = jointSpeeds(samples_[step.to - 1], samples_[step.to]);
        const motion::Joints accelerations = jointAccelerations(samples_, step.to);
        motion::Joints limits = speeds;
        if (record_.hasArm) accelerations_.limitsAt(samples_[step.to].joints, limits);
        Loss speed{Cause::JointSpeed, 0, 0}, acceleration{Cause::Acceleration, 0, 0};
        double nearestSpeed = kSpeedReached, nearestAcceleration = kAccelerationReached;
        for (std::size_t axis = 0; axis < speeds.size(); ++axis) {
            const double speedShare = std::fabs(speeds[axis]) / record_.robot.maxSpeed[axis];
            const double accelerationShare =
                std::fabs(accelerations[axis]) / (limits[axis] * move_.acceleration);
            if (speedShare >= nearestSpeed) {
                nearestSpeed = speedShare;
                speed.axis = static_cast<int>(axis) + 1;
            }
            if (accelerationShare >= nearestAcceleration) {
                nearestAcceleration = accelerationShare;
                acceleration.axis = static_cast<int>(axis) + 1;
            }
        }
        if (speed.axis == 0 && acceleration.axis == 0) return externalLimit(step);
        return speed.axis != 0 ? speed : acceleration;
    }

    Loss externalLimit(const Step& step) const {
        for (const ExternalAxis& axis : record_.external) {
            const int number = kFirstExternal + static_cast<int>(axis.index);
            const Sample &a = samples_[step.to - 1], &b = samples_[step.to];
            const double now = externalSpeed(a, b, axis);
            if (std::fabs(now) >= kSpeedReached * axis.maxSpeed) return {Cause::JointSpeed, number, 0};
            if (step.to + 1 >= samples_.size()) continue;
            const double next = externalSpeed(b, samples_[step.to + 1], axis);
            const double change = std::fabs(next - now) / ((samples_[step.to + 1].time - a.time) / 2);
            if (change >= kAccelerationReached * axis.maxAcceleration)
                return {Cause::Acceleration, number, 0};
        }
        return {};
    }

    Loss pathLimit(const Step& step) const {
        const double change = (samples_[step.to].speed - samples_[step.to - 1].speed) / step.seconds;
        const double limit = change > 0 ? move_.pathAcceleration : move_.pathDeceleration;
        const bool reached = limit > 0 && std::fabs(change) >= kAccelerationReached * limit;
        return {reached ? Cause::PathAcceleration : Cause::Other, 0, 0};
    }

    void addUp() {
        for (const Step& step : steps_) {
            if (step.limit.cause == Cause::Programmed) {
                result_.atProgrammed += step.seconds;
                continue;
            }
            addLoss(result_.losses,
                    {step.limit.cause, step.limit.axis, step.seconds * std::clamp(1 - step.ratio, 0.0, 1.0)});
        }
        result_.main = mainCause();
    }

    Loss mainCause() const {
        constexpr double kTimeKept = 1.02, kSample = 0.008;
        if (move_.duration > 0 && result_.moving <= move_.duration * kTimeKept + kSample)
            return {Cause::Duration, 0, 0};
        if (result_.losses.empty() || result_.atProgrammed >= result_.moving / 2)
            return {move_.speed > record_.robot.maxTcpSpeed ? Cause::RobotSpeed : Cause::Programmed, 0, 0};
        return result_.losses.front();
    }

  private:
    const RobotRecord& record_;
    robot::AccelerationMap accelerations_;
    const std::vector<Sample>& samples_;
    MoveResult& result_;
    const Move& move_;
    std::vector<Step> steps_;
    std::size_t upFrom_ = 0, upTo_ = 0; // steps between the ramps
    bool startsAtRest_ = false, endsAtRest_ = false;
};

/// From the last sample before the arm moves to the one in which it has come to rest.
bool findTimes(const std::vector<Sample>& samples, std::size_t from, std::size_t to, MoveResult& result) {
    std::size_t first = from, last = to;
    if (first > 0) --first;
    while (first < last && !hasMoved(samples[first], samples[first + 1]))
        ++first;
    while (last > first && !hasMoved(samples[last - 1], samples[last]))
        --last;
    result.first = first;
    result.last = last;
    result.start = samples[first].time;
    result.end = samples[last].time;
    return last > first;
}

} // namespace

void addLoss(std::vector<Loss>& losses, const Loss& loss) {
    if (loss.seconds <= 0) return;
    const auto same = [&loss](const Loss& l) { return l.cause == loss.cause && l.axis == loss.axis; };
    const auto found = std::find_if(losses.begin(), losses.end(), same);
    if (found == losses.end())
        losses.push_back(loss);
    else
        found->seconds += loss.seconds;
    std::sort(losses.begin(), losses.end(), [](const Loss& a, const Loss& b) {
        return std::tie(b.seconds, a.cause, a.axis) < std::tie(a.seconds, b.cause, b.axis);
    });
}

double turnBetween(const motion::Quat& a, const motion::Quat& b) {
    const motion::Quat difference = conjugate(a) * b;
    const double sine =
        std::sqrt(difference.x * difference.x + difference.y * difference.y + difference.z * difference.z);
    return 2 * std::atan2(sine, std::fabs(difference.w)) * robot::kDegreesPerRadian;
}

bool hasMoved(const Sample& before, const Sample& after) {
    return before.joints != after.joints || before.external != after.external;
}

bool toolChanged(const Sample& before, const Sample& after) {
    const double way = norm(after.position - before.position);
    return way > 1 && way > 2 * std::max(before.speed, after.speed) * (after.time - before.time);
}

Analysis analyse(const RobotRecord& record) {
    Analysis analysis;
    const std::vector<Sample>& samples = record.samples;
    for (std::size_t from = 0; from < samples.size();) {
        std::size_t to = from;
        while (to + 1 < samples.size() && samples[to + 1].move == samples[from].move)
            ++to;
        MoveResult result;
        result.move = record.find(samples[from].move);
        if (result.move != nullptr && findTimes(samples, from, to, result)) {
            MoveAnalysis(record, result).run();
            for (const Loss& loss : result.losses)
                addLoss(analysis.losses, loss);
            analysis.moving += result.moving;
            analysis.length += result.length;
            analysis.moves.push_back(std::move(result));
        }
        from = to + 1;
    }
    analysis.cycle = record.end;
    analysis.waiting = std::max(0.0, analysis.cycle - analysis.moving);
    return analysis;
}

namespace {

/// "axis 3", "axis eax_b".
std::string axisText(int axis) {
    if (axis < kFirstExternal) return fmt::format("axis {}", axis);
    return fmt::format("axis eax_{}", static_cast<char>('a' + (axis - kFirstExternal)));
}

} // namespace

std::string causeText(const Loss& loss) {
    switch (loss.cause) {
    case Cause::Programmed: return "programmed speed";
    case Cause::Duration: return "programmed time";
    case Cause::JointSpeed: return "speed limit of " + axisText(loss.axis);
    case Cause::RobotSpeed: return "largest TCP speed of the robot";
    case Cause::Acceleration: return "acceleration of " + axisText(loss.axis);
    case Cause::PathAcceleration: return "PathAccLim";
    case Cause::StopPoint: return "stop point";
    case Cause::Zone: return "zone";
    case Cause::OtherRobots: return "other robots";
    case Cause::Other: return "other";
    }
    return {};
}

std::string verdict(const MoveResult& result) {
    if (result.main.seconds <= 0) return causeText(result.main);
    return fmt::format("{} (-{:.3f} s)", causeText(result.main), result.main.seconds);
}

} // namespace rt::report
