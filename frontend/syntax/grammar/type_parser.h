#pragma once
// Records and aliases (manual 1.2.1).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// type_definition: record, component, alias.
class TypeParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    Decl* parseRecord(bool local, TokenIndex first);
    Decl* parseAlias(bool local, TokenIndex first);

  private:
    std::span<RecordComponent*> parseComponents(bool braced);
    RecordComponent* parseComponent();

    std::vector<RecordComponent*> components_;
};

} // namespace rapid::syntax
