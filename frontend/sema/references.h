#pragma once
// Every place of a checked program with a name, and its meaning: for renaming and for editors.

#include "frontend/sema/checked.h"

namespace rapid::sema {

/// A name in the modules of a task.
struct Reference {
    const Task* task = nullptr;
    const Module* module = nullptr;
    syntax::TokenIndex token = syntax::kNoToken;
    const Symbol* symbol = nullptr; ///< what it names
    bool isDeclaration = false;
};

/// The names in the user modules of all tasks, in the order of the text: declarations, data, routines, types, labels,
/// names of arguments. Left out: names that have no meaning because of a mistake, components of records, names of
/// modules. A file that belongs to several tasks is listed for each.
std::vector<Reference> collectReferences(const CheckedProgram& program);

} // namespace rapid::sema
