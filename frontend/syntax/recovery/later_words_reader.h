#pragma once
// Words that became reserved late, in files of older systems.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Reads words that became reserved late as names where an older file uses them so.
class LaterWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// In a file of an older system a word that has been reserved since is a name where it cannot be anything else: one note
    /// a word. A procedure of that name makes a name of every such word in the file.
    void readLaterWordsAsNames();

  private:
    bool isNameInOldFile(TokenIndex i, bool endsAtOnce) const;
};

} // namespace rapid::syntax
