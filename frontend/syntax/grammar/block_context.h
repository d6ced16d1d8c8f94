#pragma once
// Which blocks are open around the current token.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// The routine and the blocks around the current token, and what margins and END words below say about them.
/// parseRoutine() starts it again; blocks restore what they change.
class BlockContext : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// At a word that a block further out waits for: by its margin it belongs to this block all the same, and below the outer
    /// one there is such a word again.
    bool isInside() const;
    /// From a place on: the first word that continues or ends a block, a handler or a routine, and whose block does not
    /// begin there. The end of the file, once so many mistakes have been found that no more are shown.
    TokenIndex unmatchedWord(TokenIndex from) const;
    /// The END word of the list that is being read.
    K endOfOwn(const TokenSet& own) const;
    /// Whether the word here, which may mean any END, is that of the block around it. It is not if that is still to come,
    /// unless it is in line with the word that began the block.
    bool closesHere(K end) const;
    /// ENDPROC and the like in a block, while the END word of the routine is still to come.
    bool endsRoutineTooEarly() const;
    /// The END word of this routine, whatever word began it; EndOfFile if there is none before the next routine.
    K endOfRoutineBelow() const;
    /// How many ENDIF the routine lacks; below 0: it has too many.
    void countEndifs();
    /// Whether RETRY or TRYNEXT, which only an ERROR handler can have, come before the next handler or the end of the routine.
    bool isHandledBelow(TokenIndex from) const;
    /// ELSE in an IF, CASE in a TEST.
    bool continuesBlock() const;
    /// At a token that cannot continue the instruction: does another one begin here?
    bool startsAfresh() const;
    /// At '{' after a name: whether it begins a block. Then the line ends, and no list of indexes follows.
    bool isBlockBrace() const;

    TokenSet enclosing;                          ///< words that end a list further out
    TokenIndex opening = kNoToken;               ///< the word that opened the innermost block
    TokenKind routineEnd = TokenKind::KwEndproc; ///< the word that ends the routine
    TokenIndex routineStart = 0;                 ///< the first token of its body
    TokenIndex compactIf = kNoToken;             ///< the last IF without THEN
    TokenIndex compactIfEnd = kNoToken; ///< the end of its condition, when its instruction is on another line
    int missingEndifs = 0;              ///< of the routine, once they are counted
    bool endifsCounted = false;
    uint32_t braces = 0;            ///< open blocks that began with '{'
    std::string_view foreignCloser; ///< closes the block of another language that has been reported
    size_t listMark = 0;            ///< in TreeBuilder::stmts: the beginning of the list that is being read
    bool inHead = false;            ///< between IF, FOR or WHILE and the block
    bool inCondition = false;       ///< between IF and THEN
    bool inCaseValue = false;       ///< between CASE and its colon
    bool inLateName = false;        ///< between the '%' of a late-bound call
    bool abandoned = false;         ///< the routine is nested too deep: blocks end without their words
    bool plainError = false;        ///< the routine has an ERROR handler without a list

  private:
    TokenIndex outerOpenerOf(K word) const;

    /// The last answer of endOfRoutineBelow(); the same from every place in between.
    mutable struct {
        TokenIndex from = kNoToken, found = 0;
    } routineEndBelow_;
};

} // namespace rapid::syntax
