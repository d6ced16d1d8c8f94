#pragma once
// The files a run leaves: every change of a signal, the robot's trace. Fixed formats, the same bytes on every machine.

#include "runtime/motion/planned_motion.h"
#include "runtime/sched/time.h"

#include <cstdio>
#include <string>
#include <string_view>

namespace rt {

/// A text file written from beginning to end.
class OutputFile {
  public:
    OutputFile() = default;
    ~OutputFile() { close(); }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// False with a reason when the file cannot be made.
    bool open(const std::string& path, std::string& error);
    void write(std::string_view text);
    /// False when something could not be written (disk full).
    bool close();

  private:
    std::FILE* file_ = nullptr;
    bool failed_ = false;
};

/// --signals: `time_s,signal,value`, a row per change, time with six decimals.
class SignalsWriter {
  public:
    bool open(const std::string& path, std::string& error);
    void change(Time time, std::string_view signal, double value);
    bool close() { return file_.close(); }

  private:
    OutputFile file_;
};

/// --trace: a row each 4 ms: `time_s,unit,j1..j6,e1..e6,x,y,z,q1,q2,q3,q4,speed_mm_s,move`; degrees, mm, the active TCP in
/// world; axes that are not connected read 9E+09; `move` counts move instructions.
class TraceWriter {
  public:
    static constexpr Time kPeriod = 4 * kMillisecond;
    bool open(const std::string& path, std::string& error);
    void sample(Time time, std::string_view unit, const motion::MotionState& state);
    bool close() { return file_.close(); }

  private:
    OutputFile file_;
};

} // namespace rt
