#pragma once
// Routines (manual 1.1.5).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// routine: procedure, function, trap; handlers.
class RoutineParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    Decl* parseRoutine(bool local, TokenIndex first);
    /// LOCAL or TASK in front of routine data; PERS there is a mistake of its own.
    void reportScopeInside(ScopeWord scope, bool late = false);

  private:
    bool isWrittenTwice(const RoutineDecl& routine, TokenIndex opening);
    void correctRoutineWord(RoutineDecl* routine, TokenIndex word);
    void parseRoutineHeader(RoutineDecl* routine);
    bool parseReturnType(RoutineDecl* routine);
    bool isTornRoutineName();
    void parseRoutineBody(RoutineDecl* routine, bool& braced);
    bool parseNested(const RoutineDecl* routine);
    void parseRoutineData();
    void parseHandlers(RoutineDecl* routine);
    void parseHandler(RoutineDecl* routine, K previous);
    void closeRoutine(RoutineDecl* routine, TokenIndex opening, bool braced);

    std::vector<DataDecl*> data_;
    std::vector<ErrorClause*> handlers_;
};

} // namespace rapid::syntax
