#pragma once
// Signals that no configuration declares, recognised by how the task uses their names.

#include "frontend/sema/part.h"

namespace rapid::sema {

class SignalFinder : CheckerPart {
  public:
    SignalFinder(State& state, const Parts& parts);

    /// Reads how all files use undeclared names, unless that is known.
    void gather() {
        if (!task_.signalUses.known) gatherOfTask();
    }
    /// The type of signal that a name has by its beginning: "di1". Null, here and below: it is not a signal.
    const Type* signalTypeByName(const std::string& name);
    /// The type that other routines of the task use the name as.
    const Type* signalTypeByUse(NameId name);
    /// The type that the numbers suggest which the name is compared with.
    const Type* signalTypeByComparison(const std::string& written, NameId name);

  private:
    bool isMisspeltNumber(NameId name);
    void gatherOfTask();
    void mergeFiles();
    void gatherOfModule(Module& module);
    void gatherSignalUses(const syntax::Node& node);
    void gatherSignalUses(const RoutineSymbol& routine, std::span<syntax::Argument* const> args);
    Symbol* declared(NameId name);
    bool isUndeclared(NameId name);
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
    FileSignalUses* file_ = nullptr;                     ///< of the file that is read
    std::unordered_map<NameId, syntax::TokenIndex> own_; ///< names of the routine that is read; their types
    std::optional<NameId> partner_; ///< an undeclared name that gives the latest looseType
};

} // namespace rapid::sema
