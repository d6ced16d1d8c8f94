// Movements between welds (ArcMove...): as the Move instructions without Arc in their names.

#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/move_order.h"

#include "natives/arc_moves.h"
#include "natives/move.h"

using namespace rt;

extern "C" {

Status rt_ArcMoveJ(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                   const data::Speeddata* Speed, const float* V, const float* T, const data::Zonedata* Zone,
                   const float* Z, const data::Stoppointdata* Inpos, data::Tooldata* Tool,
                   data::Wobjdata* WObj, data::Loaddata*) {
    return lib::orderMove(task, lib::jointMove(task, *ToPoint, ID),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_ArcMoveL(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                   const data::Speeddata* Speed, const float* V, const float* T, const data::Zonedata* Zone,
                   const float* Z, const data::Stoppointdata* Inpos, data::Tooldata* Tool,
                   data::Wobjdata* WObj, bool Corr, data::Loaddata*) {
    return lib::orderMove(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_ArcMoveC(TaskCore* task, bool Conc, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                   const float* ID, const data::Speeddata* Speed, const float* V, const float* T,
                   const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                   data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr, data::Loaddata*) {
    return lib::orderMove(task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_ArcMoveAbsJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                      bool NoEOffs, const data::Speeddata* Speed, const float* V, const float* T,
                      const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                      data::Tooldata* Tool, data::Wobjdata* WObj, data::Loaddata*) {
    return lib::orderMove(task, lib::absoluteMove(task, *ToJointPos, NoEOffs, ID),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

/// \Start (a weld begins at the point) makes no difference.
Status rt_ArcMoveExtJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                      bool UseEOffs, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                      const data::Stoppointdata* Inpos, bool) {
    return rt_MoveExtJ(task, Conc, ToJointPos, ID, UseEOffs, Speed, T, Zone, Inpos);
}
}
