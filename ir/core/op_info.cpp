#include "ir/core/op_info.h"

#include <array>

namespace ir {
namespace {

constexpr bool hasFlag(std::string_view flags, char flag) {
    return flags.find(flag) != std::string_view::npos;
}

constexpr OpInfo kOps[] = {
#define INST(family, name, text, form, operands, result, flags)                                              \
    {#name,                                                                                                  \
     text,                                                                                                   \
     Family::family,                                                                                         \
     Form::form,                                                                                             \
     operands,                                                                                               \
     static_cast<ResultRule>(#result[0]),                                                                    \
     hasFlag(#flags, 'R'),                                                                                   \
     Family::family == Family::End,                                                                          \
     hasFlag(#flags, 'M'),                                                                                   \
     hasFlag(#flags, 'Y')},
#include "ir/core/instructions.def"
};

struct Conversion {
    Op op;
    TypeId from, to;
};
constexpr Conversion kConversions[] = {
#define CONVERT_INST(name, text, from, to) {Op::name, from, to},
#include "ir/core/instructions.def"
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

} // namespace ir
