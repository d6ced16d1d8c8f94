#pragma once
// The line-mode debugger of `rapidc run --step`: reads commands from stdin while the program stands still, writes to
// stdout.

#include "runtime/debug/debugger.h"
#include "runtime/host/controller.h"
#include "tools/rapidc/dap/evaluator.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc {

class LineDebugger final : public rt::DebugClient {
  public:
    LineDebugger(rt::Controller& controller, const Compilation& compilation)
        : controller_(controller), evaluator_(compilation, controller) {}
    /// The program stops ahead of its first instruction from now on.
    void attach();

    void stopped(rt::Debugger& debugger, rt::Task& task, rt::StopReason reason) override;

  private:
    struct Command {
        const char* names;   ///< "step s"
        const char* usage;   ///< arguments
        const char* meaning; ///< one sentence
        /// True: the program goes on (or the run ends).
        bool (LineDebugger::*action)(std::string_view arguments);
    };
    static const std::vector<Command>& commands();
    bool execute(std::string_view line);

    bool help(std::string_view);
    bool run(std::string_view);
    bool stepIn(std::string_view);
    bool stepOver(std::string_view);
    bool stepOut(std::string_view);
    bool stepMove(std::string_view);
    bool stepBackward(std::string_view);
    bool cursor(std::string_view);
    bool pointer(std::string_view);
    bool breakAt(std::string_view);
    bool breakpoints(std::string_view);
    bool deleteBreakpoint(std::string_view);
    bool where(std::string_view);
    bool selectFrame(std::string_view);
    bool locals(std::string_view);
    bool globals(std::string_view);
    bool print(std::string_view);
    bool set(std::string_view);
    bool perform(std::string_view);
    bool tasks(std::string_view);
    bool selectTask(std::string_view);
    bool list(std::string_view);
    bool robot(std::string_view);
    bool quit(std::string_view);

    /// Shows what stood in the way of an order; true when nothing did.
    bool went(const std::string& problem);
    /// Executes the text where the program has stopped. True: the scheduler has to work for that.
    bool evaluate(std::string_view text, dap::ExpressionKind kind);
    bool holds(rt::Task& task, rt::Frame* at, const std::string& condition);
    bool movedPointer(const std::string& problem);
    const rt::DebugFrame* frame();
    void showPlace(const rt::SourcePlace& place);
    void showStop();
    const std::vector<std::string>& source(const std::string& file);
    /// "MODULE:LINE" or "LINE" in the module of the selected frame.
    bool readPlace(std::string_view text, std::string& module, uint32_t& line);

    rt::Controller& controller_;
    dap::Evaluator evaluator_;
    rt::Debugger* debugger_ = nullptr;
    rt::Task* task_ = nullptr;
    std::vector<rt::DebugFrame> frames_;
    std::size_t selected_ = 0;
    rt::StopReason reason_ = rt::StopReason::Entry;
    bool sameStop_ = false; ///< an evaluation has ended, and the program is where it was
    std::string lastCommand_ = "step";
    std::map<std::string, std::vector<std::string>> sources_;
};

} // namespace rapidc
