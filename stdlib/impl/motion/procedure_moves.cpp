// Manual 1.8: movements that execute a procedure of the program in the middle of the corner path of their point; at a stop
// point, when it is reached. The procedure runs on the level of trap routines, as one that TriggInt orders.

#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/called_name.h"
#include "stdlib/impl/support/fail.h"

#include "natives/move.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <string>
#include <utility>

using namespace rt;

namespace {

/// The name as written, and the module whose LOCAL procedures it may mean.
struct ProcedureName {
    std::string written, from;
};

/// Looked up when it is checked and again when it is called: modules come and go. An error is raised in `status`.
EntryFunction findProcedure(Task& task, const ProcedureName& name, Status& status) {
    const auto refuse = [&](Status number, const std::string& text) -> EntryFunction {
        status = lib::fail(&task, number, text);
        return nullptr;
    };
    const lib::CalledName called(name.written);
    if (!called.isValid)
        return refuse(err::ERR_CALLPROC, fmt::format("\"{}\" is not the name of a procedure", name.written));
    const RoutineEntry* routine = task.controller().tables().findRoutine(
        called.routine, called.module, name.from, static_cast<int32_t>(task.index()));
    if (routine == nullptr)
        return refuse(err::ERR_REFUNKPRC, fmt::format("there is no procedure named \"{}\"", name.written));
    if (routine->kind != kRoutineProc || routine->desc->callable == 0 || routine->address == nullptr)
        return refuse(err::ERR_CALLPROC,
                      fmt::format("'{}' is not a procedure without parameters", routine->name));
    return reinterpret_cast<EntryFunction>(routine->address);
}

Status callProcedure(Task& task, const ProcedureName& name, Frame* caller) {
    Status status = kOk;
    const EntryFunction procedure = findProcedure(task, name, status);
    return procedure != nullptr ? procedure(&task, caller) : status;
}

/// In steps the movement is finished before the procedure is executed; backwards it is not executed at all.
Status moveAndCall(TaskCore* core, motion::MoveCommand command, const lib::MoveArguments& arguments,
                   const String* procName) {
    Task& task = taskOf(core);
    if (task.interrupts().inTrap())
        return task.fatal(static_cast<int>(EventId::LevelMisused),
                          "MoveLSync, MoveJSync and MoveCSync cannot be used in a trap routine.");
    const ProcedureName name{std::string(procName->view()), task.frame->routine->module};
    Status status = kOk;
    if (findProcedure(task, name, status) == nullptr) return status;
    const InterruptTable::Call call = [name](Task& owner, Frame* caller) {
        return callProcedure(owner, name, caller);
    };
    if (!task.isStepwise()) {
        PathAction atPoint; // 0 mm before the end of the movement
        atPoint.act = [&task, call] { task.interrupts().postCall(call); };
        return lib::orderMove(core, std::move(command), arguments, {std::move(atPoint)});
    }
    status = lib::orderMove(core, std::move(command), arguments);
    if (status != kOk || task.controller().motion(task).isBackward()) return status;
    return task.passOn(task.interrupts().callNow(call));
}

} // namespace

extern "C" {

Status rt_MoveLSync(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                    const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                    data::Tooldata* Tool, data::Wobjdata* WObj, const String* ProcName,
                    data::Loaddata* TLoad) {
    return moveAndCall(task, lib::linearMove(task, *ToPoint, ID),
                       lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), ProcName);
}

Status rt_MoveJSync(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                    const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                    data::Tooldata* Tool, data::Wobjdata* WObj, const String* ProcName,
                    data::Loaddata* TLoad) {
    return moveAndCall(task, lib::jointMove(task, *ToPoint, ID),
                       lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), ProcName);
}

Status rt_MoveCSync(TaskCore* task, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                    const float* ID, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                    data::Tooldata* Tool, data::Wobjdata* WObj, const String* ProcName,
                    data::Loaddata* TLoad) {
    return moveAndCall(task, lib::circularMove(task, *CirPoint, *ToPoint, ID),
                       lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), ProcName);
}
}
