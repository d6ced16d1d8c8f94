#pragma once
// The files a run leaves: every change of a signal, the robot's trace. Fixed formats, the same bytes on every machine.

#include "runtime/base/output_file.h"
#include "runtime/base/source_place.h"
#include "runtime/base/time.h"
#include "runtime/sim/trace_sink.h"

#include <string>
#include <string_view>

namespace rt {

/// --signals: `time_s,signal,value`, a row per change, time with six decimals.
class SignalsWriter {
  public:
    bool open(const std::string& path, std::string& error);
    void change(Time time, std::string_view signal, double value);
    bool close() { return file_.close(); }

  private:
    OutputFile file_;
};

/// --errors: `time_s,task,module,routine,line,column,number,name,file`, a row for each error that is raised; the place is where the
/// statement begins, `name` is empty for errors of the program's own.
class ErrorsWriter {
  public:
    bool open(const std::string& path, std::string& error);
    void raised(Time time, std::string_view task, const SourcePlace& place, int number,
                std::string_view name);
    bool close() { return file_.close(); }

  private:
    OutputFile file_;
};

/// --trace: a row each 4 ms, or --tick: `time_s,unit,j1..j6,e1..e6,x,y,z,q1,q2,q3,q4,speed_mm_s,move`; degrees, mm, the active TCP in
/// world; axes that are not connected read 9E+09; `move` counts move instructions. With motors, `m1..m6` follow.
class TraceWriter final : public TraceSink {
  public:
    explicit TraceWriter(bool withMotors) : withMotors_(withMotors) {}
    bool open(const std::string& path, std::string& error);
    void sample(Time time, std::string_view unit, const motion::MotionState& state) override;
    bool wantsMotors() const override { return withMotors_; }
    bool close() { return file_.close(); }

  private:
    OutputFile file_;
    bool withMotors_ = false;
};

} // namespace rt
