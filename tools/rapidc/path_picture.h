#pragma once
// The path of the TCP as a picture: top view and side view, coloured by speed, from the samples of a run.

#include "runtime/sim/csv_writers.h"

#include <string>
#include <string_view>
#include <vector>

namespace rapidc {

class PathPicture final : public rt::TraceSink {
  public:
    struct Sample {
        double time = 0;            ///< s
        double x = 0, y = 0, z = 0; ///< mm, world
        double speed = 0;           ///< mm/s
        int move = 0;               ///< number of the move instruction
    };

    void sample(rt::Time time, std::string_view unit, const motion::MotionState& state) override;
    /// Writes the SVG. Returns what went wrong, for people; empty: success.
    std::string write(const std::string& svgFile) const;

  private:
    std::string drawing() const;
    std::vector<Sample> samples_;
};

} // namespace rapidc
