#pragma once
// The global names of a program, kept from one check to the next: an edit costs as much as the file that it changes.

#include "frontend/sema/checked.h"

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace rapid::query {

/// Symbols by folded name.
using NameTable = std::unordered_map<std::string, const sema::Symbol*>;

/// Belongs to one program. Brought up to date by each Snapshot that is given it; only the newest of these may be asked.
class GlobalNames {
  public:
    /// The tables have to be compared with the program before they are used again.
    void programChanged();
    /// The declarations of modules of the task that all of it sees; of several with one name that of the first module.
    const NameTable& of(const sema::Task& task);
    /// Whether no name is declared twice.
    bool areUnique(const sema::Task& task);

  private:
    struct OfModule {
        const sema::Module* module = nullptr;
        uint32_t stamp = 0;                     ///< of the check that made its symbols
        std::weak_ptr<sema::FileSymbols> owner; ///< separates checks of different programs
        std::vector<const std::string*> names;  ///< keys of the table
        bool repeats = false;                   ///< the module declares a name twice

        bool isUpToDate() const;
    };
    struct OfTask {
        NameTable table;
        std::vector<OfModule> modules;
        bool hasDuplicates = false; ///< a name that leaves may reveal another one
        bool isUpToDate = false;

        bool isUnique() const;
    };
    static bool update(OfTask& names, const sema::Task& task);
    static void build(OfTask& names, const sema::Task& task);
    static bool add(OfTask& names, OfModule& part);

    std::unordered_map<const sema::Task*, OfTask> tasks_;
};

} // namespace rapid::query
