#pragma once
// Parameters of routines (manual 1.1.5).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// parameters, optional_parameter, parameter.
class ParameterParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    void parseParameters(RoutineDecl* routine);
    /// At another token than the '(' that is expected.
    void parseParametersWithoutParen(RoutineDecl* routine);

    bool typeMissed = false; ///< a parameter of the header without a data type has been reported

  private:
    void parseParameterGroup(uint32_t group);
    bool parseSwitch(ParamDecl* param);
    bool parseAccessMode(ParamDecl* param);
    ParamDecl* parseParameter(bool optional, uint32_t group);
    void dropMisplacedMode(ParamDecl* param);
    void parseDimensions(ParamDecl* param);

    std::vector<ParamDecl*> params_;
    bool typeInName_ = false; ///< of the next parameter: "PROC worknum n)"
};

} // namespace rapid::syntax
