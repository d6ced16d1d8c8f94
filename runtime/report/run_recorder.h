#pragma once
// RunRecorder: keeps what happens in a run for its report.

#include "runtime/report/run_record.h"
#include "runtime/sim/trace_sink.h"

#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace rt::report {

class RunRecorder final : public TraceSink {
  public:
    RunRecorder(std::string program, robot::RobotModel robot);

    void sample(Time time, std::string_view unit, const motion::MotionState& state) override;
    void ordered(const MoveOrder& order) override;

    /// A signal as it is when the run begins. Returns its index for signalChanged.
    std::size_t addSignal(std::string name, std::string type, double value);
    void signalChanged(std::size_t signal, Time time, double value);
    void add(Marker marker) { record_.markers.push_back(std::move(marker)); }
    /// The folder of relative names of source files; "" = where the process runs.
    void setFolder(std::string folder) { folder_ = std::move(folder); }
    void finish(Time end);

    const RunRecord& record() const { return record_; }

  private:
    MoveText textOf(const SourcePlace& place);

    RunRecord record_;
    std::string folder_;
    std::map<std::string, std::string> sources_; // by file; "" when it cannot be read
    std::map<std::tuple<std::string, uint32_t, uint32_t>, MoveText> texts_;
};

} // namespace rt::report
