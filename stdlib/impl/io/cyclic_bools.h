#pragma once
// Cyclic bools: persistents that follow a logical condition, which the controller evaluates every 12 ms.

#include "runtime/abi/condition_operators.h"
#include "runtime/host/controller.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// A condition in postfix notation, over values, data and signals that stay while it is used.
class Condition {
  public:
    enum class Form : int32_t { Bool, Num, Dnum };

    void pushValue(double value);
    void pushData(const void* data, Form form);
    void pushSignal(Handle signal, bool asDnum);
    void pushOperator(ConditionOperator operation, bool asDnum);
    /// The value now; nothing, and the reason in `why`, when there is none (device off, division by 0).
    std::optional<bool> evaluate(const IoSystem& io, std::string& why) const;

    enum class Kind : uint8_t { Value, Data, Signal, Operator };
    struct Step {
        Kind kind = Kind::Value;
        bool asDnum = false;
        Form form = Form::Bool;
        ConditionOperator operation{};
        double value = 0;
        const void* data = nullptr;
        Handle signal = 0;
    };
    const std::vector<Step>& steps() const { return steps_; }

  private:
    std::vector<Step> steps_;
};

struct CyclicBool {
    std::string name; ///< of the persistent, without module
    bool* flag = nullptr;
    Handle output = 0; ///< digital output that follows the flag; 0: none
    uint32_t task = 0; ///< of the SetupCyclicBool
    Condition condition;
    bool failed = false; ///< without a value when it was evaluated last; reported
};

/// All cyclic bools of a controller. A service of it.
class CyclicBools {
  public:
    static constexpr std::size_t kMost = 60;
    static constexpr Time kPeriod = 12 * kMillisecond;

    ~CyclicBools();
    /// Replaces the one with the same flag. False: there are kMost already.
    bool add(Controller& controller, CyclicBool entry);
    void remove(const bool* flag);
    void removeAll();
    void removeOf(uint32_t task);
    const CyclicBool* find(const bool* flag) const;
    const std::vector<std::unique_ptr<CyclicBool>>& all() const { return entries_; }

  private:
    void look();
    bool isDue(CyclicBool& entry);
    void evaluateAll();
    void stopIfEmpty();
    void set(CyclicBool& entry, bool value);

    Controller* controller_ = nullptr;
    std::vector<std::unique_ptr<CyclicBool>> entries_;
    EventToken watch_ = 0, due_ = 0;
    uint64_t listener_ = 0;
};

/// Cyclic bools are kept between two processes (--state).
void keepCyclicBools(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
