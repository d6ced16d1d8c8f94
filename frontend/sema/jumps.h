#pragma once
// Labels and jumps of a routine (manual 1.21).

#include "frontend/sema/part.h"

namespace rapid::sema {

class Jumps : CheckerPart {
  public:
    Jumps(State& state, const Parts& parts);

    /// Declares a label.
    void labelStmt(const syntax::LabelStmt& s);
    /// At the end of a routine: gives each GOTO its label.
    void resolveJumps();

  private:
    uint32_t lineEnd(uint32_t from) const;
    bool valueFollows(const syntax::LabelStmt& s);
    std::string nearLabel(NameId name);
    bool isInside(uint32_t block, uint32_t outer) const;

    Scopes& scopes_;
};

} // namespace rapid::sema
