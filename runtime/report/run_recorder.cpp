#include "runtime/report/run_recorder.h"

#include "runtime/base/text_util.h"
#include "runtime/report/move_text.h"
#include "runtime/robot/lengths.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

namespace rt::report {
namespace {

bool looksTheSame(const Sample& a, const Sample& b) {
    return a.move == b.move && a.speed == b.speed && a.position == b.position && a.joints == b.joints &&
           a.external == b.external;
}

} // namespace

/// The recording of one motion group.
class RunRecorder::RobotSink final : public TraceSink {
  public:
    RobotSink(RunRecorder& recorder, std::size_t index) : recorder_(recorder), index_(index) {}
    void sample(Time time, std::string_view /*unit*/, const motion::MotionState& state) override {
        recorder_.sample(recorder_.record_.robots[index_], time, state);
    }
    void ordered(const MoveOrder& order) override {
        recorder_.ordered(recorder_.record_.robots[index_], order);
    }

  private:
    RunRecorder& recorder_;
    std::size_t index_;
};

TraceSink& RunRecorder::addRobot(RobotRecord robot) {
    record_.robots.push_back(std::move(robot));
    sinks_.push_back(std::make_unique<RobotSink>(*this, record_.robots.size() - 1));
    return *sinks_.back();
}

void RunRecorder::sample(RobotRecord& robot, Time time, const motion::MotionState& state) {
    const Sample next{toSeconds(time), state.joints,   state.extax, state.tcp.pos,
                      state.tcp.rot,   state.tcpSpeed, state.tag};
    std::vector<Sample>& samples = robot.samples;
    const std::size_t count = samples.size();
    if (count >= 2 && looksTheSame(samples[count - 1], next) && looksTheSame(samples[count - 2], next))
        samples.back() = next;
    else
        samples.push_back(next);
}

void RunRecorder::ordered(RobotRecord& robot, const MoveOrder& order) {
    const motion::MoveCommand& command = order.command;
    const motion::MotionSettings& settings = command.settings;
    Move move;
    move.number = order.number;
    move.kind = command.kind;
    move.place = order.place;
    move.text = textOf(order.place);
    move.end = order.end.pos;
    const double share = settings.velocityPercent / 100;
    move.speed = std::min(command.speed.vTcp * share, settings.maxTcpSpeed);
    move.turnSpeed = command.speed.vOri * share;
    move.externalTurnSpeed = command.speed.vReax * share;
    move.externalSpeed = command.speed.vLeax * share;
    move.duration = command.duration;
    move.isTogether = command.ident != motion::kNoIdent;
    move.stopPoint = command.zone.finep;
    move.zone = command.zone.pzoneTcp;
    move.acceleration = std::clamp(settings.accelerationPercent, 20.0, 100.0) / 100;
    move.pathAcceleration = settings.pathAcceleration * robot::kMmPerMetre;
    move.pathDeceleration = settings.pathDeceleration * robot::kMmPerMetre;
    if (!robot.moves.empty() && robot.moves.back().number == move.number)
        robot.moves.back() = std::move(move);
    else
        robot.moves.push_back(std::move(move));
}

/// A source that was read once stays: loops order the same movement often.
MoveText RunRecorder::textOf(const SourcePlace& place) {
    if (place.line == 0 || place.file.empty()) return {};
    const auto known = texts_.find({place.file, place.line, place.column});
    if (known != texts_.end()) return known->second;
    const auto [source, isNew] = sources_.try_emplace(place.file);
    if (isNew) {
        const std::filesystem::path file =
            std::filesystem::path(folder_) / place.file; // an absolute name stays
        if (!rapid::config::readFile(file.string(), source->second).empty()) source->second.clear();
    }
    return texts_[{place.file, place.line, place.column}] =
               moveTextAt(source->second, place.line, place.column);
}

std::size_t RunRecorder::addSignal(std::string name, std::string type, double value) {
    record_.signals.push_back({std::move(name), std::move(type), value, {}});
    return record_.signals.size() - 1;
}

void RunRecorder::signalChanged(std::size_t signal, Time time, double value) {
    if (signal < record_.signals.size()) record_.signals[signal].changes.push_back({toSeconds(time), value});
}

void RunRecorder::finish(Time end) {
    for (RobotRecord& robot : record_.robots)
        robot.end = toSeconds(end);
}

} // namespace rt::report
