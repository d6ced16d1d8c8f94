#pragma once
// The names that an offset sees: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2).

#include "frontend/query/position.h"

#include <functional>

namespace rapid::query {

class Scope {
  public:
    Scope(const Snapshot& snapshot, const FileView& file, uint32_t offset);

    /// The meaning of a name here, in any case; null: nothing declares it.
    const sema::Symbol* find(std::string_view name) const;
    const sema::TypeSymbol* findType(std::string_view name) const;
    /// A label of the routine.
    const sema::LabelSymbol* findLabel(std::string_view name) const;
    /// Every symbol that is seen here, inner ones first; those that another one hides are left out.
    /// With `letters` only names that they match (fuzzy.h). Labels are not among them.
    std::vector<const sema::Symbol*> visible(const Cancel* cancel = nullptr,
                                             std::string_view letters = {}) const;
    /// The same without a list, which costs much in large programs. `use` must not declare names.
    void forEachVisible(const Cancel* cancel, std::string_view letters,
                        const std::function<void(const sema::Symbol&)>& use) const;
    std::vector<const sema::LabelSymbol*> labels() const;

    const Surroundings& around() const { return around_; }
    const FileView& file() const { return file_; }
    const Snapshot& snapshot() const { return snapshot_; }

  private:
    bool reaches(const sema::DataSymbol& data) const;
    template <class F> bool inRoutine(F&& visit) const;

    const Snapshot& snapshot_;
    const FileView& file_;
    uint32_t offset_;
    Surroundings around_;
};

/// The type that a name of a type has here; null when it has none.
const sema::Type* typeNamed(const Scope& scope, std::string_view name);

/// The type of an expression: the checker's or, where it has not looked because of a mistake, that of the names.
sema::DataType typeOfExpr(const Scope& scope, const syntax::Expr& expr);

} // namespace rapid::query
