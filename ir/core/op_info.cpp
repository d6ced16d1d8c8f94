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
     hasFlag(#flags, 'W'),                                                                                   \
     hasFlag(#flags, 'Y')},
#include "ir/core/instructions.def"
};

constexpr Conversion kConversions[] = {
#define CONVERT_INST(name, text, from, to, width)                                                            \
    {Op::name, NumberClass::from, NumberClass::to, WidthRule::width},
#include "ir/core/instructions.def"
};

constexpr auto kFirstConversion = static_cast<size_t>(kConversions[0].op);
static_assert(static_cast<size_t>(kConversions[std::size(kConversions) - 1].op) ==
                  kFirstConversion + std::size(kConversions) - 1,
              "the instructions of the family follow each other");

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
    case ResultRule::Typed: return inst.type;
    }
    return kVoid;
}

const Conversion& conversionOf(Op op) {
    return kConversions[static_cast<size_t>(op) - kFirstConversion];
}

bool converts(Op op, TypeId from, TypeId to) {
    const Conversion& conversion = conversionOf(op);
    const auto isOf = [](NumberClass wanted, TypeId type) {
        return wanted == NumberClass::Float ? isFloat(type) : isInteger(type);
    };
    if (!isOf(conversion.from, from) || !isOf(conversion.to, to)) return false;
    switch (conversion.width) {
    case WidthRule::Any: return true;
    case WidthRule::Wider: return bitsOf(to) > bitsOf(from);
    case WidthRule::Narrower: return bitsOf(to) < bitsOf(from);
    }
    return false;
}

} // namespace ir
