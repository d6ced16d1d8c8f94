#pragma once
// References to data and to parts of it.

#include "frontend/sema/part.h"

namespace rapid::sema {

class Places : CheckerPart {
  public:
    Places(State& state, const Parts& parts);

    /// `handle`: the type of signal or other configured object that the context asks for, or null.
    Place place(const syntax::Expr& e, const Type* handle = nullptr);

  private:
    Place namePlace(const syntax::NameExpr& e, const Type* handle);
    Place indexPlace(const syntax::IndexExpr& e, const Type* handle);
    Place componentPlace(const syntax::ComponentExpr& e, const Type* handle);
    void checkIndex(const syntax::Expr& index, int32_t dimension, int64_t& value);

    DataResolver& data_;
    Expressions& expressions_;
    Folding& folding_;
    Scopes& scopes_;
    Suggestions& suggestions_;
    UnknownNames& unknown_;
};

/// Whether an expression is a name, an element or a component, and not a value.
bool isPlaceExpr(const syntax::Expr& e);

} // namespace rapid::sema
