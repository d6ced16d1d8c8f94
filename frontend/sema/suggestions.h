#pragma once
// Finds what was probably meant by a misspelt name.

#include "frontend/sema/part.h"

namespace rapid::sema {

/// The kind of name that a use needs.
enum class Wanted : uint8_t { Data, Signal, Type, Procedure, Function, Trap };

struct Suggestion {
    std::string name; ///< empty: none is near
    bool isKeyword = false;
    const Symbol* symbol = nullptr; ///< null: a reserved word
};

class Suggestions : CheckerPart {
  public:
    Suggestions(State& state, const Parts& parts);

    bool isWanted(const Symbol& symbol, Wanted wanted) const;
    /// The nearest name that is wanted here.
    Suggestion suggestion(NameId name, Wanted wanted);
    /// "v110", "z25": the end of a message with the predefined speeds or zones next to it; else empty.
    std::string inSeries(std::string_view written);
    /// "trans.z" for "z", when one part of the parts of a record is named so; empty when none or several are.
    std::string deeperComponent(const Type& record, std::string_view name);
    /// Put together when the first name is met that nothing declares.
    const NameLists& nameLists();
    /// Null: none is near.
    const Type::Component* nearComponent(const Type& record, std::string_view name);
    const DataSymbol* nearOptional(const RoutineSymbol& routine, NameId name);

  private:
    /// The predefined name for a word of other languages; null: it is not one.
    const Symbol* meantByForeign(std::string_view written, Wanted wanted);
    const std::vector<NameId>& nearPredefined(NameId name);

    Scopes& scopes_;
};

} // namespace rapid::sema
