// Manual 1.20: tasks wait for each other at a point that the name of a syncident identifies (WaitSyncTask), and begin or end
// there to move their robots together (SyncMoveOn, SyncMoveOff).

#include "runtime/base/text_util.h"
#include "runtime/host/synchronised_group.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>

#include "natives/multitasking.h"
#include "natives/path.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

using Tasks = std::vector<Task*>;

/// A task that is at a synchronization point.
struct Arrival {
    const Task* task = nullptr;
    std::string point;
    Tasks partners; ///< all tasks of the list, the own one too, in the order of the controller
    bool released = false;
};

/// The synchronization points of a controller; a point exists while a task waits at it.
struct SyncPoints {
    std::vector<Arrival*> arrivals;
    WaitQueue changed;

    Arrival* find(const Task* task, const std::string& point) const {
        for (Arrival* arrival : arrivals) {
            if (arrival->task == task && arrival->point == point && !arrival->released) return arrival;
        }
        return nullptr;
    }

    /// When all tasks have come they continue, after `action`.
    void releaseIfComplete(const Arrival& last, const std::function<void(const Tasks&)>& action) {
        std::vector<Arrival*> all;
        for (const Task* partner : last.partners)
            all.push_back(find(partner, last.point));
        if (std::find(all.begin(), all.end(), nullptr) != all.end()) return;
        if (action) action(last.partners);
        for (Arrival* arrival : all)
            arrival->released = true;
        changed.notifyAll();
    }
};

/// The arrival counts as long as this lives, even when the program pointer is moved away.
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
    return fmt::format("{}", address); // data of a routine: no other task can reach it
}

Status misuse(Task& owner, const std::string& why) {
    return owner.fatal(static_cast<int>(EventId::SyncMisused), why);
}

/// `instruction`: for messages.
Status readList(Task& owner, const char* instruction, const data::Tasks* list, int32_t count,
                Tasks& partners) {
    for (int32_t i = 0; i < count; ++i) {
        const std::string name(list[i].taskname.view());
        if (name.empty()) continue; // lists for up to so many robots have empty places
        Task* partner = owner.controller().findTask(name);
        if (partner == nullptr)
            return misuse(owner,
                          fmt::format("{}: element {} of the task list names \"{}\", but there is no such "
                                      "task. Name tasks of this controller only.",
                                      instruction, i + 1, name));
        partners.push_back(partner);
    }
    std::sort(partners.begin(), partners.end(),
              [](const Task* a, const Task* b) { return a->index() < b->index(); });
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    if (std::find(partners.begin(), partners.end(), &owner) != partners.end()) return kOk;
    return misuse(
        owner, fmt::format("{}: the task list does not name task {}, which executes the instruction. Every "
                           "task that takes part must be in the list.",
                           instruction, owner.name()));
}

/// Tasks that wait for each other at the same point must agree on who takes part.
Status compareLists(Task& owner, const char* instruction, const SyncPoints& points, const Arrival& own) {
    for (const Task* partner : own.partners) {
        const Arrival* other = points.find(partner, own.point);
        if (other != nullptr && other->partners != own.partners)
            return misuse(
                owner,
                fmt::format("{}: the task lists of {} and {} differ. The list must name the same tasks "
                            "in every task that takes part.",
                            instruction, owner.name(), partner->name()));
    }
    return kOk;
}

struct Meeting {
    const char* instruction = "";
    Tasks partners;
    const float* timeOut = nullptr; ///< s
    Status late = kOk;              ///< error of the time-out
    std::function<void(const Tasks&)> whenComplete;
};

/// Waits until all partners are at the point.
Status meet(Task& owner, const Handle* syncId, const Meeting& meeting) {
    Arrival arrival;
    arrival.task = &owner;
    arrival.point = nameOfPoint(owner, syncId);
    arrival.partners = meeting.partners;
    auto& points = owner.controller().service<SyncPoints>();
    if (const Status status = compareLists(owner, meeting.instruction, points, arrival)) return status;
    const Presence presence(points, arrival);
    points.releaseIfComplete(arrival, meeting.whenComplete);
    WaitSpec spec{{&points.changed}, [&arrival] { return arrival.released; }};
    spec.isMeeting = true;
    if (meeting.timeOut != nullptr)
        spec.deadline = addTime(owner.now(), fromSeconds(std::max(0.0F, *meeting.timeOut)));
    WaitResult result = WaitResult::Done;
    if (const Status status = owner.waitFor(spec, result)) return status;
    if (result == WaitResult::Done) return kOk;
    return lib::fail(&owner, meeting.late,
                     "not all tasks of the list came to the synchronization point within \\TimeOut");
}

/// The robot of the task is at its stop point and at rest.
Status waitAtRest(Task& owner) {
    MotionDriver& driver = owner.controller().motion(owner);
    if (const Status status = driver.waitIdle(owner)) return status;
    return driver.waitZeroSpeed(owner);
}

void beginTogether(const Tasks& tasks) {
    std::vector<SynchronisedGroup::Member> members;
    for (Task* task : tasks)
        members.push_back({&task->controller().motion(*task), task});
    const auto group = std::make_shared<SynchronisedGroup>(members);
    for (const SynchronisedGroup::Member& member : members)
        member.driver->joinGroup(group);
}

const std::shared_ptr<SynchronisedGroup>& groupOf(TaskCore* task) {
    static const std::shared_ptr<SynchronisedGroup> kNone;
    return taskOf(task).isMotionTask() ? lib::motionOf(task).synchronised() : kNone;
}

} // namespace

extern "C" {

Status rt_WaitSyncTask(TaskCore* task, bool InPos, Handle* SyncID, data::Tasks* TaskList,
                       int32_t TaskListDim1, const float* TimeOut) {
    Task& owner = taskOf(task);
    Meeting meeting{"WaitSyncTask", {}, TimeOut, err::ERR_WAITSYNCTASK, {}};
    if (const Status status = readList(owner, "WaitSyncTask", TaskList, TaskListDim1, meeting.partners))
        return status;
    if (InPos && owner.isMotionTask()) {
        if (const Status status = owner.controller().motion(owner).waitIdle(owner)) return status;
    }
    return meet(owner, SyncID, meeting);
}

Status rt_SyncMoveOn(TaskCore* task, Handle* SyncID, data::Tasks* TaskList, int32_t TaskListDim1,
                     const float* TimeOut) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Task& owner = taskOf(task);
    Meeting meeting{"SyncMoveOn", {}, TimeOut, err::ERR_SYNCMOVEON, beginTogether};
    if (const Status status = readList(owner, "SyncMoveOn", TaskList, TaskListDim1, meeting.partners))
        return status;
    for (const Task* partner : meeting.partners)
        if (!partner->isMotionTask())
            return misuse(owner, fmt::format("SyncMoveOn: task {} of the list controls no mechanical unit.",
                                             partner->name()));
    if (groupOf(task) != nullptr)
        return misuse(owner,
                      "SyncMoveOn: the task is in synchronised movement already. Execute SyncMoveOff first.");
    if (const Status status = waitAtRest(owner)) return status;
    return meet(owner, SyncID, meeting);
}

Status rt_SyncMoveOff(TaskCore* task, Handle* SyncID, const float* TimeOut) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Task& owner = taskOf(task);
    const auto group = groupOf(task);
    if (group == nullptr)
        return misuse(owner,
                      "SyncMoveOff: the task is not in synchronised movement. Execute SyncMoveOn first.");
    Meeting meeting{
        "SyncMoveOff", {}, TimeOut, err::ERR_SYNCMOVEOFF, [group](const Tasks&) { group->end(); }};
    for (const SynchronisedGroup::Member& member : group->members())
        meeting.partners.push_back(member.task);
    if (const Status status = waitAtRest(owner)) return status;
    return meet(owner, SyncID, meeting);
}

/// Also when the other tasks do not execute it (UNDO handlers).
Status rt_SyncMoveUndo(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (const auto group = lib::motionOf(task).synchronised()) group->end();
    return kOk;
}

/// Between StorePath \KeepSync and RestoPath: the robot moves for itself until SyncMoveResume.
Status rt_SyncMoveSuspend(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    MotionDriver& driver = lib::motionOf(task);
    if (driver.pathLevel() == 1 || driver.synchronised() == nullptr)
        return misuse(taskOf(task),
                      "SyncMoveSuspend is for synchronised robots on the path level of StorePath "
                      "\\KeepSync.");
    if (const Status status = waitAtRest(taskOf(task))) return status;
    driver.suspendGroup(true);
    motion::MotionSystem::endTogether({&driver.system()});
    driver.refresh();
    return kOk;
}

Status rt_SyncMoveResume(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    MotionDriver& driver = lib::motionOf(task);
    if (!driver.isSuspended())
        return misuse(taskOf(task),
                      "SyncMoveResume: the synchronised movement is not suspended (SyncMoveSuspend).");
    if (const Status status = waitAtRest(taskOf(task))) return status;
    driver.suspendGroup(false);
    return kOk;
}

Status rt_IsSyncMoveOn(TaskCore* task, bool* result) {
    *result = groupOf(task) != nullptr;
    return kOk;
}

/// As many as fit; the number is that of the names written.
Status rt_TasksInSync(TaskCore* task, float* result, data::Tasks* TaskList, int32_t TaskListDim1) {
    int32_t count = 0;
    if (const auto& group = groupOf(task))
        for (const SynchronisedGroup::Member& member : group->members())
            if (count < TaskListDim1) TaskList[count++].taskname.assign(member.task->name());
    *result = static_cast<float>(count);
    return kOk;
}
}
