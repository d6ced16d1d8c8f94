#pragma once
// END words that are missing, misplaced or written in another way.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Which block an END word ends, and what was meant where it does not fit.
class EndWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// The END word of a block. A missing one is reported where the text can no longer belong to the block; when its head is
    /// broken, that has been reported.
    void closeBlock(K end, TokenIndex opening, bool whole = true);
    /// A word that ends a list of instructions, but neither this one nor one around it. Returns true when it is taken as
    /// the end of this list all the same.
    bool handleStray(const TokenSet& own);
    /// At ENDMODULE in a routine whose own END word is still to come. Afterwards the list goes on.
    bool takesEarlyEndmodule();
    /// "CASE n" and "CASE 1:" below it, in no TEST.
    bool isTestWrittenCase();
    /// The END word of a block that may have ended with '}'. Then it is not missed, and one that stands further out belongs
    /// to a block around this one.
    void closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced);

  private:
};

} // namespace rapid::syntax
