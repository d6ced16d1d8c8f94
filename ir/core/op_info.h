#pragma once
// The properties of each opcode in instructions.def, as data.

#include <cstdint>
#include <string_view>

#include "ir/core/ir.h"

namespace ir {

/// How the type of an instruction's value is found (column `result` of instructions.def).
enum class ResultRule : char { None = 'N', Same = 'S', Bool = 'B', Ptr = 'P', Typed = 'T' };

/// The effect of an instruction. Code that dispatches over instructions switches over this and then over the instructions of one
/// family (LeafOp ...), without `default`.
enum class Family : uint8_t { Leaf, Memory, Float, Int, Compare, Logic, Convert, Action, End };

/// The parts of the textual form besides operands; also which table Inst::index refers to.
enum class Form : uint8_t {
    Plain,
    Number,      ///< Inst::number or Inst::integer
    Param,       ///< index: Routine::params
    Local,       ///< index: Routine::locals
    Global,      ///< index: Module::globals, by name
    TypeDesc,    ///< index: Module::typeDescs
    Routine,     ///< index: Module::routines, by name
    Sysvar,      ///< extra: SysvarKind
    Field,       ///< after the operand: index of a field of the record Inst::type
    Error,       ///< after the operand: extra, an error number
    CallRoutine, ///< index: Module::routines, by name; operands in parentheses
    CallNative,  ///< index: Module::natives, by name; operands in parentheses
    Cost,        ///< extra, then an operand if there is one
    Statement,   ///< index: Routine::statements
    Jump,        ///< target[0]
    Branch,      ///< operand, then target[0] and target[1]
    Switch       ///< operand, target[0], then cases
};

struct OpInfo {
    std::string_view name; ///< as in enum Op
    std::string_view text; ///< as in the textual form
    Family family{};
    Form form{};
    int operands = 0; ///< -1 = any number
    ResultRule result = ResultRule::None;
    bool mayRaise = false;
    bool terminator = false;
    bool touchesMemory = false; ///< memory or other state
    bool atStatement = false;   ///< the runtime looks at the statement that the instruction belongs to
    bool showsType =
        false; ///< Inst::type names the type accessed or, for rule T, the result: the text has to show it
};

// The instructions of one family; each has the value that it has in Op.
enum class LeafOp : uint8_t {
#define LEAF_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class MemoryOp : uint8_t {
#define MEMORY_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class FloatOp : uint8_t {
#define FLOAT_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class IntOp : uint8_t {
#define INT_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class CompareOp : uint8_t {
#define COMPARE_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class LogicOp : uint8_t {
#define LOGIC_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class ConvertOp : uint8_t {
#define CONVERT_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class ActionOp : uint8_t {
#define ACTION_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};
enum class EndOp : uint8_t {
#define END_INST(name, ...) name = static_cast<uint8_t>(Op::name),
#include "ir/core/instructions.def"
};

const OpInfo& opInfo(Op op);
inline Family familyOf(Op op) {
    return opInfo(op).family;
}
/// The instruction as one of its family: as<FloatOp>(inst.op) when familyOf() says Float.
template <class FamilyOp> constexpr FamilyOp as(Op op) {
    return static_cast<FamilyOp>(op);
}
/// The result is a whole number: infinity and decimals of the operands do not show in it.
constexpr bool dropsDecimals(Op op) {
    return op == Op::FTrunc || op == Op::FQuot || op == Op::FRem;
}
/// Opcode for a textual name; false when there is none.
bool opFromText(std::string_view text, Op& op);

enum class NumberClass : uint8_t { Integer, Float };
enum class WidthRule : uint8_t { Any, Wider, Narrower };
/// The types of a conversion.
struct Conversion {
    Op op;
    NumberClass from, to;
    WidthRule width; ///< of the result, compared to the operand
};
/// Of an instruction of the family Convert.
const Conversion& conversionOf(Op op);
/// May the conversion turn `from` into `to`?
bool converts(Op op, TypeId from, TypeId to);

} // namespace ir
