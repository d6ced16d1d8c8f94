#include "tools/rapidc/dap/evaluator.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <deque>
#include <utility>

namespace rapidc::dap {
namespace {

ExpressionScope scopeOf(int32_t task, const rt::RoutineDesc* routine) {
    ExpressionScope scope;
    scope.task = task;
    if (routine == nullptr) return scope;
    scope.module = routine->module;
    scope.routine = routine->name;
    return scope;
}

const rt::RoutineDesc* routineOf(const Site& site) {
    return site.frame != nullptr ? site.frame->routine : nullptr;
}

/// The arguments of a call of the code of an expression.
class CallArguments {
  public:
    CallArguments(const rt::Controller& controller, const Site& site, const CompiledExpression& expression) {
        if (site.frame != nullptr && !expression.names.empty())
            locals_ = const_cast<rt::Controller&>(controller)
                          .debugger()
                          .locals({rt::placeOf(site.frame), site.frame, false});
        list_.push_back({&error_, expression.entry->params[0].type, nullptr});
        if (expression.hasValue) {
            const rt::TypeDesc& type = *expression.entry->params[1].type;
            const std::size_t words = type.size / sizeof(std::max_align_t) + 1;
            value_ = std::shared_ptr<std::max_align_t[]>(new std::max_align_t[words]());
            list_.push_back({value_.get(), &type, nullptr});
        }
        for (const std::string& name : expression.names) {
            rt::LateArg argument = local(name);
            // A switch is given when its byte is set.
            if (expression.entry->params[list_.size()].type == nullptr && argument.data != nullptr &&
                *static_cast<const char*>(argument.data) == 0)
                argument.data = nullptr;
            list_.push_back(argument);
        }
    }

    const rt::LateArg* list() const { return list_.data(); }
    bool failed() const { return error_ != 0; }
    std::shared_ptr<void> value() const { return value_; }

  private:
    rt::LateArg local(const std::string& name) {
        const auto same = [&name](const rt::DebugVariable& variable) {
            return rt::sameName(variable.name, name);
        };
        const auto found = std::find_if(locals_.begin(), locals_.end(), same);
        if (found == locals_.end()) return {nullptr, nullptr, nullptr};
        if (found->rank == 0) return {found->data, found->type, nullptr};
        rt::TypeDesc& type = types_.emplace_back(*found->type); // only its dimensions are looked at
        std::copy(std::begin(found->dims), std::end(found->dims), std::begin(type.dims));
        return {found->data, &type, nullptr};
    }

    std::vector<rt::DebugVariable> locals_;
    std::deque<rt::TypeDesc> types_;
    std::vector<rt::LateArg> list_;
    float error_ = 0;
    std::shared_ptr<std::max_align_t[]> value_;
};

/// "grid{2,*}" names a row, which is no expression of the language: the reference before the braces, and the numbers.
bool isRow(std::string_view text, std::string& array, std::vector<int32_t>& indices) {
    text = rt::trimmed(text);
    const std::size_t open = text.rfind('{');
    if (open == std::string_view::npos || text.back() != '}' || text[text.size() - 2] != '*') return false;
    array = std::string(text.substr(0, open));
    std::string_view list = text.substr(open + 1, text.size() - open - 2);
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        const std::string_view one = rt::trimmed(list.substr(0, comma));
        list.remove_prefix(std::min(comma + 1, list.size()));
        int32_t index = 0;
        const auto [end, problem] = std::from_chars(one.data(), one.data() + one.size(), index);
        if (problem == std::errc() && end == one.data() + one.size())
            indices.push_back(index);
        else if (one != "*")
            return false;
    }
    return true;
}

} // namespace

std::vector<int32_t> dimensionsOf(const rt::DebugVariable& variable) {
    std::vector<int32_t> dims;
    const bool fixed = variable.rank == 0 && variable.type->kind == rt::DescKind::Array;
    const int32_t* from = fixed ? variable.type->dims : variable.dims;
    const std::size_t most = fixed ? 3 : variable.rank;
    for (std::size_t k = 0; k < most && (!fixed || from[k] > 0); ++k)
        dims.push_back(from[k]);
    return dims;
}

const rt::TypeDesc& elementTypeOf(const rt::DebugVariable& variable) {
    return variable.rank == 0 && variable.type->kind == rt::DescKind::Array ? *variable.type->fields[0]
                                                                            : *variable.type;
}

rt::DebugVariable rowOf(const rt::DebugVariable& variable, int32_t index) {
    const std::vector<int32_t> dims = dimensionsOf(variable);
    rt::DebugVariable row = variable;
    row.type = &elementTypeOf(variable);
    std::size_t size = row.type->size;
    for (std::size_t k = 1; k < dims.size(); ++k)
        size *= static_cast<std::size_t>(dims[k]);
    row.data = static_cast<char*>(variable.data) + static_cast<std::size_t>(index - 1) * size;
    row.rank = static_cast<uint8_t>(dims.size() - 1);
    std::fill(std::begin(row.dims), std::end(row.dims), 0);
    std::copy(dims.begin() + 1, dims.end(), std::begin(row.dims));
    return row;
}

Evaluation Evaluator::find(const Site& site, const std::string& text) const {
    Evaluation result;
    std::string array;
    std::vector<int32_t> indices;
    if (isRow(text, array, indices)) {
        result = find(site, array);
        for (const int32_t index : indices) {
            if (!result.hasValue) return result;
            const std::vector<int32_t> dims = dimensionsOf(result.value);
            if (!dims.empty() && result.value.data != nullptr && index >= 1 && index <= dims[0]) {
                result.value = rowOf(result.value, index);
                continue;
            }
            result.hasValue = false;
            result.problem = fmt::format("'{}' is not part of an array", text);
        }
        return result;
    }
    rt::DebugFrame frame;
    if (site.frame != nullptr) frame = {rt::placeOf(site.frame), site.frame, false};
    result.value = controller_.debugger().find(*site.task, site.frame != nullptr ? &frame : nullptr, text,
                                               result.problem);
    result.hasValue = result.problem.empty() && result.value.type != nullptr;
    return result;
}

std::string Evaluator::check(int32_t task, const rt::RoutineDesc* routine, const std::string& text,
                             ExpressionKind kind) {
    std::string problem;
    compiler_.compile(scopeOf(task, routine), text, kind, problem);
    return problem;
}

const CompiledExpression* Evaluator::compile(const Site& site, const std::string& text, ExpressionKind kind,
                                             std::string& problem) {
    ExpressionScope scope = scopeOf(static_cast<int32_t>(site.task->index()), routineOf(site));
    if (site.frame == nullptr) scope.module = site.task->place().module;
    return compiler_.compile(scope, text, kind, problem);
}

rt::Status Evaluator::call(rt::Task& task, rt::Frame* caller, const Site& site,
                           const CompiledExpression& expression, Evaluation& result) {
    const CallArguments arguments(task.controller(), site, expression);
    const rt::Status status = expression.entry->late(&task, caller, arguments.list(), nullptr);
    if (status != rt::kOk) {
        result.problem = status > 0 ? task.errorText() : "the evaluation was broken off";
    } else if (arguments.failed()) {
        result.problem = task.errorText();
    } else if (expression.hasValue) {
        result.storage = arguments.value();
        result.value.type = expression.entry->params[1].type;
        result.value.data = result.storage.get();
        result.hasValue = true;
    }
    return status;
}

Evaluation Evaluator::now(const Site& site, const CompiledExpression& expression) const {
    Evaluation result;
    (void)site.task->events().visitNow(
        [&](rt::Task& task, rt::Frame* caller) { return call(task, caller, site, expression, result); });
    return result;
}

void Evaluator::later(const Site& site, const CompiledExpression& expression,
                      std::function<void(Evaluation)> done) {
    busy_ = site.task;
    done_ = std::move(done);
    site.task->events().order([this, site, &expression](rt::Task& task, rt::Frame* caller) {
        Evaluation result;
        const rt::Status status = call(task, caller, site, expression, result);
        busy_ = nullptr;
        std::exchange(done_, nullptr)(std::move(result));
        return status;
    });
}

void Evaluator::breakOff() {
    if (busy_ == nullptr || busy_->events().endVisit()) return;
    busy_ = nullptr;
    Evaluation result;
    result.problem = "the evaluation was broken off";
    std::exchange(done_, nullptr)(std::move(result));
}

} // namespace rapidc::dap
