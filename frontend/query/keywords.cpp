#include "frontend/query/keywords.h"

#include "frontend/syntax/token_set.h"

namespace rapid::query {

using syntax::TokenKind;

namespace {

struct Help {
    TokenKind kind;
    std::string_view text;
};

constexpr Help kHelp[] = {
    {TokenKind::KwAlias, "Declares another name for a data type: `ALIAS num level;` (manual 1.2.1)"},
    {TokenKind::KwAnd,
     "Logical AND; the right value is not evaluated when the left one is FALSE (manual 1.3)"},
    {TokenKind::KwBackward,
     "Part of a procedure that is executed instead of its body in backward execution (manual 1.13)"},
    {TokenKind::KwBreak, "Leaves the innermost loop (manual 1.5)"},
    {TokenKind::KwCase, "Begins a branch of TEST for one or several values (manual 1.5)"},
    {TokenKind::KwConnect,
     "Connects an interrupt number to a trap routine: `CONNECT int WITH trap;` (manual 1.11)"},
    {TokenKind::KwConst, "Declares a constant, whose value never changes (manual 1.2.2)"},
    {TokenKind::KwContinue, "Begins the next round of the innermost loop (manual 1.5)"},
    {TokenKind::KwDefault, "Begins the branch of TEST for all other values (manual 1.5)"},
    {TokenKind::KwDiv, "Integer division: `7 DIV 2` is 3 (manual 1.3)"},
    {TokenKind::KwElse, "Begins the branch for a condition that is not met (manual 1.5)"},
    {TokenKind::KwElseif, "Begins a branch with a further condition (manual 1.5)"},
    {TokenKind::KwError,
     "Error handler of a routine; `ERROR (ERR_A)` takes the listed errors only (manual 1.12)"},
    {TokenKind::KwExit, "Stops execution; the program can only be started from its beginning (manual 1.5)"},
    {TokenKind::KwFalse, "The bool value FALSE"},
    {TokenKind::KwFor, "Repeats with a counter: `FOR i FROM 1 TO 10 DO ... ENDFOR`; the variable is declared "
                       "by the loop (manual 1.5)"},
    {TokenKind::KwFunc, "Declares a function, which returns a value (manual 1.1.5)"},
    {TokenKind::KwGoto, "Continues at a label of the same routine (manual 1.5)"},
    {TokenKind::KwIf, "Executes instructions when a condition is met (manual 1.5)"},
    {TokenKind::KwInout, "Parameter that needs a variable or persistent as argument, which the routine can "
                         "change (manual 1.1.5)"},
    {TokenKind::KwLocal, "The name is known in its module only (manual 1.1.3)"},
    {TokenKind::KwMod, "Remainder of an integer division: `7 MOD 2` is 1 (manual 1.3)"},
    {TokenKind::KwModule, "Begins a module, which has types, data and routines (manual 1.1.3)"},
    {TokenKind::KwNot, "Logical negation (manual 1.3)"},
    {TokenKind::KwOr, "Logical OR; the right value is not evaluated when the left one is TRUE (manual 1.3)"},
    {TokenKind::KwPers,
     "Declares a persistent: its value survives the end of the program and tasks share it (manual 1.2.2)"},
    {TokenKind::KwProc, "Declares a procedure, which is called as an instruction (manual 1.1.5)"},
    {TokenKind::KwRaise, "Raises an error, or passes the current one on from an error handler (manual 1.12)"},
    {TokenKind::KwRecord, "Declares a record type with named components (manual 1.2.1)"},
    {TokenKind::KwRetry, "In an error handler: executes the instruction that failed again (manual 1.12)"},
    {TokenKind::KwReturn, "Leaves the routine; in a function with the value (manual 1.5)"},
    {TokenKind::KwStep, "Step of a FOR loop (manual 1.5)"},
    {TokenKind::KwTest, "Chooses a branch by the value of an expression (manual 1.5)"},
    {TokenKind::KwTrap, "Declares a trap routine, which an interrupt calls (manual 1.11)"},
    {TokenKind::KwTrue, "The bool value TRUE"},
    {TokenKind::KwTrynext, "In an error handler: continues after the instruction that failed (manual 1.12)"},
    {TokenKind::KwUndo, "Handler that is executed when the routine is left before its end (manual 1.12)"},
    {TokenKind::KwVar, "Declares a variable, or a parameter that needs one as argument (manual 1.2.2)"},
    {TokenKind::KwWhile, "Repeats as long as a condition is met (manual 1.5)"},
    {TokenKind::KwXor, "Logical exclusive OR of two bool values (manual 1.3)"},
};

} // namespace

std::string_view keywordHelp(TokenKind kind) {
    for (const Help& help : kHelp)
        if (help.kind == kind) return help.text;
    return {};
}

std::string_view tokenTextOf(TokenKind kind) {
    return syntax::tokenText(kind);
}

} // namespace rapid::query
