#include "runtime/host/synchronised_group.h"

#include "runtime/host/motion_driver.h"
#include "runtime/sched/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rt {

std::string SynchronisedGroup::give(MotionDriver& driver, Order& order) {
    if (order.command.ident == motion::kNoIdent)
        return "A movement instruction between SyncMoveOn and SyncMoveOff has no \\ID. Give it the number "
               "that the "
               "other tasks use.";
    for (const Member& member : members_) {
        const Order* given = firstOf(member.driver);
        if (given == nullptr || firstOf(&driver) != nullptr || given->command.ident == order.command.ident)
            continue;
        return fmt::format(
            "Task {} executes the movement with \\ID {} while task {} is at \\ID {}. The movements "
            "of all tasks must have the same numbers in the same order.",
            order.task->name(), order.command.ident, member.task->name(), given->command.ident);
    }
    given_.emplace_back(&driver, &order);
    changed_.notifyAll();
    return "";
}

/// The order that counts now; null when there is none.
SynchronisedGroup::Order* SynchronisedGroup::firstOf(const MotionDriver* driver) const {
    const auto found =
        std::find_if(given_.begin(), given_.end(), [&](const auto& given) { return given.first == driver; });
    return found == given_.end() ? nullptr : found->second;
}

void SynchronisedGroup::expect(MotionDriver& driver, motion::MoveCommand command) {
    earlier_.push_back(std::make_unique<Order>());
    earlier_.back()->command = std::move(command);
    given_.emplace_back(&driver, earlier_.back().get());
}

void SynchronisedGroup::withdraw(MotionDriver& driver) {
    // The latest one: what an earlier process ordered stays.
    const auto found = std::find_if(given_.rbegin(), given_.rend(),
                                    [&](const auto& given) { return given.first == &driver; });
    if (found != given_.rend()) given_.erase(std::next(found).base());
}

std::vector<motion::MotionSystem*> SynchronisedGroup::systems() const {
    std::vector<motion::MotionSystem*> result;
    for (const Member& member : members_)
        result.push_back(&member.driver->system());
    return result;
}

std::vector<WaitQueue*> SynchronisedGroup::queues() {
    std::vector<WaitQueue*> result{&changed_};
    for (const Member& member : members_)
        result.push_back(&member.driver->changed());
    return result;
}

bool SynchronisedGroup::isReady() const {
    const auto hasGiven = [this](const Member& member) { return firstOf(member.driver) != nullptr; };
    if (isOver_ || !std::all_of(members_.begin(), members_.end(), hasGiven)) return false;
    const auto all = systems();
    if (!motion::MotionSystem::areTogether(all)) // after ClearPath, or on a new path level
        return std::all_of(all.begin(), all.end(),
                           [](const auto* system) { return system->isIdle() && !system->isMoving(); });
    return std::all_of(all.begin(), all.end(), [](const auto* system) { return system->hasRoom(); });
}

void SynchronisedGroup::orderStep() {
    std::vector<Order*> orders;
    std::vector<const Task*> tasks;
    std::vector<motion::MoveCommand> commands;
    for (const Member& member : members_) {
        orders.push_back(firstOf(member.driver));
        tasks.push_back(orders.back()->task);
        commands.push_back(orders.back()->command);
    }
    const auto ordered = MotionDriver::orderTogether(*this, tasks, commands);
    if (ordered && ordered->empty()) return;
    for (std::size_t i = 0; i < members_.size(); ++i)
        orders[i]->command = commands[i];
    if (!ordered) {
        Order& refused = *orders[ordered.error().command];
        refused.error = ordered.error().error;
        refused.isDone = true;
        std::erase_if(given_, [&](const auto& given) { return given.second == &refused; });
        changed_.notifyAll();
        return;
    }
    std::erase_if(given_, [&](const auto& given) {
        return std::find(orders.begin(), orders.end(), given.second) != orders.end();
    });
    for (std::size_t i = 0; i < members_.size(); ++i) {
        orders[i]->id = (*ordered)[i];
        orders[i]->isDone = true;
    }
    for (const Member& member : members_)
        member.driver->refresh();
    changed_.notifyAll();
}

void SynchronisedGroup::end() {
    if (std::exchange(isOver_, true)) return;
    for (const Member& member : members_) {
        member.driver->leaveGroup();
        if (!member.driver->isIdle()) member.driver->clearLevel();
    }
    motion::MotionSystem::endTogether(systems());
    for (const Member& member : members_)
        member.driver->refresh();
    changed_.notifyAll();
}

bool SynchronisedGroup::isHeld() const {
    return std::any_of(members_.begin(), members_.end(), [](const Member& member) {
        return member.driver->isHeldItself() || member.driver->isSuspended();
    });
}

} // namespace rt
