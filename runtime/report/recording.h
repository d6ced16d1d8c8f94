#pragma once
// A recording to compare a run with: a trace of rapidc, or what a real robot has logged. CSV with a line of names.

#include "runtime/report/run_record.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt::report {

struct RecordedSample {
    double time = 0;        ///< s
    robot::Vec3 position;   ///< mm, TCP in world; meant only with Recording::hasPositions
    robot::Joints joints{}; ///< deg; meant only with Recording::hasJoints
};

struct Recording {
    std::string file;
    std::string unit; ///< name of the robot; "" when the file names none
    bool hasPositions = false, hasJoints = false;
    std::vector<RecordedSample> samples; ///< two at least, in order of time
};

/// Columns in any order, by name, case and blanks aside: `time_s` (time, t; time_ms); `j1`..`j6` (joint1, axis1, rax_1; `[rad]`
/// after the name) or `x`, `y`, `z` (tcp_x, pos_x; `[m]` after the name), or both; others are left aside. Separated by
/// commas, semicolons (numbers may then have decimal commas) or tabs; empty lines and lines that begin with # are left out.
/// With a column `unit` (robot, mechunit) there is one recording for each robot, in the order in which they come.
///
/// Returns what is wrong, for people, with file, line and remedy ("rec.csv:7: ..."); empty: success.
[[nodiscard]] std::string parseRecording(std::string_view text, const std::string& file,
                                         std::vector<Recording>& recordings);
[[nodiscard]] std::string readRecording(const std::string& file, std::vector<Recording>& recordings);
/// The recording for each robot of the run, null where there is none: the one with its name. A recording without a name is of the
/// first robot, and that of a single robot of the only one.
std::vector<const Recording*> recordingsFor(const std::vector<RobotRecord>& robots,
                                            const std::vector<Recording>& recordings);

} // namespace rt::report
