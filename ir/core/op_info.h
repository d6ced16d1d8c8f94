#pragma once
// What instructions.def says about each opcode, as data.

#include <string_view>

#include "ir/core/ir.h"

namespace ir {

/// How the type of an instruction's value is found (column `result` of instructions.def).
enum class ResultRule : char { None = 'N', Same = 'S', Bool = 'B', Ptr = 'P', Typed = 'T', Fixed = 'F' };

struct OpInfo {
    std::string_view name; ///< as in enum Op
    std::string_view text; ///< as in the textual form
    int operands = 0;      ///< -1 = any number
    ResultRule result = ResultRule::None;
    bool mayRaise = false;
    bool terminator = false;
    bool touchesMemory = false; ///< memory or other state
};

const OpInfo& opInfo(Op op);
/// Opcode for a textual name; false when there is none.
bool opFromText(std::string_view text, Op& op);

/// For conversions: the operand's and the result's type. kVoid for other opcodes.
TypeId conversionFrom(Op op);
TypeId conversionTo(Op op);
/// True when Inst::type names the type accessed or, for rule T, the result: the textual form has to show it.
bool showsType(Op op);

} // namespace ir
