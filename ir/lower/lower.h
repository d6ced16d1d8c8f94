#pragma once
// Checked RAPID program -> IR. The only place where RAPID's notions meet the general IR.

#include "frontend/sema/checked.h"
#include "ir/core/ir.h"

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::lower {

struct Options {
    std::string programName = "program";
    std::vector<std::string> configNames; ///< configuration files known now, kept in the program
    std::vector<std::string> configTexts;
    std::string folder; ///< where relative paths of sources begin, so that they are found from elsewhere, too
    /// Returns whether a native symbol ("rt_MoveL") has an implementation; empty: all have. A call of one
    /// without is reported as a warning and stops the program with an event when it is reached.
    std::function<bool(std::string_view)> nativeImplemented;
    /// Calls a function of the standard library whose result depends on its arguments alone. `arguments`: a value for each
    /// parameter, null for an absent optional one or a switch that is not given. The text of a result lies in the arena.
    /// Returns nothing when the function raises an error, or is not known here; empty: no call is evaluated.
    std::function<std::optional<sema::ConstValue>(
        const sema::RoutineSymbol&, std::span<const sema::ConstValue* const> arguments, Arena& arena)>
        evaluate;
    /// For the stepping profile (decision 34): every statement can be chosen as the next one, data of routines
    /// lie in memory and are described, BACKWARD handlers are compiled.
    bool stepping = false;
    /// Every routine can be called by name, for the expressions of a debugger.
    bool callsByName = false;
    /// Everything predefined is in memory, whether the program uses it or not: clients read and write it by name.
    bool keepsPredefined = false;
    /// Procedures that the configuration connects with system events or a signal: reachable by name at run time. Lower case.
    std::set<std::string> eventRoutines;
    /// Is this routine called from outside the program (a test)? Then it is found by name. Empty: none is.
    std::function<bool(const sema::RoutineSymbol&)> calledFromOutside;
    /// Modules that are installed once for all tasks: their data, except TASK data, are shared. Lower case.
    std::set<std::string> sharedModules;
};

/// Lowers every task of a program without errors. Constructs that are not lowered yet are reported to `sink`,
/// never dropped. Returns false when something was reported as an error.
bool lowerProgram(const sema::CheckedProgram& program, const Options& options, diag::Sink& sink,
                  ir::Module& out);

/// A module that is loaded into a running program.
struct UnitOptions {
    Options program; ///< names, profile and natives as for a program
    /// Is there data of this name (in that module, or "" = in any) in program memory? Persistents and predefined variables
    /// are taken from there.
    std::function<bool(std::string_view module, std::string_view name)> exists;
};

/// Lowers one module of a task of the checked program. Data of other modules are external globals (those with a type description:
/// persistents of its own that another module has declared before), their routines are called by name, so that modules can come and go.
bool lowerUnit(const sema::CheckedProgram& program, uint32_t task, const sema::Module& module,
               const UnitOptions& options, diag::Sink& sink, ir::Module& out);

} // namespace rapid::lower
