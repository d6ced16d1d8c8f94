#pragma once
// Offsets in a file: tokens, nodes, the routine and the module around them.

#include "frontend/query/snapshot.h"

#include <functional>

namespace rapid::query {

/// Tokens of the text with its EndOfFile, without those that plain aggregates have made.
uint32_t tokenCountOf(const FileView& file);

/// The token in which the offset is, or a word that ends there; kNoToken between tokens.
syntax::TokenIndex tokenAt(const FileView& file, uint32_t offset);
/// The last token that begins before the offset; kNoToken when there is none.
syntax::TokenIndex tokenBefore(const FileView& file, uint32_t offset);
/// The first token that begins at the offset or after it; EndOfFile at the latest.
syntax::TokenIndex tokenFrom(const FileView& file, uint32_t offset);

/// An identifier or a keyword.
bool isWord(syntax::TokenKind kind);
/// The name (or keyword) that the offset is in or touches; kNoToken when there is none.
syntax::TokenIndex wordAt(const FileView& file, uint32_t offset);

/// In a comment, after its `!`.
bool isInComment(const FileView& file, uint32_t offset);
/// Between the quotes of a string.
bool isInString(const FileView& file, uint32_t offset);

/// Where an offset is. Nulls: not inside of such a thing.
struct Surroundings {
    const sema::Module* module = nullptr;
    const syntax::RoutineDecl* routineDecl = nullptr;
    const sema::RoutineSymbol* routine = nullptr;
};
Surroundings surroundings(const FileView& file, uint32_t offset);

/// The nodes that contain the offset (their ends included), from the module inwards. Elements of plain aggregates are left out.
std::vector<const syntax::Node*> nodesAt(const FileView& file, uint32_t offset);

/// Calls `visit` for each direct child, except the elements of plain aggregates, which have no names.
void forEachNode(const syntax::Node& node, const std::function<void(const syntax::Node&)>& visit);

/// The place of a declared name; without file when it is declared in no text (signals).
Location locationOf(const Snapshot& snapshot, const sema::Symbol& symbol);

} // namespace rapid::query
