#pragma once
// ExecutionRequests: threads, continuing, stepping, pausing and moving the program pointer.

#include "tools/rapidc/dap/context.h"

#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace rapidc::dap {

class ExecutionRequests {
  public:
    /// `onContinue` is called before an order continues the program.
    ExecutionRequests(Context& context, std::function<void()> onContinue)
        : context_(context), onContinue_(std::move(onContinue)) {}
    void addTo(Handlers& handlers);
    void forgetTargets() { targets_.clear(); }
    /// Whether the stop that is due now is that of a frame that was restarted; the next one is not.
    bool takeRestart() { return std::exchange(restarting_, false); }

  private:
    struct Target {
        std::string routine, module; ///< where the statement is
        uint32_t line = 0;
    };

    Json threads(const Arguments& arguments);
    Json continueProgram(const Arguments& arguments);
    Json stepOver(const Arguments& arguments) { return step(arguments, false); }
    Json stepInto(const Arguments& arguments) { return step(arguments, true); }
    Json step(const Arguments& arguments, bool into);
    Json stepOut(const Arguments& arguments);
    Json stepBack(const Arguments& arguments);
    Json reverseContinue(const Arguments& arguments);
    std::optional<Json> pause(const Request& request, const Arguments& arguments);
    Json gotoTargets(const Arguments& arguments);
    Json goTo(const Arguments& arguments);
    Json restartFrame(const Arguments& arguments);

    /// The task of the request, which must stand still.
    rt::Task& standing(const Arguments& arguments);
    /// Carries out an order of the debugger.
    void order(const std::function<std::string()>& action);

    Context& context_;
    std::function<void()> onContinue_;
    std::map<int64_t, Target> targets_;
    int64_t lastTarget_ = 0;
    bool restarting_ = false;
};

} // namespace rapidc::dap
