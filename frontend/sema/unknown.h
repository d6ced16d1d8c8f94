#pragma once
// Reports names that nothing declares.

#include "frontend/sema/part.h"
#include "frontend/sema/suggestions.h"

namespace rapid::sema {

/// The presumed meaning of a name that nothing declares. Elsewhere: a module that is not here may declare it.
enum class Meant : uint8_t { Unknown, Keyword, Elsewhere };

class UnknownNames : CheckerPart {
  public:
    UnknownNames(State& state, const Parts& parts);

    /// False: a declaration of the name may be there that could not be read.
    bool mayReportUnknown(NameId name);
    /// Reports `message`, or rather that the name is LOCAL elsewhere or may be declared in a module that is missing.
    Meant reportUnknown(diag::Message<2> message, syntax::TokenIndex token, NameId name, Wanted wanted,
                        std::string_view otherHint = {});
    /// An unknown name as data: a signal where one is expected or where it is used as one elsewhere, otherwise an error.
    Symbol* reportUnknownData(syntax::TokenIndex token, NameId name, const Type* handle);

  private:
    bool reportTorn(syntax::TokenIndex token);
    /// A LOCAL name of another module, and that module; null: none has it.
    std::pair<const Module*, const Symbol*> localElsewhere(NameId name, Wanted wanted);
    void mayDeclareTorn(const syntax::SyntaxTree& tree, syntax::TokenIndex word);
    bool countedAbove(syntax::TokenIndex token, NameId name);
    void reportMayBeDeclared(syntax::TokenIndex token, const std::string& hint);
    bool comparisonsTell() const;
    void reportSignal(syntax::TokenIndex token, NameId name, const Type& type, bool perhaps);

    Scopes& scopes_;
    SignalFinder& signals_;
    Suggestions& suggestions_;
    syntax::TokenIndex tornUntil_ = syntax::kNoToken; ///< the last word of a name in two, which is reported
    const syntax::SyntaxTree* tornTree_ = nullptr;    ///< where that is
};

} // namespace rapid::sema
