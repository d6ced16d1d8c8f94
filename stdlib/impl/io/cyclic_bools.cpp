#include "stdlib/impl/io/cyclic_bools.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rt::lib {

// ---- Condition -------------------------------------------------------------------------------------------------------

void Condition::pushValue(double value) {
    Step step;
    step.value = value;
    steps_.push_back(step);
}

void Condition::pushData(const void* data, Form form) {
    Step step;
    step.kind = Kind::Data;
    step.form = form;
    step.data = data;
    steps_.push_back(step);
}

void Condition::pushSignal(Handle signal, bool asDnum) {
    Step step;
    step.kind = Kind::Signal;
    step.asDnum = asDnum;
    step.signal = signal;
    steps_.push_back(step);
}

void Condition::pushOperator(ConditionOperator operation, bool asDnum) {
    Step step;
    step.kind = Kind::Operator;
    step.asDnum = asDnum;
    step.operation = operation;
    steps_.push_back(step);
}

namespace {

template <class T> double valueAt(const void* data) {
    T value{};
    std::memcpy(&value, data, sizeof value);
    return static_cast<double>(value);
}

double readData(const void* data, Condition::Form form) {
    switch (form) {
    case Condition::Form::Bool: return valueAt<uint8_t>(data) != 0 ? 1 : 0;
    case Condition::Form::Num: return valueAt<float>(data);
    case Condition::Form::Dnum: break;
    }
    return valueAt<double>(data);
}

/// DIV and MOD of integers; nothing for other numbers and for a division by 0.
std::optional<double> dividedWhole(double a, double b, bool remainder) {
    if (b == 0 || std::trunc(a) != a || std::trunc(b) != b) return {};
    return remainder ? std::fmod(a, b) : std::trunc(a / b);
}

std::optional<double> applied(ConditionOperator operation, double a, double b) {
    switch (operation) {
    case ConditionOperator::Not: return b == 0;
    case ConditionOperator::Negate: return -b;
    case ConditionOperator::And: return a != 0 && b != 0;
    case ConditionOperator::Or: return a != 0 || b != 0;
    case ConditionOperator::Xor: return (a != 0) != (b != 0);
    case ConditionOperator::Equal: return a == b;
    case ConditionOperator::NotEqual: return a != b;
    case ConditionOperator::Less: return a < b;
    case ConditionOperator::LessOrEqual: return a <= b;
    case ConditionOperator::Greater: return a > b;
    case ConditionOperator::GreaterOrEqual: return a >= b;
    case ConditionOperator::Add: return a + b;
    case ConditionOperator::Subtract: return a - b;
    case ConditionOperator::Multiply: return a * b;
    case ConditionOperator::Divide: return b == 0 ? std::optional<double>() : a / b;
    case ConditionOperator::IntegerDivide: return dividedWhole(a, b, false);
    case ConditionOperator::Modulo: return dividedWhole(a, b, true);
    }
    return {};
}

bool takesOne(ConditionOperator operation) {
    return operation == ConditionOperator::Not || operation == ConditionOperator::Negate;
}

} // namespace

std::optional<bool> Condition::evaluate(const IoSystem& io, std::string& why) const {
    std::vector<double> stack;
    stack.reserve(steps_.size());
    for (const Step& step : steps_) {
        if (step.kind == Kind::Value) {
            stack.push_back(step.value);
        } else if (step.kind == Kind::Data) {
            stack.push_back(readData(step.data, step.form));
        } else if (step.kind == Kind::Signal) {
            IoResult result = IoResult::Ok;
            const double value = io.read(step.signal, result);
            if (result != IoResult::Ok) {
                const SignalId id = io.idOf(step.signal);
                why = "signal " + (id < 0 ? std::string("of the condition") : io.config(id).name) +
                      " cannot be read";
                return {};
            }
            stack.push_back(step.asDnum ? value : static_cast<float>(value));
        } else {
            const bool one = takesOne(step.operation);
            const double right = stack.back();
            const double left = one ? 0 : stack[stack.size() - 2];
            stack.resize(stack.size() - (one ? 1 : 2));
            const std::optional<double> result = applied(step.operation, left, right);
            if (!result) {
                why = "it divides by 0, or applies DIV or MOD to a number that is not an integer";
                return {};
            }
            stack.push_back(step.asDnum ? *result : static_cast<float>(*result));
        }
    }
    return !stack.empty() && stack.back() != 0;
}

// ---- CyclicBools -----------------------------------------------------------------------------------------------------

CyclicBools::~CyclicBools() = default;

/// Nothing changes between two evaluations with the same data and signals. So the period runs only from a change to the next
/// multiple of 12 ms, and a program whose flags all fit can end.
bool CyclicBools::add(Controller& controller, CyclicBool entry) {
    controller_ = &controller;
    remove(entry.flag);
    if (entries_.size() >= kMost) return false;
    entries_.push_back(std::make_unique<CyclicBool>(std::move(entry)));
    std::string why;
    CyclicBool& added = *entries_.back();
    if (const std::optional<bool> value = added.condition.evaluate(controller.io(), why)) set(added, *value);
    if (watch_ != 0) return true;
    watch_ = controller.scheduler().watchData([this] { look(); });
    listener_ = controller.io().addListener(-1, [this](SignalId, double, double) { look(); });
    return true;
}

void CyclicBools::remove(const bool* flag) {
    std::erase_if(entries_, [flag](const auto& entry) { return entry->flag == flag; });
    stopIfEmpty();
}

void CyclicBools::removeAll() {
    entries_.clear();
    stopIfEmpty();
}

void CyclicBools::removeOf(uint32_t task) {
    std::erase_if(entries_, [task](const auto& entry) { return entry->task == task; });
    stopIfEmpty();
}

void CyclicBools::stopIfEmpty() {
    if (!entries_.empty() || watch_ == 0) return;
    controller_->scheduler().unwatchData(watch_);
    controller_->io().removeListener(listener_);
    if (due_ != 0) controller_->scheduler().cancel(due_);
    watch_ = due_ = 0;
    listener_ = 0;
}

const CyclicBool* CyclicBools::find(const bool* flag) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [flag](const auto& entry) { return entry->flag == flag; });
    return found == entries_.end() ? nullptr : found->get();
}

void CyclicBools::look() {
    if (due_ != 0) return;
    if (std::none_of(entries_.begin(), entries_.end(), [this](const auto& entry) { return isDue(*entry); }))
        return;
    Scheduler& scheduler = controller_->scheduler();
    const Time next = (scheduler.now() / kPeriod + 1) * kPeriod;
    due_ = scheduler.at(next, [this] { evaluateAll(); });
}

bool CyclicBools::isDue(CyclicBool& entry) {
    std::string why;
    const std::optional<bool> value = entry.condition.evaluate(controller_->io(), why);
    return value ? *value != *entry.flag || entry.failed : !entry.failed;
}

void CyclicBools::evaluateAll() {
    due_ = 0;
    for (const auto& entry : entries_) {
        std::string why;
        const std::optional<bool> value = entry->condition.evaluate(controller_->io(), why);
        if (value)
            set(*entry, *value);
        else if (!entry->failed)
            controller_->log().write(EventId::CyclicBoolFailed, nullptr, {entry->name, why});
        entry->failed = !value;
    }
    controller_->scheduler().lookAtData(); // of those that watch the flags
    look();
}

void CyclicBools::set(CyclicBool& entry, bool value) {
    *entry.flag = value;
    if (entry.output != 0) controller_->io().set(entry.output, value ? 1 : 0);
}

} // namespace rt::lib
