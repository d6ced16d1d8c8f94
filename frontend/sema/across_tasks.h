#pragma once
// Compares the tasks of a program: persistents and modules that they share (manual 1.2.2, 1.20).

#include "frontend/sema/part.h"

#include <set>

namespace rapid::sema {

class TaskComparison : CheckerPart {
  public:
    explicit TaskComparison(State& state);
    /// Reports what tasks declare differently.
    void checkAcrossTasks();

  private:
    using DifferentRecords = std::set<std::pair<const Type*, const Type*>>;
    bool sameStructure(const Type& left, const Type& right);
    std::pair<std::string, std::string> difference(const Type& left, const Type& right,
                                                   const std::string& where);
    void checkShared(const DataSymbol& data, const DataSymbol& other, DifferentRecords& reported);
    void checkSharedModules();
};

} // namespace rapid::sema
