#pragma once
// What could be written at an offset, directed by the type that is expected there.

#include "frontend/query/cursor.h"

namespace rapid::query {

enum class ItemKind : uint8_t {
    Keyword,
    Snippet,
    Procedure,
    Function,
    Trap,
    Variable,
    Persistent,
    Constant,
    Parameter,
    OptionalArgument,
    Component,
    Type,
    Module,
    Signal,
    Label,
    Value,  ///< TRUE, FALSE
    NewData ///< declares the name, see `edits`
};

struct CompletionItem {
    std::string label; ///< begins with the name
    ItemKind kind = ItemKind::Keyword;
    std::string detail;     ///< the type or declaration, one line
    std::string insertText; ///< replaces CompletionList::replace
    std::string
        snippet; ///< the same with `${1:...}` in the notation of LSP; empty: insertText is all. Lines after the first
                 ///< have the indentation relative to that of the line.
    std::string sortText;
    std::string filterText;
    std::string key;                      ///< for documentationOf(key); empty: there is none
    std::vector<TextEdit> edits;          ///< further edits of the same file
    const sema::Symbol* symbol = nullptr; ///< of this generation; null: it is not a declared name
    bool fits = false;                    ///< it has the type that is expected
};

struct CompletionList {
    SourceRange replace; ///< the letters written so far
    std::vector<CompletionItem> items;
    bool incomplete = false; ///< there are more: ask again with more letters
};

struct CompletionOptions {
    size_t limit = 4000;
    bool newData = true; ///< offers to declare points
};

CompletionList completionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                            const CompletionOptions& options = {}, const Cancel* cancel = nullptr);

/// Markdown for the key of an item (of the same or a later generation); empty: nothing is known any more.
struct ItemDocumentation {
    std::string declaration;
    std::string markdown;
};
ItemDocumentation resolveItem(const Snapshot& snapshot, std::string_view key);

} // namespace rapid::query
