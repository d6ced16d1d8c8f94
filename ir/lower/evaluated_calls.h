#pragma once
// EvaluatedCalls: the results of calls that the compiler has made itself.

#include "ir/lower/lower.h"

#include <deque>
#include <unordered_map>

namespace rapid::lower {

/// A value for each parameter, as Options::evaluate takes them.
using ConstArguments = std::vector<const sema::ConstValue*>;

class EvaluatedCalls {
  public:
    explicit EvaluatedCalls(const Options& options) : evaluate_(options.evaluate) {}

    /// The result of the function depends on its arguments alone.
    bool covers(const sema::RoutineSymbol& callee) const;
    /// The result for these arguments; null if the function raises an error or cannot be called here.
    const sema::ConstValue* evaluate(const sema::RoutineSymbol& callee, const ConstArguments& arguments);

    /// Of calls that have been looked at; null: not constant.
    std::unordered_map<const syntax::Node*, const sema::ConstValue*> known;

  private:
    const decltype(Options::evaluate)& evaluate_;
    std::deque<sema::ConstValue> results_;
    Arena texts_;
};

} // namespace rapid::lower
