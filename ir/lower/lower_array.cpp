// Whole arrays whose size is known at run time only: those of conformant parameters, and aggregates made of such.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;
using sema::LanguageError;

namespace {

bool sizeIsKnown(const sema::DataType& type) {
    for (int k = 0; k < type.rank; ++k)
        if (type.dims[k] == 0) return false;
    return true;
}

} // namespace

/// The rest of an array type when its first index is given.
RoutineLowering::Place RoutineLowering::rowOf(const Place& array, ValueId addr) const {
    Place row;
    row.addr = addr;
    row.type = {array.type.type, static_cast<uint8_t>(array.type.rank - 1), {}};
    for (size_t k = 0; k + 1 < array.dims.size(); ++k) {
        row.type.dims[k] = array.type.dims[k + 1];
        row.dims[k] = array.dims[k + 1];
    }
    return row;
}

ir::ValueId RoutineLowering::elementCount(const Place& array, int from) {
    ValueId count = b_.constI32(1);
    for (int k = from; k < array.type.rank; ++k)
        count = k == from ? dimValue(array, k) : b_.binary(Op::IMul, count, dimValue(array, k));
    return count;
}

ir::ValueId RoutineLowering::byteCount(const Place& array) {
    const ir::TypeId element = program_.irType(array.type.type);
    return b_.binary(Op::IMul, b_.convert(Op::SExt, ir::kI64, elementCount(array, 0)),
                     b_.constI64(program_.module().size(element)));
}

/// Raises an error unless `a` and `b` have the same size; where both are known the checker has compared them.
void RoutineLowering::checkSameSize(const Place& a, const Place& b) {
    for (int k = 0; k < a.type.rank; ++k)
        if (a.type.dims[k] == 0 || b.type.dims[k] == 0)
            b_.check(b_.binary(Op::IEq, dimValue(a, k), dimValue(b, k)),
                     program_.errorNumber(LanguageError::ArraySize));
}

/// Before anything is stored: does the value have the size of the place?
void RoutineLowering::checkShape(const Expr& outer, const Place& target) {
    const Expr& expr = unparen(outer);
    if (expr.kind != NodeKind::Aggregate) return checkSameSize(target, place(expr));
    const std::span<Expr*> elements = as<AggregateExpr>(expr).elements();
    if (target.type.dims[0] == 0)
        b_.check(b_.binary(Op::IEq, dimValue(target, 0), b_.constI32(static_cast<int32_t>(elements.size()))),
                 program_.errorNumber(LanguageError::ArraySize));
    if (target.type.rank == 1) return;
    for (const Expr* element : elements)
        checkShape(*element, rowOf(target, target.addr));
}

/// After checkShape().
void RoutineLowering::storeArray(const Expr& outer, const Place& target) {
    const Expr& expr = unparen(outer);
    if (expr.kind != NodeKind::Aggregate) {
        b_.copyDynamic(target.addr, place(expr).addr, byteCount(target));
        return;
    }
    const ir::TypeId element = program_.irType(target.type.type);
    const std::span<Expr*> elements = as<AggregateExpr>(expr).elements();
    const ValueId stride = elementCount(target, 1);
    for (size_t i = 0; i < elements.size(); ++i) {
        const ValueId at = b_.binary(Op::IMul, b_.constI32(static_cast<int32_t>(i)), stride);
        const Place row = rowOf(target, b_.elemAddr(element, target.addr, at));
        if (row.type.rank > 0)
            storeArray(*elements[i], row);
        else
            storeExpr(*elements[i], row.type, row.addr);
    }
}

/// An aggregate some of whose rows are conformant parameters, on the stack until the routine returns.
RoutineLowering::Place RoutineLowering::arrayTemporary(const Expr& expr) {
    Place array;
    array.type = info(expr).type();
    const Expr* row = &expr;
    for (int k = 0; k < array.type.rank; ++k) {
        if (row->kind == NodeKind::Aggregate) {
            const std::span<Expr*> elements = as<AggregateExpr>(*row).elements();
            array.dims[static_cast<size_t>(k)] = b_.constI32(static_cast<int32_t>(elements.size()));
            row = &unparen(*elements.front());
            continue;
        }
        const Place rest = place(*row);
        for (int j = 0; j < rest.type.rank; ++j)
            array.dims[static_cast<size_t>(k + j)] = dimValue(rest, j);
        break;
    }
    checkShape(expr, array);
    array.addr = b_.stackAlloc(byteCount(array));
    storeArray(expr, array);
    return array;
}

/// `target` := `value`, one of them of a size known at run time only.
void RoutineLowering::assignArray(const Expr& value, const Place& target, const Expr& written) {
    const bool isAggregate = value.kind == NodeKind::Aggregate;
    if (isAggregate && !mayAlias(value, written) && !mayFailHalfway(value) && !info(value).constant) {
        checkShape(value, target);
        return storeArray(value, target);
    }
    const Place source = place(value);
    checkSameSize(target, source);
    b_.copyDynamic(target.addr, source.addr, byteCount(target));
}

bool RoutineLowering::isOfKnownSize(const Expr& value, const sema::DataType& target) const {
    return sizeIsKnown(target) && sizeIsKnown(info(value).type());
}

} // namespace rapid::lower
