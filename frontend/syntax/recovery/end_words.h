#pragma once
// END words that are missing, misplaced or written in a different way.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Which block an END word ends, and what was meant where it does not fit.
class EndWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// The END word of a block. A missing one is reported where the text can no longer belong to the block; when its head is
    /// broken, that has been reported.
    void closeBlock(K end, TokenIndex opening, bool whole = true);
    /// At ENDMODULE in a routine whose own END word is still to come. Afterwards the list continues.
    bool takesEarlyEndmodule();
    /// The END word of a block that may have ended with '}'. Then it is not missed, and one further out belongs
    /// to a block around this one.
    void closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced);
};

} // namespace rapid::syntax
