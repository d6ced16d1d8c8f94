// Manual 1.20: WaitSyncTask: tasks wait for each other at a point that the name of a syncident identifies.

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

/// A task that stands at a synchronization point.
struct Arrival {
    const Task* task = nullptr;
    std::string point;
    std::vector<const Task*>
        partners; ///< all tasks of the list, the own one too, in the order of the controller
    bool released = false;
};

/// The synchronization points of a controller; one that nobody waits at is not there.
struct SyncPoints {
    std::vector<Arrival*> arrivals;
    WaitQueue changed;

    Arrival* find(const Task* task, const std::string& point) const {
        for (Arrival* arrival : arrivals) {
            if (arrival->task == task && arrival->point == point && !arrival->released) return arrival;
        }
        return nullptr;
    }

    /// Everybody is there: all go on.
    void releaseIfComplete(const Arrival& last) {
        std::vector<Arrival*> all;
        for (const Task* partner : last.partners)
            all.push_back(find(partner, last.point));
        if (std::find(all.begin(), all.end(), nullptr) != all.end()) return;
        for (Arrival* arrival : all)
            arrival->released = true;
        changed.notifyAll();
    }
};

/// The arrival counts as long as this lives, also when the program pointer is moved away.
class Presence {
  public:
    Presence(SyncPoints& points, Arrival& arrival) : points_(points), arrival_(arrival) {
        points_.arrivals.push_back(&arrival_);
    }
    ~Presence() { std::erase(points_.arrivals, &arrival_); }
    Presence(const Presence&) = delete;
    Presence& operator=(const Presence&) = delete;

  private:
    SyncPoints& points_;
    Arrival& arrival_;
};

/// Tasks have variables of their own, so it is the name that they have in common; with the index in an array.
std::string nameOfPoint(const Task& owner, const Handle* sync) {
    const ProgramDesc& program = owner.controller().program();
    const auto address = reinterpret_cast<std::uintptr_t>(sync);
    for (uint32_t i = 0; i < program.globalCount; ++i) {
        const GlobalDesc& global = program.globals[i];
        const auto first = reinterpret_cast<std::uintptr_t>(global.address);
        if (address < first || address >= first + global.type->size) continue;
        return upperCase(fmt::format("{}/{}", global.name, (address - first) / sizeof(Handle)));
    }
    return fmt::format("{}", address); // data of a routine: nobody else can come there
}

Status misuse(Task& owner, const std::string& why) {
    return owner.fatal(static_cast<int>(EventId::SyncMisused), "WaitSyncTask: " + why);
}

Status readList(Task& owner, const data::Tasks* list, int32_t count, std::vector<const Task*>& partners) {
    for (int32_t i = 0; i < count; ++i) {
        const std::string name(list[i].taskname.view());
        const Task* partner = owner.controller().findTask(name);
        if (partner == nullptr)
            return misuse(owner, fmt::format("element {} of the task list names \"{}\", but there is no such "
                                             "task. Name tasks of this controller only.",
                                             i + 1, name));
        partners.push_back(partner);
    }
    std::sort(partners.begin(), partners.end(),
              [](const Task* a, const Task* b) { return a->index() < b->index(); });
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    if (std::find(partners.begin(), partners.end(), &owner) != partners.end()) return kOk;
    return misuse(owner,
                  fmt::format("the task list does not name task {}, which executes the instruction. Every "
                              "task that takes part must be in the list.",
                              owner.name()));
}

/// Tasks that wait for each other at the same point must agree on who takes part.
Status compareLists(Task& owner, const SyncPoints& points, const Arrival& own) {
    for (const Task* partner : own.partners) {
        const Arrival* other = points.find(partner, own.point);
        if (other != nullptr && other->partners != own.partners)
            return misuse(owner,
                          fmt::format("the task lists of {} and {} differ. The list must name the same tasks "
                                      "in every task that takes part.",
                                      owner.name(), partner->name()));
    }
    return kOk;
}

} // namespace

extern "C" {

Status rt_WaitSyncTask(TaskCore* task, bool InPos, Handle* SyncID, data::Tasks* TaskList,
                       int32_t TaskListDim1, const float* TimeOut) {
    Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    Arrival arrival;
    arrival.task = &owner;
    arrival.point = nameOfPoint(owner, SyncID);
    if (const Status status = readList(owner, TaskList, TaskListDim1, arrival.partners)) return status;
    if (InPos && owner.isMotionTask()) {
        if (const Status status = controller.motion(owner).waitIdle(owner)) return status;
    }
    auto& points = controller.service<SyncPoints>();
    if (const Status status = compareLists(owner, points, arrival)) return status;
    const Presence presence(points, arrival);
    points.releaseIfComplete(arrival);
    WaitSpec spec{{&points.changed}, [&arrival] { return arrival.released; }};
    if (TimeOut != nullptr) spec.deadline = addTime(owner.now(), fromSeconds(std::max(0.0F, *TimeOut)));
    WaitResult result = WaitResult::Done;
    if (const Status status = owner.waitFor(spec, result)) return status;
    if (result == WaitResult::Done) return kOk;
    return lib::fail(task, err::ERR_WAITSYNCTASK,
                     "not all tasks of the list came to the synchronization point within \\TimeOut");
}

/// One robot: no task is ever in synchronized movement.
Status rt_TasksInSync(TaskCore*, float* result, data::Tasks*, int32_t) {
    *result = 0;
    return kOk;
}
}
