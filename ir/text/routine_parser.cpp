#include <fmt/format.h>

#include "ir/core/op_info.h"
#include "ir/text/names.h"
#include "ir/text/parser.h"

namespace ir::text {

bool RoutineParser::parse() {
    in_.skipNewLines();
    while (!in_.isPunct('}'))
        if (!item()) return false;
    in_.advance();
    inferTypes();
    return resolveValues();
}

bool RoutineParser::item() {
    if (in_.peek().kind == TokenKind::End) return in_.expected("'}'");
    if (routine_.blocks.empty()) {
        if (in_.takeWord("local")) return local();
        if (in_.takeWord("stmt")) return statement();
        if (in_.isWord("errorhandler") || in_.isWord("undohandler")) return handler();
        if (in_.takeWord("detachedhandler")) return detachedHandler();
    }
    if (in_.peek().kind == TokenKind::Word && in_.peek().text.size() > 1 && in_.peek().text[0] == 'b' &&
        in_.peek().text[1] >= '0' && in_.peek().text[1] <= '9')
        return blockHeader();
    if (routine_.blocks.empty())
        return in_.expected("local, stmt, errorhandler, detachedhandler, undohandler or a block");
    return instruction();
}

bool RoutineParser::local() {
    uint32_t position = 0;
    Local entry;
    Token where = in_.peek();
    if (!in_.unsignedInt(position) || !in_.type(module_, entry.type) || !in_.string(entry.name)) return false;
    if (position != routine_.locals.size())
        return in_.failAt(where, fmt::format("local {} is expected here", routine_.locals.size()));
    entry.isParam = in_.takeWord("param");
    if (in_.takeWord("desc") && !in_.unsignedInt(entry.typeDesc)) return false;
    entry.reference = in_.takeWord("ref");
    if (in_.takeWord("dims") && (!in_.unsignedInt(entry.rank) || !in_.unsignedInt(entry.dims))) return false;
    routine_.locals.push_back(std::move(entry));
    return in_.endOfLine();
}

bool RoutineParser::statement() {
    uint32_t position = 0;
    Statement s;
    Token where = in_.peek();
    size_t kind = 0;
    if (!in_.unsignedInt(position) || !in_.oneOf(kStmtKindNames, "a kind of statement", kind)) return false;
    if (position != routine_.statements.size())
        return in_.failAt(where, fmt::format("stmt {} is expected here", routine_.statements.size()));
    s.kind = static_cast<StmtKind>(kind);
    if (!in_.unsignedInt(s.line) || !in_.punct(':') || !in_.unsignedInt(s.column)) return false;
    if (!in_.unsignedInt(s.endLine) || !in_.punct(':') || !in_.unsignedInt(s.endColumn)) return false;
    s.handled = in_.takeWord("handled");
    if (in_.takeWord("start") && !in_.block(s.start)) return false;
    if (in_.takeWord("next") && !in_.block(s.next)) return false;
    if (in_.takeWord("after") && !in_.unsignedInt(s.previous)) return false;
    uint32_t flags = 0;
    if (in_.takeWord("flags") && !in_.unsignedInt(flags)) return false;
    s.flags = static_cast<uint8_t>(flags);
    routine_.statements.push_back(s);
    return in_.endOfLine();
}

bool RoutineParser::handler() {
    bool error = in_.isWord("errorhandler");
    in_.advance();
    if (!in_.block(error ? routine_.errorHandler : routine_.undoHandler)) return false;
    if (error && in_.takePunct('[')) {
        do {
            if (in_.peek().kind == TokenKind::Name) {
                const auto place = static_cast<uint32_t>(routine_.errorFilterGlobals.size());
                Fixup fixup{Fixup::Kind::Global,      {},   in_.peek(), index_, kNone,
                            Fixup::Slot::ErrorFilter, place};
                if (!in_.name(fixup.name)) return false;
                fixups_.push_back(std::move(fixup));
                routine_.errorFilterGlobals.push_back(kNone);
                continue;
            }
            int32_t number = 0;
            if (in_.takeWord("all"))
                number = kEveryError;
            else if (in_.takeWord("own"))
                number = kOwnErrors;
            else if (!in_.signedInt(number))
                return false;
            routine_.errorFilter.push_back(number);
        } while (in_.takePunct(','));
        if (!in_.punct(']')) return false;
    }
    return in_.endOfLine();
}

bool RoutineParser::detachedHandler() {
    Fixup fixup{Fixup::Kind::Routine, {}, in_.peek(), index_, kNone, Fixup::Slot::DetachedHandler, 0};
    if (!in_.name(fixup.name) || !in_.punct('[')) return false;
    fixups_.push_back(std::move(fixup));
    while (!in_.isPunct(']')) {
        if (!in_.unsignedInt(routine_.sharedLocals.emplace_back())) return false;
        if (!in_.takePunct(',')) break;
    }
    return in_.punct(']') && in_.endOfLine();
}

bool RoutineParser::blockHeader() {
    BlockId id = 0;
    Token where = in_.peek();
    if (!in_.block(id)) return false;
    if (id != routine_.blocks.size())
        return in_.failAt(where, fmt::format("block b{} is expected here", routine_.blocks.size()));
    std::string name;
    if (in_.peek().kind == TokenKind::String && !in_.string(name)) return false;
    if (!in_.punct(':')) return false;
    routine_.blocks.push_back({routine_.blockName(name), {}});
    stmt_ = kNone;
    return in_.endOfLine();
}

bool RoutineParser::value(Inst& inst) {
    if (in_.peek().kind != TokenKind::Value) return in_.expected("a value (%name)");
    uses_.push_back({static_cast<uint32_t>(routine_.insts.size()), inst.operands.size(), in_.peek()});
    inst.operands.push_back(kNone);
    in_.advance();
    return true;
}

bool RoutineParser::values(Inst& inst) {
    int count = opInfo(inst.op).operands;
    if (count < 0) return in_.peek().kind != TokenKind::Value || value(inst); // ret, safepoint: none or one
    for (int i = 0; i < count; ++i)
        if ((i > 0 && !in_.punct(',')) || !value(inst)) return false;
    return true;
}

bool RoutineParser::reference(Fixup::Kind kind) {
    Fixup fixup{kind, {}, in_.peek(), index_, static_cast<uint32_t>(routine_.insts.size()), {}, 0};
    if (!in_.name(fixup.name)) return false;
    fixups_.push_back(std::move(fixup));
    return true;
}

bool RoutineParser::call(Inst& inst, Fixup::Kind kind) {
    if (!reference(kind) || !in_.punct('(')) return false;
    if (in_.takePunct(')')) return true;
    do {
        if (!value(inst)) return false;
    } while (in_.takePunct(','));
    return in_.punct(')');
}

bool RoutineParser::switchOn(Inst& inst) {
    if (!in_.punct(',') || !in_.block(inst.target(0)) || !in_.punct('[')) return false;
    inst.index = static_cast<uint32_t>(routine_.caseLists.size());
    std::vector<SwitchCase>& cases = routine_.caseLists.emplace_back();
    while (!in_.isPunct(']')) {
        SwitchCase entry;
        if (!in_.signedInt(entry.value) || !in_.punct(':') || !in_.block(entry.target)) return false;
        cases.push_back(entry);
        if (!in_.takePunct(',')) break;
    }
    return in_.punct(']');
}

bool RoutineParser::sysvar(Inst& inst) {
    size_t index = 0;
    if (!in_.oneOf(kSysvarNames, "error or interrupt", index)) return false;
    inst.extra = static_cast<int32_t>(index);
    return true;
}

bool RoutineParser::constant(Inst& inst) {
    double number = 0;
    int64_t integer = 0;
    if (!in_.constant(inst.type, number, integer)) return false;
    if (isFloat(inst.type))
        inst.setNumber(number);
    else
        inst.setInteger(integer);
    return true;
}

bool RoutineParser::body(Inst& inst) {
    if ((inst.op == Op::IAdd || inst.op == Op::IMul) && in_.takeWord("nsw")) inst.extra = 1;
    if (inst.op == Op::FAdd && in_.takeWord("loose")) inst.extra = 1;
    if (opInfo(inst.op).showsType && !in_.type(module_, inst.type)) return false;
    switch (opInfo(inst.op).form) {
    case Form::Plain: return values(inst);
    case Form::Number: return constant(inst);
    case Form::Param:
    case Form::Local:
    case Form::TypeDesc: return in_.unsignedInt(inst.index);
    case Form::Statement:
        if (!in_.unsignedInt(inst.index)) return false;
        stmt_ = inst.index;
        return true;
    case Form::Global: return reference(Fixup::Kind::Global);
    case Form::Routine: return reference(Fixup::Kind::Routine);
    case Form::Sysvar: return sysvar(inst);
    case Form::Field: return value(inst) && in_.punct(',') && in_.unsignedInt(inst.index);
    case Form::Error: return value(inst) && in_.punct(',') && in_.signedInt(inst.extra);
    case Form::CallRoutine: return call(inst, Fixup::Kind::Routine);
    case Form::CallNative: return call(inst, Fixup::Kind::Native);
    case Form::Cost: return in_.signedInt(inst.extra) && values(inst);
    case Form::Jump: return in_.block(inst.target(0));
    case Form::Branch:
        return value(inst) && in_.punct(',') && in_.block(inst.target(0)) && in_.punct(',') &&
               in_.block(inst.target(1));
    case Form::Switch: return value(inst) && switchOn(inst);
    }
    return false;
}

bool RoutineParser::instruction() {
    Token where = in_.peek();
    std::string resultName;
    if (in_.peek().kind == TokenKind::Value) {
        resultName = in_.peek().text;
        in_.advance();
        if (!in_.punct('=')) return false;
    }
    Inst inst;
    if (in_.peek().kind != TokenKind::Word || !opFromText(in_.peek().text, inst.op))
        return in_.expected("an instruction");
    in_.advance();
    if (!body(inst)) return false;
    if (in_.takePunct('!')) {
        stmt_ = kNone;
        if (!in_.takeWord("none") && !in_.unsignedInt(stmt_)) return false;
    }
    inst.stmt = stmt_;
    auto id = static_cast<ValueId>(routine_.insts.size());
    if (!resultName.empty() && !values_.emplace(resultName, id).second)
        return in_.failAt(where, fmt::format("%{} has been defined before", resultName));
    routine_.insts.push_back(std::move(inst));
    routine_.blocks.back().insts.push_back(id);
    return in_.endOfLine();
}

bool RoutineParser::resolveValues() {
    for (const Use& use : uses_) {
        auto found = values_.find(use.where.text);
        if (found == values_.end())
            return in_.failAt(use.where, fmt::format("%{} is not defined in this routine", use.where.text));
        routine_.insts[use.inst].operands[use.operand] = found->second;
    }
    return true;
}

/// Types that follow from the opcode alone.
void RoutineParser::inferTypes() {
    for (Inst& inst : routine_.insts) {
        switch (opInfo(inst.op).result) {
        case ResultRule::Bool: inst.type = kBool; break;
        case ResultRule::Ptr:
            if (!opInfo(inst.op).showsType) inst.type = kPtr;
            break;
        case ResultRule::Typed:
            if (inst.op == Op::Sysvar) inst.type = kI32;
            if (inst.op == Op::ParamVal && inst.index < routine_.params.size())
                inst.type = routine_.params[inst.index].type;
            break;
        case ResultRule::Same:
        case ResultRule::None: break;
        }
    }
}

} // namespace ir::text
