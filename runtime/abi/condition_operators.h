#pragma once
// Operators of conditions that the runtime evaluates (SetupCyclicBool). Lowering and the natives share them.

#include <cstdint>

namespace rt {

/// Not and Negate take one operand, the others two.
enum class ConditionOperator : int32_t {
    Not,
    Negate,
    And,
    Or,
    Xor,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    IntegerDivide,
    Modulo
};

} // namespace rt
