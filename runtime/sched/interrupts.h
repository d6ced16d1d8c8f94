#pragma once
// InterruptTable: the interrupts of one task (manual 1.11): numbers connected with trap routines, what orders
// them, the FIFO queue of those that occurred. Delivery happens on the task's own fibre, at safepoints and
// while it waits.

#include "runtime/abi/rt_abi.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rt {

class Task;

/// A compiled trap routine.
struct Trap {
    EntryFunction function = nullptr;
    const RoutineDesc* routine = nullptr; ///< for events; may be null
    std::string
        absent; ///< "Part:onChange": the one that is meant, whose module has left memory; `function` is null
};

/// What an interrupt was ordered for, in words that a later process understands (--state): the instruction and its
/// arguments. Empty `kind`: it cannot be ordered again.
struct InterruptOrder {
    std::string kind;            ///< "ISignalDI" ...
    std::string object;          ///< signal, persistent
    std::vector<double> numbers; ///< further arguments
};

/// A connected interrupt as it is kept between two processes.
struct SavedInterrupt {
    int number = 0;
    EntryFunction trap = nullptr; ///< null: none is connected
    bool single = false, safe = false, asleep = false, ordered = false;
    InterruptOrder order;
};

class InterruptTable {
  public:
    /// At most this many may be defined at a time in a task (manual 1.11).
    static constexpr std::size_t kMaxDefined = 100;
    /// At most this many occurrences wait in the queue; a further one is lost, with an event. The manual names no
    /// limit; without one a program that never enables its interrupts would use up all memory.
    static constexpr std::size_t kMaxQueued = 1000;
    /// The cause of an interrupt, for GetTrapData in the trap.
    using Cause = std::shared_ptr<const void>;
    /// A call that is executed as a trap routine is, without a number (MoveLSync). It finds its routine when it is called and calls
    /// it with the frame given; positive: an error to be raised there.
    using Call = std::function<Status(Task&, Frame*)>;

    explicit InterruptTable(Task& task) : task_(task) {}
    ~InterruptTable() { clear(); }
    InterruptTable(const InterruptTable&) = delete;
    InterruptTable& operator=(const InterruptTable&) = delete;

    /// CONNECT: a new interrupt number (from 1) for this trap; 0 when 100 are defined already (ERR_INOMAX).
    int connect(const Trap& trap);
    /// A new interrupt number without a trap routine: it may be ordered, but its occurrence is fatal (manual 1.11).
    int define() { return connect({}); }
    /// Gives a number made by define() its trap routine. False when the number is not defined or has one.
    bool attach(int number, const Trap& trap);
    /// All trap routines connected with interrupts: modules come and go while a program runs.
    void forEachTrap(const std::function<void(Trap&)>& visit);
    bool isDefined(int number) const { return defined_.count(number) != 0; }
    /// True when the interrupt has been ordered (ISignalDI, ITimer ...).
    bool isOrdered(int number) const;
    /// Orders a connected interrupt: `disarm` is called when the order ends (IDelete, program reset, \Single
    /// after the first occurrence, end of the task). The source calls post(number) whenever its condition
    /// becomes true. An order that is still in force is replaced. False when the number is not defined.
    bool order(int number, std::function<void()> disarm, bool single = false, bool safe = false,
               InterruptOrder what = {});
    /// All that are connected; what a later process puts back. Those restored keep their numbers; they are not ordered yet.
    std::vector<SavedInterrupt> saved() const;
    void restore(const SavedInterrupt& interrupt);
    /// The safe ones in the queue, in their order (a stop and a power failure leave these alone); and back.
    std::vector<int> queuedSafe() const;
    void queueAgain(int number);
    /// Those of this number in the queue are thrown away: their cause is gone.
    void forgetQueued(int number);
    /// IDelete. False when the number is not defined.
    bool remove(int number);
    /// Every definition disappears (program reset).
    void clear();

    /// The condition of an interrupt became true. Queued while interrupts are disabled or a trap runs;
    /// ignored while the interrupt sleeps, and while the task is stopped unless the interrupt is safe.
    void post(int number, Cause cause = nullptr);
    /// The call waits in the same queue. It outlives a stop of the program, and is executed after the next start.
    void postCall(Call call);
    /// Executes it at once, on the level of trap routines; negative when it unwinds the task.
    Status callNow(const Call& call);
    /// ISleep / IWatch. False when the number is not defined.
    bool sleep(int number);
    bool watch(int number);
    bool isSafe(int number) const;
    /// IDisable / IEnable.
    void disable() { enabled_ = false; }
    void enable();
    bool enabled() const { return enabled_; }

    /// Something is to be delivered now.
    bool deliverable() const;
    /// A trap routine executes, or will as soon as the task can.
    bool isAtWork() const { return running_ || deliverable(); }
    /// Runs the traps of all queued interrupts on the current fibre; negative when a trap unwinds the task.
    Status deliver();
    /// The task has been stopped: queued interrupts are thrown away, safe ones stay.
    void taskStopped();
    /// True while a trap routine executes.
    bool inTrap() const { return running_; }
    /// Cause of the interrupt whose trap routine executes; null when its source gave none.
    const Cause& cause() const { return cause_; }
    /// The unwinding of the task ended: whatever trap ran is gone.
    void unwound() {
        running_ = false;
        cause_ = nullptr;
    }

  private:
    struct Definition {
        Trap trap;
        std::function<void()> disarm;
        bool single = false;
        bool safe = false;
        bool asleep = false;
        bool ordered = false;
        InterruptOrder what;
    };
    struct Occurrence {
        int number = 0; ///< 0: a call
        Cause cause;
        Call call = {};
    };
    Status deliverFirst();
    Status runOnTop(int number, Cause cause, const Call& call);
    template <class Condition> void dropQueued(Condition drop);

    Task& task_;
    std::map<int, Definition> defined_;
    std::deque<Occurrence> queue_;
    Cause cause_;
    int lastNumber_ = 0;
    bool enabled_ = true;
    bool running_ = false;
    bool overflowReported_ = false;
};

/// Frame records with this routine mark where a trap was called by the system: no handler beyond it takes an
/// error.
extern const RoutineDesc kTrapBoundary;

} // namespace rt
