#pragma once
// Words that became reserved late.

#include <string_view>

#include "frontend/syntax/ast.h"

namespace rapid::syntax {

/// The system that reserved the word first ("RobotWare 7.12"); empty when it always was.
std::string_view reservedSince(TokenKind word);

} // namespace rapid::syntax
