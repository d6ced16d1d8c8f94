#pragma once
// RunOptions: the options of `rapidc run`, which a built executable has too, and how they are read.

#include "runtime/net/network_options.h"
#include "runtime/sched/scheduler.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rt {

class Command;

/// Files that a run writes, by path; "" = not asked for.
struct RunOutputs {
    std::string trace, signals, events, errors;
    bool motors = false; ///< the trace has the positions of the motors, too
    std::string picture, report;
    std::string compare;  ///< a recording to compare with: it is read
    bool summary = false; ///< prints what slowed the movements, at the end
};

struct RunOptions {
    int64_t cycles = 1;             ///< how often main is run; 0 = for ever
    std::vector<std::string> tasks; ///< --task=NAME[:TYPE]=INPUT; used by `rapidc run` alone
    std::vector<std::string> configFiles;
    /// Each MODEL, of the first robot, or UNIT=MODEL; without one that of the configuration, else kDefaultRobot.
    std::vector<std::string> robots;
    std::vector<std::string> conveyors; ///< NAME=KEY:VALUE,...
    std::string planner = "measured";   ///< how movements are timed: measured or optimal
    Time tick = 4 * kMillisecond;       ///< ns: period of motion, of samples of the trace for one
    std::string home;                   ///< "" = an empty folder that is removed at the end
    std::vector<std::string> volumes;   ///< NAME=DIR: further disks
    std::vector<std::string> devices;   ///< NAME=FILE[,FILE]: serial channels and printers
    std::vector<std::string> cameras;   ///< NAME=FILE: cameras and their results
    std::string stimulus;               ///< path; "" = none
    /// The text of `stimulus`, when it has been read: a pipe is read once.
    std::optional<std::string> stimulusText;
    RunOutputs outputs;
    bool realtime = false;
    net::NetworkOptions network;
    std::string state;     ///< folder in which the controller's state survives the process; "" = none
    bool ppToMain = false; ///< with `state`: NORMAL tasks begin at main
    bool save = false;     ///< values of persistents go back into the source files
    double maxTime = 0;    ///< s of virtual time; meant only when hasMaxTime
    bool hasMaxTime = false;
    uint32_t seed = 1;                 ///< for Rand and nothing else
    int64_t rate = kDefaultRate;       ///< instructions per ms
    std::size_t stackBytes = 8u << 20; ///< per task
};

inline constexpr const char* kDefaultRobot = "IRB 120-3/0.58";

/// Exit statuses.
enum class ExitStatus : int {
    Ended = 0, ///< the program ended
    StoppedByError = 1,
    BadProgram = 2, ///< does not compile, or what it names is not configured
    BadUsage = 3,
    MaxTimeReached = 4,
    Interrupted = 128, ///< plus the number of the signal (StopSignals)
};

/// Adds the options above to a command. `withTasks`: also --task (not for built executables).
void addRunOptions(const Command& command, RunOptions& options, bool withTasks);

} // namespace rt
