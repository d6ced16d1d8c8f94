#pragma once
// BreakpointRequests: breakpoints of all kinds and exception filters, as the client orders them. They outlive a program:
// a restart has them again.

#include "tools/rapidc/dap/break_rule.h"
#include "tools/rapidc/dap/context.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace rapidc::dap {

class BreakpointRequests {
  public:
    explicit BreakpointRequests(Context& context) : context_(context) {}
    void addTo(Handlers& handlers);
    /// The filters that clients may choose among.
    static Json exceptionFilters();

    /// A program has been made: all breakpoints are set in it, and the client learns what has become of them.
    void programMade();
    /// Number of the client for a breakpoint of the debugger; 0: it has none.
    int numberOf(int id) const;
    /// At an error that no handler takes: the filter "all" means those as well.
    bool stopsAtError(int number) const {
        return unhandled_.includes(number, context_) || all_.includes(number, context_);
    }
    bool stopsAtHandledError(int number) const { return all_.includes(number, context_); }

  private:
    struct Wanted {
        int number = 0; ///< of the client
        int id = 0;     ///< of the debugger; 0: it is not set
        uint32_t line = 0;
        std::string name; ///< path, routine, data
        std::string condition, hitCondition, logMessage;
        std::string problem;
        std::shared_ptr<BreakRule> rule;
    };
    struct Filter {
        bool on = false;
        bool everyError = false;      ///< whatever `errors` has
        std::set<std::string> errors; ///< upper case names and numbers
        bool includes(int number, const Context& context) const;
    };

    Json setBreakpoints(const Arguments& arguments);
    Json setFunctionBreakpoints(const Arguments& arguments);
    Json setDataBreakpoints(const Arguments& arguments);
    Json dataBreakpointInfo(const Arguments& arguments);
    Json setExceptionBreakpoints(const Arguments& arguments);
    Json breakpointLocations(const Arguments& arguments);

    Wanted read(const Arguments& arguments) const;
    void set(Wanted& wanted, bool atRoutine);
    void setData(Wanted& wanted);
    void remove(const Wanted& wanted);
    rt::BreakCondition conditionOf(Wanted& wanted);
    Json describe(const Wanted& wanted) const;
    const rt::Breakpoint* find(int id) const;
    void changed(const rt::Breakpoint& breakpoint);
    /// The words of a condition, in upper case.
    static std::vector<std::string> errorsIn(const std::string& condition);
    /// A number, a predefined error, or an errnum of the program.
    bool isError(const std::string& word) const;
    /// Returns why the filter cannot be set, or "".
    std::string addFilter(const std::string& name, const std::string& condition, Filter& unhandled,
                          Filter& all) const;

    Context& context_;
    std::map<std::string, std::vector<Wanted>> lines_; ///< by path
    std::vector<Wanted> routines_, data_;
    Filter unhandled_{true, true, {}}, all_;
    mutable int lastNumber_ = 0;
};

} // namespace rapidc::dap
