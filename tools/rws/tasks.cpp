#include "tools/rws/tasks.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"
#include "tools/rws/instruction_catalogue.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"
#include "tools/service/pointers.h"

#include <filesystem>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::Change;

constexpr const char* kTasks = "/rw/rapid/tasks";
constexpr const char* kTask = "/rw/rapid/tasks/{task}";

std::string typeOf(const rt::Task& task, Dialect dialect) {
    const bool old = dialect == Dialect::V1;
    switch (task.kind()) {
    case rt::TaskKind::Normal: return old ? "norm" : "normal";
    case rt::TaskKind::Static: return old ? "stat" : "static";
    case rt::TaskKind::SemiStatic: break;
    }
    return old ? "semi" : "semistatic";
}

/// RWS 1.0 shows four letters.
std::string stateOf(const rt::Task& task, Dialect dialect) {
    std::string state = "stopped";
    if (task.isExecuting())
        state = "started";
    else if (task.state() == rt::TaskState::Finished || task.stopCause() == rt::StopCause::AtMain)
        state = "ready";
    return dialect == Dialect::V1 ? state.substr(0, 4) : state;
}

std::string place(uint32_t line, uint32_t column) {
    return fmt::format("{},{}", line, column);
}

} // namespace

void Tasks::addTo(Router& router, Subscribables& subscribables) {
    router.getBoth(kTasks, [this](const Request& request) { return list(request); });
    router.getBoth(kTask, [this](const Request& request) { return show(request); });
    for (const bool active : {true, false}) {
        const Handler order = access_.guarded(
            Domain::Rapid, [this, active](const Request& request) { return activate(request, active); });
        const char* name = active ? "activate" : "deactivate";
        router.action(kTask, name, order);
        router.action(kTasks, name, order);
        router.post(Dialect::V2, std::string(kTasks) + "/" + name, order);
        router.post(Dialect::V2, std::string(kTask) + "/" + name, order);
    }
    addOrder(router, kTask, "loadmod", "loadmod",
             access_.guarded(Domain::Rapid, [this](const Request& request) { return loadModule(request); }));
    addOrder(
        router, kTask, "unloadmod", "unloadmod",
        access_.guarded(Domain::Rapid, [this](const Request& request) { return unloadModule(request); }));
    addOrder(router, kTask, "abortexeclevel", "abortexeclevel",
             access_.guarded(Domain::Rapid, [](const Request&) {
                 return Reply::refuse(ReturnCode::Rejected, "The task executes on its normal level");
             }));
    const Handler link = access_.guarded(Domain::Rapid, [this](const Request& request) {
        // programs are always linked: what has mistakes is not taken
        return taskOf(controller_, request) == nullptr ? noTask(request) : Reply::done();
    });
    addOrder(router, kTask, "link", "link", link);
    addOrder(router, kTask, "build", "build", link);
    for (const char* action : {"start-spy", "stop-spy"})
        router.action(kTasks, action, [](const Request&) {
            return Reply::refuse(ReturnCode::NotSupported,
                                 "RAPID spy is not supported on a virtual controller", 403);
        });
    router.getBoth(std::string(kTask) + "/serviceroutine",
                   [this](const Request& request) { return routines(request); });
    router.getBoth(std::string(kTask) + "/activation-record",
                   [this](const Request& request) { return activationRecord(request); });
    router.getBoth("/rw/rapid/taskselection", [this](const Request& request) { return selection(request); });
    router.post(Dialect::V2, "/rw/rapid/taskselection",
                access_.guarded(Domain::Rapid, [this](const Request& request) { return select(request); }));
    addCounters(router);
    subscribe(subscribables);
}

void Tasks::addCounters(Router& router) {
    router.getBoth(std::string(kTask) + "/structural-changecount", [this](const Request& request) {
        const rt::Task* task = taskOf(controller_, request);
        if (task == nullptr) return noTask(request);
        const std::string count = std::to_string(controller_.structuralChanges(*task));
        Document document;
        document.add("rap-task-struc-change-count", "change-count")
            .value("change-count", count)
            .value("struc-change-count", count);
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, std::string(kTasks) + "/spy", [](const Request&) {
        Document document;
        document.add("rap-spy-status", "spy").value("status", "Not Logging");
        return Reply::of(std::move(document));
    });
    for (const char* which : {"program-pointer", "motion-pointer"}) {
        const Handler state = [which](const Request& request) {
            Document document;
            document
                .add(request.parameter("task").empty() ? "rap-sync-state" : "rap-task-sync-state",
                     "syncstate")
                .value(std::string(which) + "-state", "On");
            return Reply::of(std::move(document));
        };
        router.get(Dialect::V2, std::string(kTasks) + "/syncstate/" + which, state);
        router.get(Dialect::V2, std::string(kTask) + "/syncstate/" + which, state);
    }
}

void Tasks::subscribe(Subscribables& subscribables) {
    const auto add = [&](const char* pattern, const char* resource, const char* type,
                         std::set<Change> changes, std::function<void(const rt::Task&, Entry&)> fill) {
        subscribables.add(
            {pattern,
             resource,
             false,
             {},
             [this, resource, type, changes, fill](const Request& request, const Changed& changed,
                                                   Subscription& out) -> std::optional<Failure> {
                 const std::string& name = request.parameter("task");
                 if (!name.empty() && controller_.core().findTask(name) == nullptr) return unknownTask(name);
                 return watchState(
                     controller_.observers(), changes,
                     [this, name, resource, type, fill] {
                         Entry entry;
                         entry.type = type;
                         entry.title = resource;
                         for (const auto& task : controller_.core().tasks())
                             if (name.empty() || sameName(task->name(), name)) fill(*task, entry);
                         return entry;
                     },
                     changed, out);
             }});
    };
    const auto ofTask = [this](const rt::Task& task, Entry& entry) {
        entry.value("task-name", task.name())
            .value("change-count", std::to_string(controller_.structuralChanges(task)))
            .value("excstate", stateOf(task, Dialect::V2))
            .value("active", controller_.isTaskActive(task) ? "On" : "Off");
    };
    // One text for all tasks: an event is to stay small.
    const auto ofAll = [this](const rt::Task& task, Entry& entry) {
        if (entry.values.empty()) entry.value("taskchange", "");
        entry.values.front().second +=
            fmt::format("{}{} {} {} {}", entry.values.front().second.empty() ? "" : ";", task.name(),
                        stateOf(task, Dialect::V2), controller_.isTaskActive(task) ? "On" : "Off",
                        controller_.structuralChanges(task));
    };
    const std::set<Change> changes{Change::Tasks, Change::Modules, Change::Execution};
    add(kTask, "taskchange", "rap-task-change-ev", changes, ofTask);
    add(kTasks, "taskchange", "rap-task-change-ev", changes, ofAll);
    add(kTask, "excstate", "rap-task-excstate-ev", {Change::Tasks, Change::Execution},
        [](const rt::Task& task, Entry& entry) {
            entry.value("task-name", task.name()).value("pgmtaskexec-state", stateOf(task, Dialect::V2));
        });
}

/// A parameter of the task in SYS.cfg.
std::string Tasks::parameterOf(const rt::Task& task, const char* name, const char* otherwise) const {
    for (const rt::CfgInstance* instance : controller_.core().instances("SYS", "CAB_TASKS"))
        if (sameName(instance->text("Name"), task.name()))
            if (const std::string text = instance->text(name); !text.empty()) return text;
    return otherwise;
}

void Tasks::describe(const rt::Task& task, Dialect dialect, Entry& entry) const {
    entry.value("name", task.name())
        .value("type", typeOf(task, dialect))
        .value("taskstate", dialect == Dialect::V1 ? "link" : "linked")
        .value("excstate", stateOf(task, dialect))
        .value("active", controller_.isTaskActive(task) ? "On" : "Off")
        .value("motiontask", task.isMotionTask() ? "TRUE" : "FALSE");
}

Reply Tasks::list(const Request& request) {
    if (sameName(request.query.text("resource"), "task-sync-state")) return synchronisation(request);
    Document document;
    document.place = Document::Place::Resources;
    for (const auto& task : controller_.core().tasks()) {
        Entry& entry = document.add("rap-task-li", task->name());
        entry.self = "tasks/" + task->name();
        describe(*task, request.dialect, entry);
    }
    if (request.dialect == Dialect::V2) document.add("rap-tasks-spy-li", "spy").self = "tasks/spy";
    return Reply::of(std::move(document));
}

Reply Tasks::show(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    if (const std::string resource = request.query.text("resource"); !resource.empty()) {
        if (sameName(resource, "activation-record")) return activationRecord(request);
        if (sameName(resource, "task-sync-state")) return synchronisation(request);
        if (sameName(resource, "pallet-head")) return subjectsOfInstructions(controller_, request);
        if (sameName(resource, "pallet"))
            return instructionsOf(controller_, request, request.query.text("number"));
        if (!sameName(resource, "structural-change-count") && !sameName(resource, "structural-changecount"))
            return badParameter("resource", "activation-record, structural-change-count, task-sync-state, "
                                            "pallet-head or pallet");
        Document document;
        document.add("rap-task-struc-change-count", "change-count")
            .value("change-count", std::to_string(controller_.structuralChanges(*task)));
        return Reply::of(std::move(document));
    }
    const auto& checked = controller_.program().compilation().program->tasks;
    Document document;
    Entry& entry = document.add("rap-task", task->name());
    describe(*task, request.dialect, entry);
    entry.value("trust", parameterOf(*task, "TrustLevel", "SysFail"))
        .value("taskID", std::to_string(task->index()))
        .value("execlevel", "Normal")
        .value("execmode", "Continous") // spelled so on controllers
        .value("exectype", task->isExecuting() ? "Normal" : "None")
        .value("prodentrypt", task->index() < checked.size() ? checked[task->index()]->entry : "main")
        .value("bind_ref", boolText(!sameName(parameterOf(*task, "BindRef", "yes"), "no")))
        .value("task_in_forgnd", task->foreground() ? task->foreground()->name() : "");
    return Reply::of(std::move(document));
}

/// RWS 1.0. Pointers that are set together stay together.
Reply Tasks::synchronisation(const Request& request) {
    const std::string type = request.query.text("type");
    const bool isMotion = sameName(type, "motion-pointer");
    if (!isMotion && !sameName(type, "program-pointer"))
        return badParameter("type", "program-pointer or motion-pointer");
    Document document;
    document.add("rap-sync-state", "sync-state")
        .value(isMotion ? "Motion-Pointer-State" : "Program-Pointer-State", "On");
    return Reply::of(std::move(document));
}

Reply Tasks::activate(const Request& request, bool active) {
    const bool all = request.parameter("task").empty() && request.form.text("task").empty() &&
                     request.dialect == Dialect::V1;
    if (!all) {
        rt::Task* task = taskOf(controller_, request);
        if (task == nullptr) return noTask(request);
        if (controller_.isTaskActive(*task) == active) return Reply::done();
        return replyTo(controller_.setTaskActive(*task, active));
    }
    for (const auto& task : controller_.core().tasks()) {
        if (task->kind() != rt::TaskKind::Normal || controller_.isTaskActive(*task) == active) continue;
        if (const service::Refusal refusal = controller_.setTaskActive(*task, active); !refusal.empty())
            return replyTo(refusal);
    }
    return Reply::done();
}

Reply Tasks::loadModule(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string given = request.form.text("modulepath");
    if (given.empty()) return badParameter("modulepath", "the path of a module, such as $HOME/part.mod");
    const std::string replaceText = request.form.text("replace");
    const std::optional<bool> replace = replaceText.empty() ? false : flagIn(replaceText);
    if (!replace) return badParameter("replace", "true or false");
    const std::optional<VolumePath> path = volumePath(controller_, given);
    std::error_code code;
    if (!path || !std::filesystem::is_regular_file(path->host, code))
        return Reply::refuse(ReturnCode::NoLoadPath, "There is no file " + given);
    return replyTo(controller_.loadModule(*task, path->host, path->rapid, *replace), ReturnCode::Rejected,
                   400);
}

Reply Tasks::unloadModule(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string module = request.form.text("module");
    if (module.empty()) return badParameter("module", "the name of a module");
    if (controller_.core().tables().findModule(static_cast<int32_t>(task->index()), module) == nullptr)
        return Reply::refuse(request.dialect == Dialect::V1 ? ReturnCode::UnknownSymbol
                                                            : ReturnCode::NoModule,
                             "There is no module " + module + " in task " + task->name());
    return replyTo(controller_.unloadModule(*task, module), ReturnCode::Rejected, 400);
}

Reply Tasks::selection(const Request&) {
    Document document;
    for (const auto& task : controller_.core().tasks())
        if (task->kind() == rt::TaskKind::Normal)
            document.add("rap-taskselection", task->name())
                .value("name", task->name())
                .value("state", controller_.isTaskActive(*task) ? "ON" : "OFF")
                .value("motiontask", task->isMotionTask() ? "TRUE" : "FALSE")
                .value("usermodify", "TRUE");
    return Reply::of(std::move(document));
}

/// task-1, task-2 ...: the tasks that are active; the other NORMAL tasks become inactive.
Reply Tasks::select(const Request& request) {
    std::set<const rt::Task*> selected;
    for (const auto& [name, value] : request.form.all()) {
        if (!name.starts_with("task-")) continue;
        const rt::Task* task = controller_.core().findTask(value);
        if (task == nullptr) return badParameter(name, "the name of a task");
        selected.insert(task);
    }
    for (const auto& task : controller_.core().tasks()) {
        const bool active = selected.contains(task.get());
        if (task->kind() != rt::TaskKind::Normal || controller_.isTaskActive(*task) == active) continue;
        if (const service::Refusal refusal = controller_.setTaskActive(*task, active); !refusal.empty())
            return replyTo(refusal);
    }
    return Reply::done();
}

/// The place of one routine in progress.
Reply Tasks::activationRecord(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const auto frames = controller_.core().debugger().frames(*task);
    const std::string asked = request.query.text("stackframe");
    const auto number = wholeIn(asked.empty() ? "0" : asked, 0, INT32_MAX);
    if (!number) return badParameter("stackframe", "a number from 0");
    rt::SourcePlace at;
    const auto pointer = service::programPointer(controller_, *task);
    if (static_cast<std::size_t>(*number) < frames.size()) {
        at = frames[static_cast<std::size_t>(*number)].place;
    } else if (*number == 0 && pointer) { // before the first instruction
        at.module = pointer->module;
        at.routine = pointer->routine;
        at.line = pointer->beginLine;
        at.column = pointer->beginColumn;
    } else {
        return Reply::refuse(ReturnCode::BadParameter, "No such stack frame");
    }
    Document document;
    document.add("rap-activation-record", std::to_string(*number))
        .value("modulename", at.module)
        .value("routinename", at.routine)
        .value("routineurl", fmt::format("RAPID/{}/{}/{}", task->name(), at.module, at.routine))
        .value("begposition", place(at.line, at.column));
    return Reply::of(std::move(document));
}

/// Procedures without parameters: those that the program pointer can be moved to.
Reply Tasks::routines(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::optional<Page> page = readPage(request, 100, 100);
    if (!page) return Reply::refuse(ReturnCode::BadPage, "start or limit is not a number");
    const auto index = static_cast<int32_t>(task->index());
    Document document;
    std::size_t number = 0;
    for (const rt::RoutineEntry* routine : controller_.core().tables().routines()) {
        if ((routine->task >= 0 && routine->task != index) || routine->kind != rt::kRoutineProc ||
            routine->desc->callable == 0 || routine->desc->isBuiltin != 0)
            continue;
        if (number++ < page->start) continue;
        if (document.entries.size() == page->limit) {
            document.next = fmt::format("tasks/{}/serviceroutine?start={}&limit={}", task->name(),
                                        page->start + page->limit, page->limit);
            break;
        }
        const std::string url = fmt::format("RAPID/{}/{}/{}", task->name(), routine->module, routine->name);
        Entry& entry = document.add("rap-task-routine", routine->name);
        entry.value("routine-name", routine->name)
            .value("service-routine", "TRUE")
            .value("url-to-routine", url);
        if (request.dialect == Dialect::V2)
            entry.value("routine_name", routine->name).value("url_to_routine", url);
    }
    return Reply::of(std::move(document));
}

} // namespace rapidc::rws
