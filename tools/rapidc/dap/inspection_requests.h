#pragma once
// InspectionRequests: the call stack, data, expressions, completions, errors.

#include "tools/rapidc/dap/context.h"
#include "tools/rapidc/dap/variables.h"

#include <deque>
#include <map>
#include <string>
#include <vector>

namespace rapidc::dap {

/// The reason why the program is halted, as far as it is an error.
struct StopError {
    const rt::Task* task = nullptr;
    int number = 0;
    bool handled = false;
    std::string name; ///< of the error, "" when it has none
    std::string text;
};

class InspectionRequests {
  public:
    explicit InspectionRequests(Context& context);
    void addTo(Handlers& handlers);

    /// The program continues: frames and references mean nothing any more.
    void forget();
    void setError(StopError error) { error_ = std::move(error); }
    /// The program has ended: evaluations that wait are refused.
    void refuseWaiting();

  private:
    struct FrameList {
        int64_t first = 0; ///< id of its first frame
        std::vector<rt::DebugFrame> frames;
    };
    struct Waiting {
        Request request;
        Site site;
        const CompiledExpression* code = nullptr;
        std::string expression;
        bool isOrder = false;
        uint64_t number = 0;
    };

    Json stackTrace(const Arguments& arguments);
    Json scopes(const Arguments& arguments);
    Json exceptionInfo(const Arguments& arguments);
    Json completions(const Arguments& arguments);
    Json setExpression(const Arguments& arguments);
    std::optional<Json> evaluate(const Request& request, const Arguments& arguments);

    FrameList& framesOf(rt::Task& task);
    FramePlace framePlace(int64_t id) const;
    Json describe(const rt::DebugFrame& frame, int64_t id) const;
    /// The frame of the request's frameId, else that of the task that stopped.
    Site site(const Arguments& arguments);
    std::optional<Json> evaluateIn(const Request& request, const Site& site, const std::string& text,
                                   const std::string& context);
    void execute(Waiting waiting);
    void begin();
    void finish(const Waiting& waiting, Evaluation result);
    Json resultOf(const Evaluation& value, const std::string& expression);

    Context& context_;
    Variables variables_;
    std::map<const rt::Task*, FrameList> frames_;
    int64_t nextFrame_ = 1;
    StopError error_;
    std::deque<Waiting> waiting_;
    uint64_t lastWaiting_ = 0;
};

/// "TPWrite" and so on: what begins as the text before the column ends. For the `completions` request.
Json completionsFor(Context& context, const Site& site, const std::string& text, std::size_t column,
                    const std::vector<rt::DebugVariable>& data);

} // namespace rapidc::dap
