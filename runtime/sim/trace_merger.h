#pragma once
// TraceMerger: brings the samples of several units, which arrive unit by unit, into the order of time.

#include "runtime/sim/trace_sink.h"

#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace rt {

class TraceMerger final : public TraceSink {
  public:
    /// Passes on to `out`. `catchUp` brings the units that are late up to the present; called when many samples wait.
    TraceMerger(TraceSink& out, std::function<void()> catchUp) : out_(out), catchUp_(std::move(catchUp)) {}
    /// Every unit whose samples will come, in the order of their rows at the same time.
    void addUnit(std::string_view unit) { units_.push_back({std::string(unit), {}}); }

    void sample(Time time, std::string_view unit, const motion::MotionState& state) override;
    bool wantsMotors() const override { return out_.wantsMotors(); }
    void ordered(const MoveOrder& order) override { out_.ordered(order); }
    /// Passes on what is left: no more samples will come.
    void finish();

  private:
    struct Sample {
        Time time = 0;
        motion::MotionState state;
    };
    struct Unit {
        std::string name;
        std::deque<Sample> waiting;
    };
    bool passOne(bool whole);

    TraceSink& out_;
    std::function<void()> catchUp_;
    std::vector<Unit> units_;
    bool isCatchingUp_ = false;
};

} // namespace rt
