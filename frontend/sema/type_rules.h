#pragma once
// Kinds of types, and which types are compatible.

#include "frontend/sema/checked.h"

namespace rapid::sema {

bool isValueType(const Type& type);
/// The type is this predefined type, or an alias of it.
inline bool isKnown(const Type& type, KnownType known) {
    return type.base()->known == known;
}
/// A signal of one bit.
inline bool isDigital(const Type& type) {
    return isKnown(type, KnownType::DigitalInput) || isKnown(type, KnownType::DigitalOutput);
}
inline bool isHandle(const Type& type) {
    return !isValueType(type) && type.kind != TypeKind::SemiValue;
}
inline bool isReal(const Type& type) {
    return type.kind != TypeKind::Switch && type.kind != TypeKind::AnyType;
}
bool sameShape(const DataType& found, const DataType& want);
bool equivalent(const DataType& found, const DataType& want);

} // namespace rapid::sema
