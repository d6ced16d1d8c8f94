#pragma once
// BreakpointList: the breakpoints of all clients of a controller: what one sets, the others see. They stay when the controller is
// restarted or the program replaced. On the controller's thread only.

#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rapidc::service {

class BreakpointList {
  public:
    /// The controller must outlive the list.
    explicit BreakpointList(VirtualController& controller);
    ~BreakpointList();
    BreakpointList(const BreakpointList&) = delete;
    BreakpointList& operator=(const BreakpointList&) = delete;

    struct Mark {
        std::string task, module;
        uint32_t line = 0;       ///< as asked for, from 1
        uint32_t column = 1;     ///< as asked for, from 1; a breakpoint concerns the whole line
        uint32_t actualLine = 0; ///< of the statement that stops; 0: the program has none there now
        int id = 0;              ///< of the debugger
        uint32_t shownLine() const { return actualLine != 0 ? actualLine : line; }
    };
    enum class Added : uint8_t {
        New,
        Present,       ///< there is one for that statement already; `mark` is that one
        NoInstruction, ///< no statement follows that line
        NotInLine,     ///< no statement begins in that line
        TooMany,
    };
    /// Sets `mark` (task, module, line and column are given), with what became of it. `exactly`: a statement must begin in the line itself.
    Added add(Mark& mark, bool exactly);
    /// Removes those in that line, as asked for or of the statement; how many they were.
    std::size_t remove(const std::string& task, const std::string& module, uint32_t line);
    void clear();
    std::vector<Mark> all() const;

    /// Whether breakpoints stop the program until it has stopped: the choice of the client that starts it. Returns the choice
    /// that held before.
    bool setStopping(bool stopping) { return std::exchange(stopping_, stopping); }
    /// Calls the action after each change of the list, and when statements may lie elsewhere.
    int onChange(std::function<void()> action);
    void forget(int listener) { actions_.erase(listener); }

  private:
    static constexpr std::size_t kMost = 1000;
    void setInDebugger(Mark& mark);
    uint32_t actualLineOf(int id) const;
    std::size_t removeIf(const std::function<bool(const Mark&)>& goes);
    void report() const;

    VirtualController& controller_;
    Observers::Token observer_ = 0;
    std::vector<Mark> marks_;
    std::map<int, std::function<void()>> actions_;
    int lastListener_ = 0;
    bool stopping_ = true;
};

} // namespace rapidc::service
