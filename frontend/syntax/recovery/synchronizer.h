#pragma once
// Finds a place to continue parsing from after a mistake.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Expects the words and signs that end something, and finds the next place to read on where they are missing.
class Synchronizer : public ParserPart {
  public:
    using ParserPart::ParserPart;

    void endInstruction(std::string_view expected = "';'");
    /// Skips to the end of the instruction: its semicolon, or a line that begins like another one.
    void skipInstruction();
    void expectWord(K word);
    /// FROM, TO, DO, THEN in the head of a block that may be broken already: then nothing more is missed in it. Returns
    /// false when the head ends without the word; an unfinished word at the end of the line is skipped.
    bool expectHeadWord(K word, bool whole);
    void expectClosing(K closing, TokenIndex opening, bool inList);
    /// At ':=' after a word that was read as an operand: it is the target of an instruction of its own, and the line before is
    /// not finished. The parser then is at this instruction.
    bool assignmentBelow();
    /// Skips the rest of a routine that is nested too deep.
    void abandonRoutine();

    /// Whether an expression was cut off after it had been read: nodes may end after it.
    bool hasGoneBack() const { return wentBackTo_ != 0; }

  private:
    TokenIndex wentBackTo_ = 0; ///< in an expression that was read: ends are to be cut off; 0: never
};

} // namespace rapid::syntax
