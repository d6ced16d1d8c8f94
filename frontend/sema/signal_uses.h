#pragma once
// Signals that no configuration declares, recognised by how the task uses their names.

#include "frontend/sema/part.h"

namespace rapid::sema {

class SignalFinder : CheckerPart {
  public:
    SignalFinder(State& state, const Parts& parts);

    const Type* signalTypeByName(const std::string& name);
    const Type* signalTypeByUse(NameId name);
    const Type* signalTypeByComparison(const std::string& written, NameId name);

  private:
    const Type* signalType(std::string_view name);
    bool isMisspeltNumber(NameId name);
    void gatherSignalUses();
    void gatherSignalUses(const syntax::Node& node);
    void gatherSignalUses(const RoutineSymbol& routine, std::span<syntax::Argument* const> args);
    void declareOwn(syntax::TokenIndex name, syntax::TokenIndex type);
    void operands(const syntax::BinaryExpr& e);
    void usedOtherwise(const syntax::Expr& place);
    void compared(const syntax::Expr& side, const syntax::Expr& number);
    const Type* looseType(const syntax::Expr& expr);
    bool looseNumber(const syntax::Expr& expr, double& value);

    DataResolver& data_;
    Scopes& scopes_;
    Suggestions& suggestions_;
    TypeResolver& types_;
};

} // namespace rapid::sema
