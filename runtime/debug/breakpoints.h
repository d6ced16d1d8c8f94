#pragma once
// Breakpoints of a debugger: at lines, at the beginning of routines, at changes of data. What stops and on which condition;
// the Debugger does the stopping.

#include "runtime/debug/debug_host.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// Asked on the fibre of the task before the statement: is the task to stop? Counts hits, evaluates conditions, writes log
/// messages.
using BreakCondition = std::function<bool(Task& task, Frame* at)>;

struct Breakpoint {
    int id = 0;
    std::string file;  ///< as given: a path, a file name or the name of a module; or ROUTINE, MODULE:ROUTINE
    uint32_t line = 0; ///< as given, from 1; 0: at the beginning of a routine
    uint32_t actualLine = 0; ///< of the statement that stops; 0: there is none
    bool waits = false;      ///< no module (or routine) of that name is in memory; it may be loaded later
    const RoutineDesc* routine = nullptr;           ///< that holds the statement
    std::function<bool(const RoutineDesc&)> covers; ///< whether a routine lies in that file
    BreakCondition accepts;                         ///< empty: always
};

/// A variable, persistent or signal that is looked at before every statement.
struct DataWatch {
    int id = 0;
    std::string name;                  ///< for people
    std::function<std::string()> read; ///< its value as bytes or text
    BreakCondition accepts;
    std::string last;
};

class Breakpoints {
  public:
    explicit Breakpoints(const DebugHost& host) : host_(host) {}

    /// The first statement at or below the line stops. `where`: module, file name or path.
    Breakpoint addLine(std::string_view where, uint32_t line);
    /// The same in every routine that `covers` says yes to.
    Breakpoint addLine(std::string where, uint32_t line, std::function<bool(const RoutineDesc&)> covers,
                       BreakCondition accepts);
    /// Stops before the first statement of each routine of that name.
    Breakpoint addRoutine(std::string name, BreakCondition accepts);
    int addData(std::string name, std::function<std::string()> read, BreakCondition accepts);
    /// Of any kind.
    bool remove(int id);
    void clearData() { watches_.clear(); }
    const std::vector<Breakpoint>& all() const { return all_; }

    /// A module has come into memory or left it.
    void memoryChanged();
    /// Called for each breakpoint that another statement stops for now, or none.
    void onChange(std::function<void(const Breakpoint&)> action) { changed_ = std::move(action); }

    /// Whether one of them stops the task before the statement of `at`; asks all of that statement.
    bool stops(Task& task, Frame* at);
    /// Whether one without a condition is there, for a task that comes to the statement backwards.
    bool stopsBackward(const Frame& at);
    /// Whether watched data have changed, and that stops the task.
    bool dataStops(Task& task, Frame* at);
    /// The breakpoints that stopped last, and whether they are at routines; what a data breakpoint saw.
    const std::vector<int>& hits() const { return hits_; }
    bool hitRoutine() const { return hitRoutine_; }
    const std::string& change() const { return change_; }

  private:
    void find(Breakpoint& breakpoint) const;
    std::vector<int> stopsAt(const Breakpoint& breakpoint, const RoutineDesc& routine) const;
    bool entered(const Task& task, const Frame* at);

    const DebugHost& host_;
    std::vector<Breakpoint> all_;
    std::vector<DataWatch> watches_;
    int lastId_ = 0;
    /// Breakpoints by statement; filled on demand.
    std::map<const RoutineDesc*, std::map<int32_t, std::vector<int>>> marks_;
    struct Latest {
        const Frame* frame = nullptr;
        std::size_t depth = 0;
    };
    std::map<const Task*, Latest> latest_; ///< where each task executed a statement last
    std::vector<int> hits_;
    bool hitRoutine_ = false;
    std::string change_;
    std::function<void(const Breakpoint&)> changed_;
};

/// `where`: module, file name or path, without regard to case.
bool isPlace(const RoutineDesc& routine, std::string_view where);

} // namespace rt
