#pragma once
// The meaning of the name at an offset: a symbol, a component of a record, or a module.

#include "frontend/query/scope.h"

namespace rapid::query {

/// How a place uses a name.
enum class Access : uint8_t { Declaration, Read, Write, ReadWrite, Call };

struct Meaning {
    const FileView* file = nullptr;
    syntax::TokenIndex token = syntax::kNoToken; ///< the name
    const sema::Symbol* symbol = nullptr;
    const sema::Type* record = nullptr; ///< components: the type that has it
    int component = -1;
    const sema::Module* module = nullptr; ///< names of modules
    Access access = Access::Read;
    const syntax::Node* node = nullptr; ///< the innermost node with the name

    bool found() const { return symbol || record || module; }
    SourceRange range() const { return file ? file->tree->range(token) : SourceRange{}; }
};

/// Of the name in which the offset is or which it touches; found() is false for everything else.
Meaning meaningAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);
/// The same for a token.
Meaning meaningOf(const Snapshot& snapshot, const FileView& file, syntax::TokenIndex token);

/// The place where the thing is declared; without file for what no text declares.
Location declarationOf(const Snapshot& snapshot, const Meaning& meaning);

/// Identity of a thing across the tasks that have it: modules that several tasks load are checked for each, and a global
/// persistent is one for all of them.
struct Entity {
    std::string place; ///< path of the declaration, or the kind of thing; empty: none
    uint32_t offset = 0;
    std::string name; ///< folded
    bool operator==(const Entity&) const = default;
};
Entity entityOf(const Snapshot& snapshot, const Meaning& meaning);

/// A routine that a predefined name or a component cannot be: the symbol as that kind, or null.
const sema::DataSymbol* dataOf(const sema::Symbol* symbol);
const sema::RoutineSymbol* routineOf(const sema::Symbol* symbol);
const sema::TypeSymbol* typeSymbolOf(const sema::Symbol* symbol);

} // namespace rapid::query
