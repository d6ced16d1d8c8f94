#pragma once
// Outcomes of checking an expression or a reference.

#include "frontend/sema/checked.h"

namespace rapid::sema {

/// Why the numeric type of an expression is still open.
enum class Flex : uint8_t {
    None,    ///< it is not
    Literal, ///< literals only: num unless the context asks for dnum
    Group    ///< reads group signals: dnum unless the context asks for num
};

/// Outcome of checking an expression; the facts are in its ExprInfo.
struct Typed {
    ExprInfo* info = nullptr;
    Flex flex = Flex::None;
    const Type* base() const { return info->type().type->base(); }
    bool isError() const { return info->type().type->kind == TypeKind::Error; }
    bool isScalar(TypeKind kind) const { return info->type().rank == 0 && info->type().type->kind == kind; }
};

/// A reference to data or a part of it.
struct Place {
    DataSymbol* root = nullptr; ///< null: wrong, already reported
    const syntax::Expr* name = nullptr;
    bool whole = true; ///< neither an element nor a component
};

} // namespace rapid::sema
