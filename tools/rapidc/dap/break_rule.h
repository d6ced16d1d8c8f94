#pragma once
// BreakRule: on which condition a breakpoint stops, the how manieth time, and what it writes instead.

#include "tools/rapidc/dap/context.h"

#include <memory>
#include <string>
#include <vector>

namespace rapidc::dap {

class BreakRule {
  public:
    BreakRule(Context& context, std::string condition, std::string hitCondition, std::string logMessage);

    /// "" or what is wrong with it in that routine; null: where no routine is known.
    std::string problem(int32_t task, const rt::RoutineDesc* routine) const;
    /// rt::BreakCondition.
    bool accepts(rt::Task& task, rt::Frame* at);
    bool isPlain() const { return condition_.empty() && hitCondition_.empty() && log_.empty(); }

  private:
    enum class Hits : uint8_t { Every, Equal, AtLeast, More, Less, AtMost, Multiple };
    struct Piece {
        std::string text;
        bool isExpression = false;
    };
    std::string readHits();
    std::string readLog(const std::string& message);
    bool holds(rt::Task& task, rt::Frame* at);
    bool countsNow();
    void writeLog(rt::Task& task, rt::Frame* at);
    std::string textOf(const std::string& expression, const Site& site);

    Context& context_;
    std::string condition_, hitCondition_;
    std::vector<Piece> log_;
    Hits hits_ = Hits::Every;
    uint64_t wanted_ = 0, count_ = 0;
    std::string wrong_; ///< with what was given, whatever the place
};

} // namespace rapidc::dap
