#pragma once
// The common part of all movement instructions: their arguments, and how a move is ordered (manual 1.8).

#include "stdlib/impl/motion/state.h"

#include <vector>

namespace rt::lib {

/// The arguments every positioning instruction has; those that point may be null.
struct MoveArguments {
    bool conc = false;
    const data::Speeddata* speed = nullptr; ///< always given
    const float* v = nullptr;
    const float* t = nullptr;
    const data::Zonedata* zone = nullptr; ///< always given
    const float* z = nullptr;
    const data::Stoppointdata* inpos = nullptr;
    const data::Tooldata* tool = nullptr; ///< always given
    const data::Wobjdata* workObject = nullptr;
    bool exactConfiguration = false; ///< a line ends in the configuration of its target, even with ConfL \Off
    const data::Loaddata* totalLoad = nullptr; ///< \TLoad
    bool movesGun = false;                     ///< also external axes that are independent of the robot
};

/// Those of instructions that have no \Conc, \V, \Z and \Inpos.
MoveArguments plainArguments(const data::Speeddata* speed, const float* t, const data::Zonedata* zone,
                             const data::Tooldata* tool, const data::Wobjdata* workObject,
                             const data::Loaddata* totalLoad);

/// The movement to a target; the rest of the command is completed by orderMove. `id`: \ID, null when it is not given.
motion::MoveCommand jointMove(TaskCore* task, const data::Robtarget& target, const float* id);
motion::MoveCommand linearMove(TaskCore* task, const data::Robtarget& target, const float* id);
motion::MoveCommand circularMove(TaskCore* task, const data::Robtarget& circlePoint,
                                 const data::Robtarget& target, const float* id);
motion::MoveCommand absoluteMove(TaskCore* task, const data::Jointtarget& target, bool noOffsets,
                                 const float* id);

/// The additional axes to these places; the arm stays where its last movement ends.
motion::MoveCommand externalMove(TaskCore* task, const data::Jointtarget& target, bool withOffsets,
                                 const float* id);

/// Completes the command with what is common, orders it with what is to be done on its path, and waits until the program
/// may continue.
Status orderMove(TaskCore* task, motion::MoveCommand command, const MoveArguments& arguments,
                 std::vector<PathAction> actions = {});

} // namespace rt::lib
