#pragma once
// Which symbols fit where a value is expected.

#include "frontend/query/cursor.h"

#include <unordered_map>

namespace rapid::query {

enum class Fit : uint8_t {
    Exact, ///< of the type that is expected
    Alike, ///< of an equivalent type
    Reach, ///< a part of it has the type, or it is an operand of what has
    Misfit ///< never here
};

class FitRules {
  public:
    explicit FitRules(const Cursor& cursor) : cursor_(cursor) {}
    Fit of(const sema::Symbol& symbol) const;

  private:
    Fit ofData(const sema::DataSymbol& data) const;
    Fit ofType(const sema::DataType& type) const;
    Fit ofAny(const sema::DataType& type) const;
    bool hasPart(const sema::Type& type, int depth) const;

    const Cursor& cursor_;
    mutable std::unordered_map<const sema::Type*, bool> parts_;
};

} // namespace rapid::query
