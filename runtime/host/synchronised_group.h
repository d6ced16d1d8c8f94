#pragma once
// SynchronisedGroup: robots whose tasks have executed SyncMoveOn (MultiMove). A movement is ordered when every task has come to
// its movement instruction with the same \ID; all robots then move together.

#include "runtime/motion/motion_system.h"
#include "runtime/sched/wait_queue.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rt {

class MotionDriver;
class Task;

class SynchronisedGroup {
  public:
    struct Member {
        MotionDriver* driver = nullptr;
        Task* task = nullptr;
    };
    /// The first one leads. In the order of the tasks of the controller.
    explicit SynchronisedGroup(std::vector<Member> members) : members_(std::move(members)) {}

    const std::vector<Member>& members() const { return members_; }
    /// The request of one task's instruction, and its outcome.
    struct Order {
        Task* task = nullptr;
        motion::MoveCommand command;
        bool isDone = false; ///< ordered, or refused with `error`
        motion::MoveId id = 0;
        std::optional<motion::MotionError> error;
    };
    /// The order counts until it is done or withdrawn. Returns what is wrong with its \ID; "" when nothing is.
    std::string give(MotionDriver& driver, Order& order);
    void withdraw(MotionDriver& driver);
    /// An order of an earlier process that was complete for this robot but not for all: it counts before the next one of its task.
    void expect(MotionDriver& driver, motion::MoveCommand command);
    /// Every task has given its order, and the robots can take it.
    bool isReady() const;
    /// Orders the movement of all; isReady(). When one cannot be made, its order is done, and the others wait on.
    void orderStep();

    /// The synchronised movement is over: SyncMoveOff, SyncMoveUndo, the program pointer of one of them was moved. What is left
    /// of the movement is cleared.
    void end();
    bool isOver() const { return isOver_; }
    /// Some stop of one of the robots holds them all.
    bool isHeld() const;
    /// Notified after an order is done and at the end.
    WaitQueue& changed() { return changed_; }
    /// Those that a task has to watch to learn that isReady() has changed.
    std::vector<WaitQueue*> queues();
    std::vector<motion::MotionSystem*> systems() const;

  private:
    Order* firstOf(const MotionDriver* driver) const;

    std::vector<Member> members_;
    std::vector<std::pair<MotionDriver*, Order*>> given_; ///< in order; one robot may have two (expect)
    std::deque<std::unique_ptr<Order>> earlier_;
    WaitQueue changed_;
    bool isOver_ = false;
};

} // namespace rt
