#pragma once
// RunRecord: what a run leaves for its report: samples of the motion, movements as programmed, signals, events.

#include "runtime/base/source_place.h"
#include "runtime/motion/move_command.h"
#include "runtime/robot/robot_model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rt::report {

/// The arm at one moment. While it is at rest, the first and the last sample say all.
struct Sample {
    double time = 0;                                         ///< s
    motion::Joints joints{};                                 ///< deg
    motion::ExternalAxes external = motion::kNoExternalAxes; ///< deg, mm
    motion::Vec3 position;                                   ///< TCP in world, mm
    motion::Quat rotation;
    double speed = 0;  ///< TCP, mm/s
    uint64_t move = 0; ///< number of the move instruction, 0 before the first
};

/// The instruction of a movement as the source has it; empty where the source is not at hand.
struct MoveText {
    std::string instruction; ///< "MoveL"
    std::string target;      ///< "pPick", "Offs(pPick,0,0,80)"
    bool isName = false;     ///< the target is a name, perhaps with indices or components
};

/// A movement as programmed.
struct Move {
    uint64_t number = 0; ///< Sample::move
    motion::MoveKind kind = motion::MoveKind::AbsJoint;
    SourcePlace place; ///< empty when it is not known
    MoveText text;
    motion::Vec3 end;                                  ///< programmed TCP in world, mm
    double speed = 0;                                  ///< mm/s, with VelSet
    double turnSpeed = 0;                              ///< deg/s, with VelSet
    double externalTurnSpeed = 0;                      ///< of rotating external axes, deg/s, with VelSet
    double externalSpeed = 0;                          ///< of linear ones, mm/s, with VelSet
    double duration = 0;                               ///< \T in s; 0 = not given
    bool isTogether = false;                           ///< \ID: other robots move with this one
    bool stopPoint = true;                             ///< fine, or Inpos
    double zone = 0;                                   ///< radius of a fly-by point, mm
    double acceleration = 1;                           ///< share of the robot's, AccSet
    double pathAcceleration = 0, pathDeceleration = 0; ///< PathAccLim, mm/s^2; 0 = no limit
};

struct SignalTrack {
    struct Change {
        double time = 0;
        double value = 0;
    };
    std::string name, type; ///< "DO"
    double initial = 0;
    std::vector<Change> changes;
};

/// An event of the log, or a line that the program has written for the operator.
struct Marker {
    double time = 0;
    std::string kind; ///< "error", "warning", "information", "line"
    int number = 0;   ///< of the event
    std::string title, text;
};

/// An external axis of a motion group.
struct ExternalAxis {
    std::string name;      ///< of its SINGLE or JOINT
    std::size_t index = 0; ///< 0 is eax_a
    bool rotating = true;  ///< degrees, else mm
    double maxSpeed = 0, maxAcceleration = 0;
};

/// A robot with the external axes of its motion group, or external axes alone.
struct RobotRecord {
    std::string unit;        ///< "ROB_1"; of external axes alone the first unit
    robot::RobotModel robot; ///< without axes for external axes alone
    bool hasArm = true;      ///< there is a TCP
    std::vector<ExternalAxis> external;
    std::vector<Sample> samples;
    std::vector<Move> moves; ///< in order of their numbers
    double end = 0;          ///< virtual time at the end of the run, s

    const Move* find(uint64_t number) const;
};

struct RunRecord {
    std::string program;
    std::vector<RobotRecord> robots;  ///< one a motion group, one at least
    std::vector<SignalTrack> signals; ///< as configured
    std::vector<Marker> markers;

    /// Virtual time at the end of the run, s.
    double end() const { return robots.empty() ? 0 : robots.front().end; }
};

/// "Module:17"; "movement 3" when the place is not known.
std::string placeName(const Move& move);
/// The end of the movement as people call it: the name of its target, else "line 17", else "movement 3".
std::string pointName(const Move& move);
/// The instruction and its target, or what kind of movement it is.
std::string instructionName(const Move& move);

} // namespace rt::report
