#pragma once
// Gives a name of a program another spelling at all places, or says why that would change the program.

#include "frontend/edit/edit_set.h"
#include "frontend/sema/checker.h"

#include <memory>

namespace rapid::edit {

/// Edits that rename what `path` names in `tasks` to `newName`: declaration, uses, names of arguments. `path` is NAME,
/// MODULE.NAME, or MODULE.ROUTINE.NAME for a parameter, label or data of a routine, in any case. A file that belongs to
/// several tasks is edited once; a global persistent is renamed in all tasks that share it, and variables of one name that
/// loops of one routine have are renamed together.
///
/// `program` is what sema::check made of `tasks`, without errors and with all facts. The changed text is checked again:
/// each name must mean afterwards what it meant before. `program` is given up for that, as two large ones may not fit
/// into memory. Problems: unknown or ambiguous path; a new name that is not an identifier, predefined, or would clash with,
/// hide or be hidden by another declaration; names that come from outside (signals, predefined names, the routine that
/// starts a task). Strings that spell the old name (late binding) stay as they are and are listed in `notes`.
EditSet rename(std::unique_ptr<const sema::CheckedProgram> program, const std::vector<sema::TaskInput>& tasks,
               const sema::CheckOptions& options, std::string_view path, std::string_view newName);

/// Why nothing can have the name: no identifier, a keyword, too long, predefined; empty: it is fine. `component`: a component of
/// a record, which may have a predefined name.
std::string newNameProblem(std::string_view name, const sema::CheckedProgram& program,
                           bool component = false);

} // namespace rapid::edit
