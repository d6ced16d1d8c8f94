#pragma once
// Declarations of a module outside its routines.

#include "frontend/sema/checked.h"

namespace rapid::query {

/// Types, data and routines of a module, one after the other.
template <class F> void forEachDeclared(const sema::Module& module, F&& visit) {
    for (const sema::TypeSymbol* type : module.types)
        visit(*type);
    for (const sema::DataSymbol* data : module.data)
        visit(*data);
    for (const sema::RoutineSymbol* routine : module.routines)
        visit(*routine);
}

} // namespace rapid::query
