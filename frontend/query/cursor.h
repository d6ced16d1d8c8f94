#pragma once
// The text being written at an offset, from the tokens before it: which instruction, argument, component, expected type. The text
// there is rarely complete, so no tree is needed.

#include "frontend/query/scope.h"

#include <optional>

namespace rapid::query {

/// One argument list around the offset, or one argument in it.
struct CallContext {
    syntax::TokenIndex name = syntax::kNoToken;
    const sema::RoutineSymbol* routine = nullptr; ///< null: nothing declares it (or late binding)
    bool isFunction = false;                      ///< within parentheses
    /// The parameter that the offset belongs to; -1: none (too many arguments, or an unknown name).
    int parameter = -1;
    std::vector<int> given; ///< parameters that have an argument before the one at the offset
    std::vector<int> later; ///< parameters that have an argument by name after it
    bool atName = false;    ///< after `\`: the name of an optional argument is expected
    bool atStart =
        false; ///< nothing of the value of the argument is written yet, apart from the word at the offset
    bool afterValue = false; ///< the argument is complete: `,` or `\` would follow
};

/// The kind of thing that is expected.
enum class Expect : uint8_t {
    Nothing,      ///< in a comment, a string, a number, or where a new name is chosen
    Declaration,  ///< at the level of a module
    File,         ///< outside of modules
    Statement,    ///< an instruction begins here
    Expression,   ///< a value; see `type`
    Target,       ///< the place that is written: variable, persistent
    TypeName,     ///< after VAR, PERS, CONST, FUNC, ALIAS, in a RECORD or a list of parameters
    Component,    ///< after `.`
    OptionalName, ///< after `\`; see `call`
    Label,        ///< after GOTO
    Trap,         ///< after CONNECT x WITH
    ModuleName,   ///< in a string that names a module
    LateName,     ///< in a string within `%...%`
    Keyword       ///< one of `keywords`
};

struct Cursor {
    Expect expect = Expect::Nothing;
    SourceRange word;        ///< the letters written so far; empty at the offset when there are none
    std::string_view prefix; ///< these up to the offset
    sema::DataType type;     ///< of the value that is expected; null type: not known, or any
    bool anyType = false;    ///< what the parameter takes has no certain type
    sema::ParamClass accepts = sema::ParamClass::Any;
    syntax::ParamMode mode = syntax::ParamMode::In; ///< In: any expression
    std::optional<CallContext> call;                ///< the innermost argument list
    const sema::Type* record = nullptr;             ///< Component: of the value before the dot
    /// The name that the declaration or FOR around the offset gives: it has no value there yet.
    std::string_view declares;
    std::vector<syntax::TokenKind> keywords; ///< that may follow, besides
    /// Required parameters of which one is given here: `signaldi Signal | PERS bool PersBool`. Empty: there is one only.
    std::vector<const sema::DataSymbol*> alternatives;
    bool instruction = false;       ///< Keyword: an instruction may begin here, too
    bool optionalParameter = false; ///< after `?` and in Present: an optional parameter of the routine
    bool errorNumber = false;       ///< in the list of an ERROR clause, or compared with ERRNO
};

/// Kind of the last token before the offset as it is written: the parser reads a comma or dot that ends its line as a semicolon when
/// an instruction follows in the next one, but the offset is where an argument or a component is about to be written.
syntax::TokenKind kindWritten(const syntax::SyntaxTree& tree, syntax::TokenIndex token);

/// `scope` is that of the offset.
Cursor cursorAt(const Scope& scope, uint32_t offset);

/// Type of the value that ends with the token, read backwards: `a`, `a{1}.b`, `f(x)`. Null type: it has none.
sema::DataType typeOfChain(const Scope& scope, syntax::TokenIndex last);

} // namespace rapid::query
