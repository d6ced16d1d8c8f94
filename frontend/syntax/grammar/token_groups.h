#pragma once
// Groups of tokens by their place in the grammar, and how far searches go.

#include "frontend/syntax/limits.h"
#include "frontend/syntax/token_set.h"

namespace rapid::syntax {

inline constexpr uint32_t kMaxDepth = 1000; ///< nesting of expressions and instructions
inline constexpr size_t kMaxErrorsPerFile = 200;
inline constexpr size_t kMostWords =
    20000000; ///< words of the file that are compared, in all searches together

/// Words at which a list of instructions has to stop and think.
inline constexpr TokenSet kListStops = {
    TokenKind::KwEndfor,   TokenKind::KwEndfunc, TokenKind::KwEndif,     TokenKind::KwEndmodule,
    TokenKind::KwEndproc,  TokenKind::KwEndtest, TokenKind::KwEndrecord, TokenKind::KwEndtrap,
    TokenKind::KwEndwhile, TokenKind::KwElse,    TokenKind::KwElseif,    TokenKind::KwCase,
    TokenKind::KwDefault,  TokenKind::KwError,   TokenKind::KwUndo,      TokenKind::KwBackward,
    TokenKind::KwProc,     TokenKind::KwFunc,    TokenKind::KwTrap,      TokenKind::KwRecord,
    TokenKind::KwAlias,    TokenKind::KwModule,  TokenKind::PlaceTdn,    TokenKind::PlaceRdn,
    TokenKind::PlaceEit,   TokenKind::PlaceCse,  TokenKind::EndOfFile,   TokenKind::KwLocal,
    TokenKind::Identifier};
/// Words that no English comment contains.
inline constexpr TokenSet kEndWords = {TokenKind::KwEndfor,  TokenKind::KwEndfunc,   TokenKind::KwEndif,
                                       TokenKind::KwEndproc, TokenKind::KwEndmodule, TokenKind::KwEndrecord,
                                       TokenKind::KwEndtest, TokenKind::KwEndtrap,   TokenKind::KwEndwhile,
                                       TokenKind::EndOfFile};
/// Words that end the instructions of a routine or of a part of it.
inline constexpr TokenSet kRoutineEnds = {TokenKind::KwEndproc,   TokenKind::KwEndfunc, TokenKind::KwEndtrap,
                                          TokenKind::KwError,     TokenKind::KwUndo,    TokenKind::KwBackward,
                                          TokenKind::KwProc,      TokenKind::KwFunc,    TokenKind::KwTrap,
                                          TokenKind::KwRecord,    TokenKind::KwAlias,   TokenKind::KwModule,
                                          TokenKind::KwEndmodule, TokenKind::PlaceTdn,  TokenKind::PlaceRdn};
inline constexpr TokenSet kOpenBrackets = {TokenKind::LeftParen, TokenKind::LeftBracket,
                                           TokenKind::LeftBrace};
inline constexpr TokenSet kCloseBrackets = {TokenKind::RightParen, TokenKind::RightBracket,
                                            TokenKind::RightBrace};
inline constexpr TokenIndex kLongLine = 500;   ///< tokens: no search within a line goes farther
inline constexpr TokenIndex kFarTokens = 5000; ///< how far margins and END words are compared
inline constexpr TokenSet kStorageWords = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwConst};
inline constexpr TokenSet kAccessModes = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwInout};
/// Words that end a branch.
inline constexpr TokenSet kIfEnds = {TokenKind::KwEndif, TokenKind::KwElse, TokenKind::KwElseif,
                                     TokenKind::PlaceEit};
/// Words that continue or end IF.
inline constexpr TokenSet kIfWords = {TokenKind::KwEndif, TokenKind::KwElse, TokenKind::KwElseif};
/// Ends of blocks within a routine.
inline constexpr TokenSet kBlockEnds = {TokenKind::KwEndif, TokenKind::KwEndfor, TokenKind::KwEndwhile,
                                        TokenKind::KwEndtest};
inline constexpr TokenSet kTestEnds = {TokenKind::KwEndtest, TokenKind::KwCase, TokenKind::KwDefault,
                                       TokenKind::PlaceCse};
/// Words that begin an instruction.
inline constexpr TokenSet kStmtWords = {
    TokenKind::KwIf,     TokenKind::KwFor,   TokenKind::KwWhile,    TokenKind::KwTest,  TokenKind::KwGoto,
    TokenKind::KwReturn, TokenKind::KwRaise, TokenKind::KwConnect,  TokenKind::KwRetry, TokenKind::KwTrynext,
    TokenKind::KwExit,   TokenKind::KwBreak, TokenKind::KwContinue, TokenKind::PlaceSmt};
inline constexpr TokenSet kBlockWords = {TokenKind::KwElse,     TokenKind::KwElseif, TokenKind::KwCase,
                                         TokenKind::KwDefault,  TokenKind::KwError,  TokenKind::KwUndo,
                                         TokenKind::KwBackward, TokenKind::PlaceEit, TokenKind::PlaceCse};
/// Words that begin a declaration.
inline constexpr TokenSet kDeclWords = {
    TokenKind::KwVar,    TokenKind::KwPers,   TokenKind::KwConst,  TokenKind::KwLocal, TokenKind::KwProc,
    TokenKind::KwFunc,   TokenKind::KwTrap,   TokenKind::KwRecord, TokenKind::KwAlias, TokenKind::KwModule,
    TokenKind::PlaceTdn, TokenKind::PlaceDdn, TokenKind::PlaceRdn};
inline constexpr TokenSet kLineWords = kStmtWords | kEndWords | kBlockWords | kDeclWords;
/// A routine has ended before these.
inline constexpr TokenSet kAfterRoutine = {TokenKind::KwProc,   TokenKind::KwFunc,      TokenKind::KwTrap,
                                           TokenKind::KwModule, TokenKind::KwEndmodule, TokenKind::EndOfFile};
/// Ends of any search within a routine.
inline constexpr TokenSet kRoutineBorders =
    kAfterRoutine | TokenSet{TokenKind::KwEndproc, TokenKind::KwEndfunc, TokenKind::KwEndtrap};
inline constexpr TokenSet kLiterals = {TokenKind::NumLiteral, TokenKind::StringLiteral, TokenKind::KwTrue,
                                       TokenKind::KwFalse};
/// Words that begin a declaration no routine has.
inline constexpr TokenSet kModuleLevel = {TokenKind::KwProc, TokenKind::KwFunc, TokenKind::KwTrap,
                                          TokenKind::KwRecord, TokenKind::KwAlias};
/// Ends of any search for a word that is missing.
inline constexpr TokenSet kSearchEnd = kLineWords | TokenSet{TokenKind::Semicolon};

inline constexpr uint32_t kSearchTokens = 200;
/// First tokens of expressions.
inline constexpr TokenSet kExprStart = {
    TokenKind::Identifier, TokenKind::NumLiteral, TokenKind::StringLiteral, TokenKind::KwTrue,
    TokenKind::KwFalse,    TokenKind::KwNot,      TokenKind::Plus,          TokenKind::Minus,
    TokenKind::LeftParen,  TokenKind::PlaceId,    TokenKind::LeftBracket,   TokenKind::PlaceExp,
    TokenKind::PlaceVar,   TokenKind::Error};

inline bool startsExpression(TokenKind kind) {
    return kExprStart.has(kind);
}
inline bool isName(TokenKind kind) {
    return kind == TokenKind::Identifier || kind == TokenKind::PlaceId;
}
/// Data types that are certainly no procedures: what begins with such a word is a declaration.
bool isBasicType(std::string_view word);

/// The words of a kind of routine, and its name in messages.
struct RoutineWords {
    TokenKind word, end;
    std::string_view name;
};
RoutineWords wordsOf(RoutineKind kind);

} // namespace rapid::syntax
