#pragma once
// Comparison of a run with a recording (or with another run): how much longer or shorter it took, where along the path that
// comes from, and how far apart the paths are.

#include "runtime/report/alignment.h"
#include "runtime/report/analysis.h"
#include "runtime/report/recording.h"

#include <string>
#include <vector>

namespace rt::report {

/// A movement, or the time the arm waits at its end, in both.
struct TimeDifference {
    const MoveResult* move = nullptr;
    bool waiting = false;
    double here = 0, there = 0; ///< s
    double difference() const { return here - there; }
};

/// Something along the path, for charts.
struct PathPoint {
    double time = 0;     ///< of the run, s
    double distance = 0; ///< mm from the recording to the path of the run
    double delay = 0;    ///< s that the run is later than the recording since the start
};

struct Comparison {
    std::string problem;        ///< why nothing can be compared; empty: nothing
    bool atFlange = false;      ///< the recording has axis angles only, so both are compared at the flange
    double here = 0, there = 0; ///< s from 1 mm after the start pose to 1 mm before the end pose
    double median = 0, most = 0, worst = 0; ///< path distance, mm: half, 95 % and all of the path are nearer
    double worstTime = 0;                   ///< of the run, s
    robot::Vec3 worstPlace;
    const MoveResult* worstMove = nullptr;
    double offset = 0; ///< to be added to times of the recording, so that both start together
    std::vector<TimeDifference> differences; ///< in order of the program
    std::vector<PathPoint> points;
    Track track; ///< the recording as compared, times with the offset

    /// Those that matter, the largest first.
    std::vector<TimeDifference> largest(std::size_t number) const;
};

/// `analysis` must outlive the result.
Comparison compare(const RobotRecord& record, const Analysis& analysis, const Recording& recording);

} // namespace rt::report
