// Kinds of types, and which types are compatible.

#include "frontend/sema/type_rules.h"

namespace rapid::sema {

bool sameShape(const DataType& found, const DataType& want) {
    if (found.rank != want.rank) return false;
    for (int i = 0; i < want.rank; ++i) // 0: known at run time only, compared there
        if (found.dims[i] != want.dims[i] && found.dims[i] != 0 && want.dims[i] != 0) return false;
    return true;
}

bool equivalent(const DataType& found, const DataType& want) {
    if (found.type->kind == TypeKind::Error || want.type->kind == TypeKind::Error) return true;
    return found.type->base() == want.type->base() && sameShape(found, want);
}

bool isValueType(const Type& type) {
    switch (type.kind) {
    case TypeKind::Error:
    case TypeKind::Num:
    case TypeKind::Dnum:
    case TypeKind::Bool:
    case TypeKind::String: return true;
    case TypeKind::Record: return !type.containsNonValue;
    case TypeKind::NonValue:
    case TypeKind::SemiValue:
    case TypeKind::Switch:
    case TypeKind::AnyType: return false;
    }
    return false;
}

} // namespace rapid::sema
