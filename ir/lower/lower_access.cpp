// Data references: names, array elements, record components.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;
using sema::DataSymbol;
using sema::LanguageError;
using sema::Storage;

void RoutineLowering::checkPresent(const Slot& slot) {
    if (!slot.optional) return;
    b_.check(b_.binary(Op::INe, parameter(slot.param), b_.nullPtr()),
             program_.errorNumber(LanguageError::AbsentArgument));
}

ir::ValueId RoutineLowering::objectAddress(const Slot& slot) {
    if (slot.kind == Slot::Kind::Local) return b_.localAddr(slot.local);
    return slot.local == ir::kNone ? parameter(slot.param) : b_.load(ir::kPtr, b_.localAddr(slot.local));
}

/// Of an optional parameter, to be handed on: null when it is absent.
ir::ValueId RoutineLowering::addressIfPresent(const Slot& slot) {
    const ValueId given = parameter(slot.param);
    if (slot.local == ir::kNone) return given;
    return b_.select(b_.binary(Op::INe, given, b_.nullPtr()), objectAddress(slot), b_.nullPtr());
}

void RoutineLowering::readSystemVariable(const DataSymbol& symbol, ir::ValueId address) {
    if (symbol.meaning == sema::Meaning::ErrorNumber || symbol.meaning == sema::Meaning::InterruptNumber) {
        const bool error = symbol.meaning == sema::Meaning::ErrorNumber;
        const ValueId number = b_.sysvar(error ? ir::SysvarKind::Error : ir::SysvarKind::Interrupt);
        b_.store(ir::kF32, b_.convert(Op::SIntToFloat, ir::kF32, number), address);
        return;
    }
    b_.callNative(program_.support(Support::rt_systemData),
                  {address, b_.globalAddr(program_.stringGlobal(symbol.name))});
}

RoutineLowering::Place RoutineLowering::placeOf(const DataSymbol& symbol) {
    Place p;
    p.type = symbol.type;
    if (symbol.storage == Storage::SystemVariable) {
        p.addr = tempAddr(program_.irType(symbol.type));
        readSystemVariable(symbol, p.addr);
        return p;
    }
    const Slot* slot = findSlot(symbol);
    if (!slot) {
        if (symbol.storage == Storage::RoutineData && symbol.dataKind == DataKind::Const) {
            p.addr = constantAddress(symbol.value(), symbol.type);
            return p;
        }
        p.addr = b_.globalAddr(program_.globalFor(symbol, task_));
        return p;
    }
    switch (slot->kind) {
    case Slot::Kind::Local:
        checkPresent(*slot);
        p.addr = b_.localAddr(slot->local);
        break;
    case Slot::Kind::Pointer:
        checkPresent(*slot);
        p.addr = objectAddress(*slot);
        for (int k = 0; k < symbol.type.rank && symbol.type.dims[k] == 0; ++k)
            p.dims[k] = parameter(slot->param + 1 + static_cast<uint32_t>(k));
        break;
    case Slot::Kind::IntLoop:
        p.addr = tempAddr(ir::kF32);
        b_.store(ir::kF32,
                 b_.convert(Op::SIntToFloat, ir::kF32, b_.load(ir::kI32, b_.localAddr(slot->local))), p.addr);
        break;
    }
    return p;
}

ir::ValueId RoutineLowering::dimValue(const Place& p, int k) {
    if (p.type.dims[k] > 0) return b_.constI32(p.type.dims[k]);
    return p.dims[k];
}

ir::ValueId RoutineLowering::lowerIndex(const Expr& index, ValueId dim, int32_t knownDim, bool& safe) {
    const int32_t outOfBounds = program_.errorNumber(LanguageError::Index);
    if (isIncomplete(index)) {
        reachPlaceholder(unparen(index));
        return b_.constI32(0);
    }
    ValueId one = b_.constI32(1);
    if (const auto range = intRange(index)) {
        safe = range->lo >= 1 && knownDim > 0 && range->hi <= knownDim;
        const ValueId zeroBased = b_.binary(Op::ISub, lowerInt(index), one);
        if (!safe) b_.check(b_.binary(Op::IULt, zeroBased, dim), outOfBounds);
        return zeroBased;
    }
    const sema::Type* type = baseType(index);
    const bool isDnum = type->kind == sema::TypeKind::Dnum;
    const ValueId value =
        type->kind == sema::TypeKind::SemiValue ? readSignal(index, false) : lowerValue(index);
    const ValueId number = b_.convert(Op::FloatToIndex, ir::kI32, value);
    const ValueId back = b_.convert(Op::SIntToFloat, isDnum ? ir::kF64 : ir::kF32, number);
    const ValueId zeroBased = b_.binary(Op::ISub, number, one);
    b_.check(b_.binary(Op::IULt, zeroBased, dim), outOfBounds);
    b_.check(b_.binary(Op::FEq, back, value), program_.errorNumber(LanguageError::NotWhole));
    return zeroBased;
}

RoutineLowering::Place RoutineLowering::elementPlace(const IndexExpr& expr) {
    const Place base = place(*expr.base);
    ValueId flat = ir::kNone;
    for (size_t k = 0; k < expr.indices.size(); ++k) {
        const int dimNumber = static_cast<int>(k);
        const ValueId dim = dimValue(base, dimNumber);
        bool safe = false;
        const ValueId index = lowerIndex(*expr.indices[k], dim, base.type.dims[k], safe);
        // The indices have been checked: the element is one of those in memory.
        flat = k == 0 ? index : b_.binaryInRange(Op::IAdd, b_.binaryInRange(Op::IMul, flat, dim), index);
    }
    Place p;
    p.type = scalarType(base.type.type);
    p.addr = b_.elemAddr(program_.irType(p.type), base.addr, flat);
    return p;
}

/// As place(), but a signal that the context reads as a number gets its value into a temporary.
RoutineLowering::Place RoutineLowering::place(const Expr& outer) {
    const Expr& expr = unparen(outer);
    const sema::DataType& type = info(expr).type();
    if (type.type && type.type->isNumeric() && !type.isArray() && namesSignal(expr)) {
        Place p;
        p.type = type;
        p.addr = tempAddr(program_.irType(type));
        b_.store(program_.irType(type), readSignal(expr, type.type->base()->kind == sema::TypeKind::Dnum),
                 p.addr);
        return p;
    }
    return reference(expr);
}

RoutineLowering::Place RoutineLowering::reference(const Expr& outer) {
    const Expr& expr = unparen(outer);
    if (isIncomplete(expr)) {
        reachPlaceholder(expr);
        Place none;
        none.addr = b_.nullPtr();
        none.type = info(expr).type();
        return none;
    }
    switch (expr.kind) {
    case NodeKind::Name: {
        const auto* symbol = info(expr).symbol;
        if (symbol && symbol->kind == sema::SymbolKind::Data)
            return placeOf(*static_cast<const DataSymbol*>(symbol));
        break;
    }
    case NodeKind::Index: return elementPlace(as<IndexExpr>(expr));
    case NodeKind::Component: {
        const auto& component = as<ComponentExpr>(expr);
        const Place base = place(*component.base);
        const int number = base.type.type->findComponent(module_->tree->text(component.name));
        Place p;
        p.type = scalarType(base.type.type->base()->components[static_cast<size_t>(number)].type);
        p.addr = b_.fieldAddr(program_.irType(base.type.type), base.addr, static_cast<uint32_t>(number));
        return p;
    }
    default: break;
    }
    // A value without a place of its own gets a temporary one.
    Place p;
    p.type = info(expr).type();
    if (p.type.isArray() && !isOfKnownSize(expr, p.type)) return arrayTemporary(expr);
    const ir::TypeId type = program_.irType(p.type);
    if (info(expr).constant && !program_.module().isScalar(type) && !program_.stepping()) {
        p.addr = constantAddress(*info(expr).constant, p.type);
        return p;
    }
    p.addr = tempAddr(type);
    lowerInto(expr, p.type, p.addr);
    return p;
}

const DataSymbol* RoutineLowering::rootSymbol(const Expr& outer) const {
    const Expr* expr = &unparen(outer);
    while (expr->kind == NodeKind::Index || expr->kind == NodeKind::Component)
        expr = &unparen(expr->kind == NodeKind::Index ? *as<IndexExpr>(*expr).base
                                                      : *as<ComponentExpr>(*expr).base);
    if (expr->kind != NodeKind::Name) return nullptr;
    const sema::Symbol* symbol = info(*expr).symbol;
    if (!symbol || symbol->kind != sema::SymbolKind::Data) return nullptr;
    return static_cast<const DataSymbol*>(symbol);
}

/// May evaluating `expr` read `target`? Calls of user routines may read whatever is not private to this
/// routine.
bool RoutineLowering::mentions(const Expr& outer, const DataSymbol& target) const {
    const Expr& expr = unparen(outer);
    const bool isPrivate = target.storage == Storage::RoutineData;
    switch (expr.kind) {
    case NodeKind::Name: {
        const auto* symbol = static_cast<const DataSymbol*>(info(expr).symbol);
        if (symbol == &target) return true;
        const bool byReference =
            symbol && symbol->kind == sema::SymbolKind::Data && symbol->storage == Storage::Parameter;
        return byReference && !isPrivate;
    }
    case NodeKind::Index: {
        const auto& index = as<IndexExpr>(expr);
        for (const Expr* e : index.indices)
            if (mentions(*e, target)) return true;
        return mentions(*index.base, target);
    }
    case NodeKind::Component: return mentions(*as<ComponentExpr>(expr).base, target);
    case NodeKind::Unary: return mentions(*as<UnaryExpr>(expr).operand, target);
    case NodeKind::Binary:
        return mentions(*as<BinaryExpr>(expr).left, target) || mentions(*as<BinaryExpr>(expr).right, target);
    case NodeKind::Aggregate:
        for (const Expr* e : as<AggregateExpr>(expr).elements())
            if (mentions(*e, target)) return true;
        return false;
    case NodeKind::Call: {
        const auto& calls = facts().calls;
        auto found = calls.find(&expr);
        if (found == calls.end()) return true;
        if (!isPrivate && !(found->second.routine && found->second.routine->native)) return true;
        for (const auto& arg : found->second.args)
            if (arg.value && mentions(*arg.value, target)) return true;
        return false;
    }
    default: return false;
    }
}

bool RoutineLowering::mayAlias(const Expr& value, const Expr& target) const {
    const Expr& v = unparen(value);
    if (v.kind == NodeKind::StringLiteral || info(v).constant) return false;
    if (v.kind == NodeKind::Name) return false; // a whole copy onto itself is harmless
    const DataSymbol* root = rootSymbol(target);
    if (!root) return true;
    if (root->storage == Storage::Parameter && root->mode != ParamMode::In) return true;
    return mentions(v, *root);
}

} // namespace rapid::lower
