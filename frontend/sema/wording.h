#pragma once
// Wording of diagnostics: names of types and things.

#include "frontend/sema/checked.h"

#include <array>

namespace rapid::sema {

std::string typeName(const DataType& type);
inline std::string typeName(const ExprInfo& info) {
    return typeName(info.type());
}
/// The names of two types that are not the same: alike, they get their modules' names, "cell:part".
std::array<std::string, 2> typeNames(const DataType& found, const DataType& wanted);
/// "a constant", "a procedure" ...
std::string describe(const Symbol& symbol);
/// "1 member", "3 members"
std::string counted(size_t count, std::string_view noun, std::string_view plural = {});
/// "; did you mean 'x'?"
std::string didYouMean(std::string_view name);
std::string describeExpr(const syntax::Expr& e);

} // namespace rapid::sema
