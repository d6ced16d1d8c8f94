#pragma once
// Writing a value into a declaration: what a robot does when it saves a persistent (manual 1.2.2).

#include "frontend/edit/edit_set.h"
#include "frontend/syntax/ast.h"

namespace rapid::edit {

/// The edit that makes `value`, an expression in RAPID, the initial value of data that a module of the file declares
/// outside of its routines. `path` is DATA or MODULE.DATA, in any case. Where there is no initial value yet, `:=` and the value
/// are inserted. An equal text gives no edit.
///
/// Problems: no such data; several of that name; a value that is not an expression, or several lines. Whether the value
/// fits the type is for the checker to say.
EditSet setInitialValue(const syntax::SyntaxTree& tree, std::string_view path, std::string_view value);

/// True when a module of the file declares data of that path outside of its routines.
bool declaresData(const syntax::SyntaxTree& tree, std::string_view path);

} // namespace rapid::edit
