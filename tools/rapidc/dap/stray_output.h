#pragma once
// StrayOutput: catches what the process writes to standard output and standard error while these belong to a protocol.

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

namespace rapidc::dap {

class StrayOutput {
  public:
    /// From now on both go into a file in memory; protocolOutput() is what standard output was.
    StrayOutput();
    /// Catches nothing: for a session that has no process of its own. `protocolOutput` stays the caller's.
    explicit StrayOutput(int protocolOutput) : output_(protocolOutput) {}
    /// Gives back what was caught.
    ~StrayOutput();
    StrayOutput(const StrayOutput&) = delete;
    StrayOutput& operator=(const StrayOutput&) = delete;

    int protocolOutput() const { return output_; }
    /// The text written since the last call, a line at a time.
    void take(const std::function<void(std::string_view line)>& action);

  private:
    int output_ = -1, errors_ = -1, memory_ = -1;
    long taken_ = 0;
    std::string unfinished_;
};

} // namespace rapidc::dap
