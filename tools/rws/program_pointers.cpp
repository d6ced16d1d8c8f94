#include "tools/rws/program_pointers.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"
#include "tools/service/pointers.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::Change;
using service::PointerPlace;

constexpr const char* kPointersPath = "/rw/rapid/tasks/{task}/pcp";

std::string position(uint32_t line, uint32_t column) {
    return line == 0 ? std::string() : fmt::format("{},{}", line, column);
}

Entry& add(Document& document, const char* title, const std::optional<PointerPlace>& found,
           uint64_t changes) {
    const bool isProgram = std::string_view(title) == "progpointer";
    const PointerPlace place = found.value_or(PointerPlace{});
    Entry& entry = document.add("pcp-info", title);
    // controllers spell the name of the module in two ways
    if (isProgram) entry.value("modulemame", place.module);
    return entry.value("modulename", place.module)
        .value("routinename", place.routine)
        .value(isProgram ? "beginposition" : "begposition", position(place.beginLine, place.beginColumn))
        .value("endposition", position(place.endLine, place.endColumn))
        .value("changecount", std::to_string(changes))
        .value("executiontype", place.executionType);
}

std::string number(uint32_t value) {
    return value == 0 ? std::string() : std::to_string(value);
}

Entry eventOf(const char* type, const char* title, const std::string& task,
              const std::optional<PointerPlace>& found) {
    const PointerPlace place = found.value_or(PointerPlace{});
    Entry entry;
    entry.type = type;
    entry.title = title;
    entry.value("task-name", task)
        .value("module-name", place.module)
        .value("routine-name", place.routine)
        .value("BegPosLine", number(place.beginLine))
        .value("BegPosCol", number(place.beginColumn))
        .value("EndPosLine", number(place.endLine))
        .value("EndPosCol", number(place.endColumn));
    return entry;
}

} // namespace

void ProgramPointers::addTo(Router& router, Subscribables& subscribables) {
    router.getBoth(kPointersPath, [this](const Request& request) { return show(request); });
    const auto order = [&](const char* oldName, const char* newName,
                           Reply (ProgramPointers::*handler)(const Request&)) {
        addOrder(router, kPointersPath, oldName, newName,
                 access_.guarded(Domain::Rapid, [this, handler](const Request& request) {
                     return (this->*handler)(request);
                 }));
    };
    order("set-pp-routine", "routine", &ProgramPointers::toRoutine);
    order("set-pp-routine-from-url", "routine-from-url", &ProgramPointers::toUrl);
    order("set-pp-cursor", "cursor", &ProgramPointers::toCursor);
    order("set-pp-main", "reset", &ProgramPointers::toMain);
    router.action(kPointersPath, "reset",
                  access_.guarded(Domain::Rapid, [this](const Request& request) { return toMain(request); }));
    for (const bool forward : {true, false}) {
        const Handler step = access_.guarded(
            Domain::Rapid, [this, forward](const Request& request) { return along(request, forward); });
        const std::string name = forward ? "next-inst" : "prev-inst";
        addOrder(router, kPointersPath, ("set-pp-" + name).c_str(), name.c_str(), step);
        router.action(kPointersPath, name, step);
    }
    const auto watch = [this](const char* type, const char* title, Change change, auto read) {
        return [this, type, title, change, read](const Request& request, const Changed& changed,
                                                 Subscription& out) -> std::optional<Failure> {
            const std::string& name = request.parameter("task");
            if (controller_.core().findTask(name) == nullptr) return unknownTask(name);
            return watchState(
                controller_.observers(), {change},
                [this, type, title, name, read] {
                    const rt::Task* task = controller_.core().findTask(name);
                    return eventOf(type, title, name, task ? read(controller_, *task) : std::nullopt);
                },
                changed, out);
        };
    };
    subscribables.add(
        {kPointersPath,
         "programpointerchange",
         false,
         {},
         watch("rap-pp-ev", "programpointerchange", Change::ProgramPointer, service::programPointer)});
    subscribables.add(
        {kPointersPath,
         "motionpointerchange",
         false,
         {},
         watch("rap-mp-ev", "motionpointerchange", Change::MotionPointer, service::motionPointer)});
}

Reply ProgramPointers::show(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const uint64_t changes = controller_.structuralChanges(*task);
    Document document;
    add(document, "progpointer", programPointer(controller_, *task), changes);
    add(document, "motionpointer", motionPointer(controller_, *task), changes);
    return Reply::of(std::move(document));
}

Reply ProgramPointers::toRoutine(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string module = request.form.text("module"), routine = request.form.text("routine");
    if (routine.empty()) return badParameter("routine", "the name of a procedure");
    return replyTo(controller_.pointerToRoutine(*task, module, routine), ReturnCode::BadParameter);
}

/// "RAPID/T_ROB1/Module1/part"
Reply ProgramPointers::toUrl(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    std::string url = request.form.text("routineurl");
    if (url.empty()) url = request.form.text("routine");
    std::vector<std::string> names = splitPath(url);
    if (!names.empty() && sameName(names.front(), "RAPID")) names.erase(names.begin());
    if (names.size() != 3 || !sameName(names[0], task->name()))
        return badParameter("routineurl", "RAPID/" + task->name() + "/MODULE/ROUTINE");
    return replyTo(controller_.pointerToRoutine(*task, names[1], names[2]), ReturnCode::BadParameter);
}

Reply ProgramPointers::toLine(rt::Task& task, const std::string& module, uint32_t line) {
    return replyTo(controller_.pointerToLine(task, module, line), ReturnCode::BadParameter);
}

Reply ProgramPointers::toCursor(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string module = request.form.text("module");
    std::string row = request.form.text("begin-position-row");
    if (row.empty()) row = request.form.text("line");
    const auto line = wholeIn(row, 1, kMostLine);
    if (module.empty()) return badParameter("module", "the name of a module");
    if (!line) return badParameter("begin-position-row", "the number of a line");
    if (controller_.core().tables().findModule(static_cast<int32_t>(task->index()), module) == nullptr)
        return Reply::refuse(ReturnCode::NoModule, "There is no module " + module);
    return toLine(*task, module, static_cast<uint32_t>(*line));
}

/// Of one task, by way of its main; the pointers of the others stay.
Reply ProgramPointers::toMain(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    if (task->isExecuting())
        return Reply::refuse(ReturnCode::Rejected, "The task is executing: stop it first");
    task->moveToMain();
    if (task->isMotionTask()) controller_.core().motion(*task).clearPath();
    controller_.observers().changed(Change::ProgramPointer, task);
    return Reply::done();
}

/// To the statement before or after the present one in its routine.
Reply ProgramPointers::along(const Request& request, bool forward) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::optional<PointerPlace> now = programPointer(controller_, *task);
    if (!now) return Reply::refuse(ReturnCode::NoPointer, "The program pointer is not set");
    uint32_t best = 0;
    for (const rt::RoutineEntry* routine : controller_.core().tables().routines()) {
        const rt::RoutineDesc& desc = *routine->desc;
        if (!sameName(desc.name, now->routine) || !sameName(desc.module, now->module)) continue;
        for (uint32_t i = 0; i < desc.statementCount; ++i) {
            const uint32_t line = desc.statements[i].line;
            const bool fits = forward ? line > now->beginLine && (best == 0 || line < best)
                                      : line < now->beginLine && line > best;
            if (fits && desc.statements[i].canStart != 0) best = line;
        }
    }
    if (best == 0)
        return Reply::refuse(ReturnCode::Rejected, "There is no such instruction in the routine", 400);
    return toLine(*task, now->module, best);
}

} // namespace rapidc::rws
