#pragma once
// Texts with places to fill in: calls with their required arguments, constructs of the language.

#include "frontend/query/completion.h"

namespace rapid::query {

/// A construct that an editor offers as a whole.
struct Construct {
    std::string_view label; ///< begins with the word
    std::string_view detail;
    std::string_view plain; ///< for editors without snippets
    std::string_view snippet;
};

std::span<const Construct> statementConstructs();
std::span<const Construct> declarationConstructs();
std::span<const Construct> fileConstructs();
/// ERROR, UNDO, BACKWARD.
std::span<const Construct> handlerConstructs();

/// The names of the required arguments as places: "${1:ToPoint},${2:Speed}"; `alone`: no place number, for plain text.
std::string requiredArguments(const sema::RoutineSymbol& routine);
/// What ends a snippet must not end it: `$`, `}` and `\` are escaped.
std::string escaped(std::string_view text);

} // namespace rapid::query
