#pragma once
// Data (manual 1.2.2).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// module_data, routine_data, data, dimensions.
class DataParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// `VAR type name{dims} := value;`, from the word VAR, PERS or CONST; `first` is that of the scope word.
    DataDecl* parseData(ScopeWord scope, TokenIndex first, bool ofModule = false);
    /// `num x;`: read as if VAR stood before it.
    DataDecl* parseWordlessData();
    DataDecl* parseMoreNames();

    /// "VAR num x, y;": whether another name follows, at its comma.
    bool hasMoreNames() const { return moreOf_ != nullptr; }

  private:
    void parseDataTail(DataDecl* node, bool nameMissing, bool ofModule);
    void parseDimensions(DataDecl* node, bool beforeName);
    void noteMoreNames(const DataDecl* node);

    const DataDecl* moreOf_ = nullptr; ///< a declaration that continues with another name
};

} // namespace rapid::syntax
