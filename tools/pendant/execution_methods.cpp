// run.*: start, stop, steps, pointers; tasks.

#include "config/json_text.h"
#include "runtime/host/motion_driver.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"

#include <set>

namespace rapidc::pendant {

namespace {

using service::Change;
using service::ExecutionMode;
using service::StopMode;

constexpr Word<ExecutionMode> kStarts[] = {
    {"continue", ExecutionMode::Continue}, {"stepIn", ExecutionMode::StepIn},
    {"stepOver", ExecutionMode::StepOver}, {"stepOut", ExecutionMode::StepOut},
    {"stepBack", ExecutionMode::StepBack}, {"stepMove", ExecutionMode::StepMotion},
};
constexpr Word<StopMode> kStops[] = {
    {"stop", StopMode::Stop},
    {"cycle", StopMode::Cycle},
    {"instruction", StopMode::Instruction},
    {"quick", StopMode::Quick},
};

const char* kindOf(const rt::Task& task) {
    switch (task.kind()) {
    case rt::TaskKind::Normal: return "normal";
    case rt::TaskKind::Static: return "static";
    case rt::TaskKind::SemiStatic: break;
    }
    return "semistatic";
}

const char* stateOf(const rt::Task& task) {
    if (task.isExecuting()) return "running";
    if (task.state() == rt::TaskState::Finished) return "ended";
    return task.stopCause() == rt::StopCause::AtMain ? "ready" : "stopped";
}

class ExecutionArea final : public Area {
  public:
    explicit ExecutionArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.changed = [this](Change change, const rt::Task* task) { note(change, task); };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~ExecutionArea() override { controller_.observers().remove(observer_); }
    ExecutionArea(const ExecutionArea&) = delete;
    ExecutionArea& operator=(const ExecutionArea&) = delete;

    void addTo(MethodTable& methods) override;
    void describe(Json& state) override {
        Json& tasks = state["tasks"] = Json::array();
        for (const auto& task : controller_.core().tasks())
            tasks.push_back(describe(*task));
    }
    void flush() override;

  private:
    void note(Change change, const rt::Task* task);
    Json describe(const rt::Task& task);
    Json start(const Json& params);

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    bool areTasksChanged_ = false;
    std::set<const rt::Task*> moved_; ///< pointers
};

void ExecutionArea::note(Change change, const rt::Task* task) {
    switch (change) {
    case Change::Generation:
        moved_.clear();           // tasks of the controller before
        areTasksChanged_ = false; // clients ask for the state
        return;
    case Change::ProgramPointer:
    case Change::MotionPointer:
        if (task != nullptr) moved_.insert(task);
        break;
    case Change::Tasks:
    case Change::Execution:
    case Change::Modules: areTasksChanged_ = true; break;
    default: return;
    }
    hub_.wake();
}

void ExecutionArea::flush() {
    if (std::exchange(areTasksChanged_, false))
        for (const auto& task : controller_.core().tasks())
            hub_.broadcast("task", describe(*task));
    for (const rt::Task* task : std::exchange(moved_, {}))
        hub_.broadcast("pointers", {{"task", task->name()},
                                    {"pointer", placeJson(service::programPointer(controller_, *task))},
                                    {"motion", placeJson(service::motionPointer(controller_, *task))}});
}

Json ExecutionArea::describe(const rt::Task& task) {
    const auto& motions = controller_.core().motions();
    const int group = task.motionGroup();
    const bool moves = group >= 0 && static_cast<std::size_t>(group) < motions.size();
    const bool failed = !task.isExecuting() && task.stopCause() == rt::StopCause::Error;
    return {{"name", task.name()},
            {"type", kindOf(task)},
            {"active", controller_.isTaskActive(task)},
            {"state", stateOf(task)},
            {"unit", moves ? motions[static_cast<std::size_t>(group)]->unitName() : std::string()},
            {"changes", controller_.structuralChanges(task)},
            {"pointer", placeJson(service::programPointer(controller_, task))},
            {"motion", placeJson(service::motionPointer(controller_, task))},
            {"error", failed ? task.errorText() : std::string()}};
}

Json ExecutionArea::start(const Json& params) {
    const ExecutionMode mode =
        has(params, "mode") ? wordOf(params, "mode", kStarts) : ExecutionMode::Continue;
    rt::Task* task = has(params, "task") ? &taskOf(controller_, params) : nullptr;
    refuseUnless(controller_.start(mode, task));
    return {};
}

void ExecutionArea::addTo(MethodTable& methods) {
    methods.add("run.start", [this](Client&, const Json& params) { return start(params); });
    methods.add("run.stop", [this](Client&, const Json& params) {
        refuseUnless(controller_.stop(has(params, "mode") ? wordOf(params, "mode", kStops) : StopMode::Stop));
        return Json();
    });
    methods.add("run.pointerToMain", [this](Client&, const Json&) {
        refuseUnless(controller_.resetPointers());
        return Json();
    });
    methods.add("run.pointerToRoutine", [this](Client&, const Json& params) {
        rt::Task& task = taskOf(controller_, params);
        refuseUnless(
            controller_.pointerToRoutine(task, textOr(params, "module", ""), textOf(params, "routine")));
        return Json();
    });
    methods.add("run.pointerToLine", [this](Client&, const Json& params) {
        const NamedModule named = moduleOf(controller_, params);
        const auto line = lineOf(params);
        refuseUnless(controller_.pointerToLine(named.task, named.module.name, line));
        return Json();
    });
    methods.add("run.activate", [this](Client&, const Json& params) {
        refuseUnless(controller_.setTaskActive(taskOf(controller_, params), flagOf(params, "active")));
        return Json();
    });
}

} // namespace

std::unique_ptr<Area> makeExecutionArea(const Context& context) {
    return std::make_unique<ExecutionArea>(context);
}

} // namespace rapidc::pendant
