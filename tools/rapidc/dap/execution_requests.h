#pragma once
// ExecutionRequests: threads, going on, stepping, pausing and moving the program pointer.

#include "tools/rapidc/dap/context.h"

#include <functional>
#include <map>

namespace rapidc::dap {

class ExecutionRequests {
  public:
    /// `goesOn` is called before an order lets the program go on.
    ExecutionRequests(Context& context, std::function<void()> goesOn)
        : context_(context), goesOn_(std::move(goesOn)) {}
    void addTo(Handlers& handlers);
    void forgetTargets() { targets_.clear(); }

  private:
    struct Target {
        std::string routine, module; ///< where the statement is
        uint32_t line = 0;
    };

    Json threads(const Arguments& arguments);
    Json goOn(const Arguments& arguments);
    Json next(const Arguments& arguments);
    Json stepIn(const Arguments& arguments);
    Json stepOut(const Arguments& arguments);
    Json stepBack(const Arguments& arguments);
    Json reverseContinue(const Arguments& arguments);
    Json pause(const Arguments& arguments);
    Json gotoTargets(const Arguments& arguments);
    Json goTo(const Arguments& arguments);

    /// The task of the request, which must stand still.
    rt::Task& standing(const Arguments& arguments);
    /// Carries out an order of the debugger.
    void order(const std::function<std::string()>& action);

    Context& context_;
    std::function<void()> goesOn_;
    std::map<int64_t, Target> targets_;
    int64_t lastTarget_ = 0;
};

} // namespace rapidc::dap
