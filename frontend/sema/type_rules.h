#pragma once
// Kinds of types, and which types are compatible.

#include "frontend/sema/checked.h"

namespace rapid::sema {

bool isValueType(const Type& type);
inline bool isHandle(const Type& type) {
    return !isValueType(type) && type.kind != TypeKind::SemiValue;
}
inline bool isReal(const Type& type) {
    return type.kind != TypeKind::Switch && type.kind != TypeKind::AnyType;
}
bool sameShape(const DataType& found, const DataType& want);
bool equivalent(const DataType& found, const DataType& want);

} // namespace rapid::sema
