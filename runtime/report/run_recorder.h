#pragma once
// RunRecorder: keeps what happens in a run for its report.

#include "runtime/report/run_record.h"
#include "runtime/sim/trace_sink.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rt::report {

class RunRecorder {
  public:
    explicit RunRecorder(std::string program) { record_.program = std::move(program); }

    /// A motion group as it is when the run begins (unit, robot, external axes); what takes its samples lives as long as this.
    TraceSink& addRobot(RobotRecord robot);
    /// A signal as it is when the run begins. Returns its index for signalChanged.
    std::size_t addSignal(std::string name, std::string type, double value);
    void signalChanged(std::size_t signal, Time time, double value);
    void add(Marker marker) { record_.markers.push_back(std::move(marker)); }
    /// The folder of relative names of source files; "" = where the process runs.
    void setFolder(std::string folder) { folder_ = std::move(folder); }
    void finish(Time end);

    const RunRecord& record() const { return record_; }

  private:
    class RobotSink;
    void sample(RobotRecord& robot, Time time, const motion::MotionState& state);
    void ordered(RobotRecord& robot, const MoveOrder& order);
    MoveText textOf(const SourcePlace& place);

    RunRecord record_;
    std::vector<std::unique_ptr<TraceSink>> sinks_;
    std::string folder_;
    std::map<std::string, std::string> sources_; // by file; "" when it cannot be read
    std::map<std::tuple<std::string, uint32_t, uint32_t>, MoveText> texts_;
};

} // namespace rt::report
