#include "tools/service/pointers.h"

#include "config/letter_case.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::service {

namespace {

PointerPlace placeOf(const rt::RoutineDesc& routine, int32_t statement) {
    PointerPlace place;
    place.module = routine.module;
    place.routine = routine.name;
    place.executionType = "Normal";
    if (statement < 0 || static_cast<uint32_t>(statement) >= routine.statementCount) return place;
    const rt::StmtDesc& at = routine.statements[statement];
    place.beginLine = at.line;
    place.beginColumn = at.column;
    place.endLine = at.endLine;
    place.endColumn = at.endColumn > 1 ? at.endColumn - 1 : 1; // the description names the place after it
    return place;
}

/// The statement that follows in the same list; the statement itself when it is the last one.
int32_t following(const rt::RoutineDesc& routine, int32_t statement) {
    for (uint32_t i = 0; i < routine.statementCount; ++i)
        if (routine.statements[i].previous == statement) return static_cast<int32_t>(i);
    return statement;
}

/// The first statement of the routine that the next start begins with.
std::optional<PointerPlace> beginning(VirtualController& controller, const rt::Task& task) {
    const rt::ProgramTables& tables = controller.core().tables();
    const auto index = static_cast<int32_t>(task.index());
    const rt::RoutineEntry* entry = nullptr;
    for (const rt::RoutineEntry* routine : tables.routines()) {
        const bool isOwn = routine->task < 0 || routine->task == index;
        if (isOwn && routine->address == reinterpret_cast<const void*>(task.nextEntry())) entry = routine;
    }
    if (entry == nullptr) { // main may be reached by a function of its own
        const auto& tasks = controller.program().compilation().program->tasks;
        const std::string name = task.index() < tasks.size() ? tasks[task.index()]->entry : "main";
        entry = tables.findRoutine(name, {}, {}, index);
    }
    if (entry == nullptr || entry->desc == nullptr) return std::nullopt;
    int32_t first = -1;
    for (uint32_t i = 0; i < entry->desc->statementCount; ++i) {
        const rt::StmtDesc& statement = entry->desc->statements[i];
        const bool isEarlier = first < 0 || statement.line < entry->desc->statements[first].line;
        if (statement.canStart == rt::kCannotStart) continue; // initial values of declarations
        if (statement.previous < 0 && isEarlier) first = static_cast<int32_t>(i);
    }
    return placeOf(*entry->desc, first);
}

/// The statement that begins in that line.
std::optional<PointerPlace> placeInLine(VirtualController& controller, const rt::Task& task,
                                        const std::string& module, uint32_t line) {
    for (const rt::RoutineEntry* routine : controller.core().tables().routines()) {
        const bool isOwn = routine->task < 0 || routine->task == static_cast<int32_t>(task.index());
        if (!isOwn || !rapid::config::sameName(routine->module, module)) continue;
        for (uint32_t i = 0; i < routine->desc->statementCount; ++i)
            if (routine->desc->statements[i].canStart != 0 && routine->desc->statements[i].line == line)
                return placeOf(*routine->desc, static_cast<int32_t>(i));
    }
    return std::nullopt;
}

} // namespace

std::optional<PointerPlace> programPointer(VirtualController& controller, const rt::Task& task) {
    if (const auto destination = controller.destination(task))
        return placeInLine(controller, task, destination->first, destination->second);
    const bool begins = task.stopCause() == rt::StopCause::AtMain || task.state() == rt::TaskState::Finished;
    if (begins || task.frame == nullptr) return beginning(controller, task);
    const auto frames = controller.core().debugger().frames(task);
    for (const rt::DebugFrame& at : frames) {
        const rt::Frame* frame = at.frame;
        if (frame == nullptr || frame->routine->isBuiltin != 0 || frame->routine->statementCount == 0)
            continue;
        const bool isDone = task.standing() == rt::Standing::AfterStop && frame == task.frame;
        const int32_t statement = isDone ? following(*frame->routine, frame->statement) : frame->statement;
        PointerPlace place = placeOf(*frame->routine, statement);
        if (frames.front().isTrap) place.executionType = "Interrupt";
        return place;
    }
    return beginning(controller, task);
}

std::optional<PointerPlace> motionPointer(VirtualController& controller, const rt::Task& task) {
    if (!task.isMotionTask()) return std::nullopt;
    const rt::MotionPointer& pointer = controller.core().motion(task).pointer();
    if (!pointer.valid || pointer.routine == nullptr) return std::nullopt;
    return placeOf(*pointer.routine, pointer.statement);
}

} // namespace rapidc::service
