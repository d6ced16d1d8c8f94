#pragma once
// Evaluator: values of expressions in a program that stands still, or at the statement that a task is about to execute.

#include "runtime/host/controller.h"
#include "tools/rapidc/dap/expression_compiler.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::dap {

/// Where an expression is looked at from.
struct Site {
    rt::Task* task = nullptr;
    rt::Frame* frame = nullptr; ///< null: data of modules only
};

struct Evaluation {
    std::string problem; ///< "" when there is a value, or instructions have been executed
    bool hasValue = false;
    rt::DebugVariable value;
    std::shared_ptr<void> storage; ///< what the value lies in, when it is no part of the program
};

/// Dimensions of a value, as many as it has.
std::vector<int32_t> dimensionsOf(const rt::DebugVariable& variable);
/// Of an array: the type of its elements; otherwise its own.
const rt::TypeDesc& elementTypeOf(const rt::DebugVariable& variable);
/// Of an array with that index in its first dimension: an element, or a row that is an array itself.
rt::DebugVariable rowOf(const rt::DebugVariable& variable, int32_t index);

class Evaluator {
  public:
    Evaluator(const Compilation& compilation, rt::Controller& controller)
        : controller_(controller), compiler_(compilation, controller) {}

    /// A data object or a part of one: "n", "part{2}.pos.x". No code is executed, so the program may execute meanwhile.
    Evaluation find(const Site& site, const std::string& text) const;
    /// "" or why the text means nothing in that routine.
    std::string check(int32_t task, const rt::RoutineDesc* routine, const std::string& text,
                      ExpressionKind kind);
    /// Null with a problem.
    const CompiledExpression* compile(const Site& site, const std::string& text, ExpressionKind kind,
                                      std::string& problem);
    /// On the fibre of the task.
    Evaluation now(const Site& site, const CompiledExpression& expression) const;
    /// As soon as the task can; `done` is called on its fibre.
    void later(const Site& site, const CompiledExpression& expression, std::function<void(Evaluation)> done);
    /// Ends what later() began; `done` is called then, too.
    void breakOff();
    bool isBusy() const { return busy_ != nullptr; }

  private:
    static rt::Status call(rt::Task& task, rt::Frame* caller, const Site& site,
                           const CompiledExpression& expression, Evaluation& result);

    rt::Controller& controller_;
    ExpressionCompiler compiler_;
    rt::Task* busy_ = nullptr;
    std::function<void(Evaluation)> done_;
};

} // namespace rapidc::dap
