// Words that became reserved late. Files of older systems (.mod, .sys, .prg) may use them as names.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"
#include "frontend/syntax/later_words.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

struct LaterWord {
    TokenKind kind;
    std::string_view since;
    bool endsAtOnce; ///< as an instruction it is followed by ';' and nothing else
};
constexpr std::string_view kBreakSystem = "RobotWare 7.12";
constexpr LaterWord kLaterWords[] = {{TokenKind::KwBreak, kBreakSystem, true},
                                     {TokenKind::KwContinue, kBreakSystem, true},
                                     {TokenKind::KwUndo, "RobotWare 5", false}};

/// Tokens that can follow a name, but neither BREAK, CONTINUE nor UNDO.
constexpr TokenSet kAfterName = {
    TokenKind::Assign,   TokenKind::LeftParen,  TokenKind::RightParen,   TokenKind::LeftBrace,
    TokenKind::Comma,    TokenKind::RightBrace, TokenKind::RightBracket, TokenKind::Dot,
    TokenKind::Colon,    TokenKind::Plus,       TokenKind::Minus,        TokenKind::Star,
    TokenKind::Slash,    TokenKind::Less,       TokenKind::LessEqual,    TokenKind::Equal,
    TokenKind::NotEqual, TokenKind::Greater,    TokenKind::GreaterEqual, TokenKind::KwThen,
    TokenKind::KwDo,     TokenKind::KwTo,       TokenKind::KwStep,       TokenKind::KwAnd,
    TokenKind::KwOr,     TokenKind::KwXor,      TokenKind::KwDiv,        TokenKind::KwMod,
    TokenKind::KwElseif, TokenKind::Bar};
/// Tokens that can precede a value or the name of a declaration, but not an instruction.
constexpr TokenSet kBeforeName = {
    TokenKind::Assign,    TokenKind::Comma,   TokenKind::LeftParen,    TokenKind::LeftBracket,
    TokenKind::LeftBrace, TokenKind::Plus,    TokenKind::Minus,        TokenKind::Star,
    TokenKind::Slash,     TokenKind::Less,    TokenKind::LessEqual,    TokenKind::Equal,
    TokenKind::NotEqual,  TokenKind::Greater, TokenKind::GreaterEqual, TokenKind::KwIf,
    TokenKind::KwElseif,  TokenKind::KwWhile, TokenKind::KwNot,        TokenKind::KwAnd,
    TokenKind::KwOr,      TokenKind::KwXor,   TokenKind::KwDiv,        TokenKind::KwMod,
    TokenKind::KwReturn,  TokenKind::KwTest,  TokenKind::KwGoto,       TokenKind::KwProc,
    TokenKind::KwTrap,    TokenKind::KwFrom,  TokenKind::KwTo,         TokenKind::KwRaise,
    TokenKind::KwWith};
/// The argument of a call: "Undo 3;".
constexpr TokenSet kAfterCall = {TokenKind::NumLiteral, TokenKind::StringLiteral, TokenKind::KwTrue,
                                 TokenKind::KwFalse, TokenKind::Backslash};
constexpr TokenSet kDeclaresData = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwConst};
/// A word after one of these begins an instruction or a declaration.
constexpr TokenSet kBeforeInstruction = {TokenKind::Semicolon,  TokenKind::Colon,      TokenKind::KwThen,
                                         TokenKind::KwElse,     TokenKind::KwDo,       TokenKind::KwError,
                                         TokenKind::KwUndo,     TokenKind::KwBackward, TokenKind::KwEndif,
                                         TokenKind::KwEndwhile, TokenKind::KwEndfor,   TokenKind::KwEndtest,
                                         TokenKind::RightParen};

} // namespace

/// Whether the late word at `i` names something. `endsAtOnce`: as an instruction nothing but ';' follows it.
bool LaterWords::isNameInOldFile(TokenIndex i, bool endsAtOnce) const {
    const K before = i > 0 ? kindAt(i - 1) : K::EndOfFile, after = kindAt(i + 1);
    if (before == K::Backslash || after == K::EndOfFile) return false; // RaiseToUser \Continue
    if (kBeforeName.has(before)) return true;
    const K further = i > 1 ? kindAt(i - 2) : K::EndOfFile;
    if (before == K::Identifier && (kDeclaresData.has(further) || further == K::KwFunc)) return true;
    const bool first = further == K::Identifier && i > 2 && kindAt(i - 3) == K::KwRecord; // component
    if (before == K::Identifier && first) return true;
    if (after != K::Semicolon) {
        const bool called = !endsAtOnce && kAfterCall.has(after) && !startsLine(i + 1);
        return called || (kAfterName.has(after) && (endsAtOnce || !startsLine(i)));
    }
    return before == K::Identifier && kBeforeInstruction.has(further); // "TPWrite continue;"
}

void LaterWords::readLaterWordsAsNames() {
    if (!SourceFile::isLegacyFileType(tree().source->path()) || parser().options.declarations) return;
    for (const LaterWord& word : kLaterWords) {
        TokenIndex first = kNoToken;
        bool procedure = false;
        for (TokenIndex i = 0; i < lastToken(); ++i) {
            if (kindAt(i) != word.kind || !isNameInOldFile(i, word.endsAtOnce)) continue;
            procedure |= kindAt(i - 1) == K::KwProc;
            if (first == kNoToken) first = i;
        }
        if (first == kNoToken) continue;
        report(say::LaterReservedWord, first, {std::string(tokenText(word.kind)), std::string(word.since)});
        for (TokenIndex i = 0; i < lastToken(); ++i)
            if (kindAt(i) == word.kind &&
                ((procedure && word.endsAtOnce) || isNameInOldFile(i, word.endsAtOnce)))
                readAs(i, K::Identifier);
    }
}

std::string_view reservedSince(TokenKind word) {
    for (const LaterWord& later : kLaterWords)
        if (later.kind == word) return later.since;
    return {};
}

} // namespace rapid::syntax
