#include "ir/core/op_info.h"

#include <array>

namespace ir {
namespace {

constexpr bool hasFlag(std::string_view flags, char flag) {
    return flags.find(flag) != std::string_view::npos;
}

constexpr OpInfo kOps[] = {
#define INST(name, text, operands, result, flags)                                                            \
    {#name,                                                                                                  \
     text,                                                                                                   \
     operands,                                                                                               \
     static_cast<ResultRule>(#result[0]),                                                                    \
     hasFlag(#flags, 'R'),                                                                                   \
     hasFlag(#flags, 'T'),                                                                                   \
     hasFlag(#flags, 'M')},
#include "ir/core/instructions.def"
};

struct Conversion {
    Op op;
    TypeId from, to;
};
constexpr Conversion kConversions[] = {
    {Op::I32ToF32, kI32, kF32},   {Op::I32ToF64, kI32, kF64},   {Op::F32ToI32, kF32, kI32},
    {Op::F32ToIndex, kF32, kI32}, {Op::F64ToIndex, kF64, kI32}, {Op::F64ToI32, kF64, kI32},
    {Op::F32ToI64, kF32, kI64},   {Op::F64ToI64, kF64, kI64},   {Op::I64ToF32, kI64, kF32},
    {Op::I64ToF64, kI64, kF64},   {Op::F32ToF64, kF32, kF64},   {Op::F64ToF32, kF64, kF32},
    {Op::I32ToI64, kI32, kI64},   {Op::I64ToI32, kI64, kI32},
};

} // namespace

const OpInfo& opInfo(Op op) {
    return kOps[static_cast<size_t>(op)];
}

bool opFromText(std::string_view text, Op& op) {
    for (size_t i = 0; i < std::size(kOps); ++i) {
        if (kOps[i].text == text) {
            op = static_cast<Op>(i);
            return true;
        }
    }
    return false;
}

TypeId valueType(const Inst& inst) {
    switch (opInfo(inst.op).result) {
    case ResultRule::None: return kVoid;
    case ResultRule::Bool: return kBool;
    case ResultRule::Ptr: return kPtr;
    case ResultRule::Same:
    case ResultRule::Typed:
    case ResultRule::Fixed: return inst.type;
    }
    return kVoid;
}

TypeId conversionFrom(Op op) {
    for (const Conversion& c : kConversions)
        if (c.op == op) return c.from;
    return kVoid;
}

TypeId conversionTo(Op op) {
    for (const Conversion& c : kConversions)
        if (c.op == op) return c.to;
    return kVoid;
}

bool showsType(Op op) {
    switch (op) {
    case Op::Const:
    case Op::Load:
    case Op::Store:
    case Op::Copy:
    case Op::Zero:
    case Op::FieldAddr:
    case Op::ElemAddr: return true;
    default: return false;
    }
}

} // namespace ir
