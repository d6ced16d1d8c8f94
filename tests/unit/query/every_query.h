#pragma once
// Asks everything at one place of a program and checks what holds for every answer: ranges lie within their texts, in order, and
// names are not empty. For the unit tests and for the fuzzer.

#include "frontend/query/call_hierarchy.h"
#include "frontend/query/completion.h"
#include "frontend/query/hints.h"
#include "frontend/query/hover.h"
#include "frontend/query/links.h"
#include "frontend/query/navigation.h"
#include "frontend/query/refactoring.h"
#include "frontend/query/renaming.h"
#include "frontend/query/semantic_tokens.h"
#include "frontend/query/signature_help.h"
#include "frontend/query/structure.h"
#include "frontend/query/symbols.h"

namespace rapid::query::testing {

/// The first promise that an answer breaks; null: none.
class EveryQuery {
  public:
    EveryQuery(const Snapshot& snapshot, const FileView& file) : snapshot_(snapshot), file_(file) {}

    /// At an offset, which may be beyond the text.
    const char* at(uint32_t offset) {
        complete(offset);
        navigate(offset);
        if (const auto hover = hoverAt(snapshot_, file_, offset)) {
            within(hover->range);
            require(!hover->declaration.empty() && !hover->markdown().empty(),
                    "a hover without a declaration");
        }
        if (const auto help = signatureHelpAt(snapshot_, file_, offset)) {
            require(!help->label.empty() && help->active < static_cast<int>(help->parameters.size()),
                    "an active parameter that does not exist");
            for (const SignatureParameter& parameter : help->parameters)
                require(parameter.begin <= parameter.end && parameter.end <= help->label.size(),
                        "a parameter outside of the label");
        }
        const auto selections = selectionRanges(file_, offset);
        require(!selections.empty(), "no selection");
        for (size_t i = 0; i < selections.size(); ++i) {
            within(selections[i]);
            require(i == 0 || (selections[i].begin <= selections[i - 1].begin &&
                               selections[i].end >= selections[i - 1].end),
                    "a selection that does not contain the one before");
        }
        for (const Refactoring& refactoring : refactoringsAt(snapshot_, file_, {offset, offset}))
            edits(refactoring.edits);
        return problem_;
    }

    /// Of the whole file.
    const char* whole() {
        uint32_t end = 0;
        for (const SemanticToken& token : semanticTokens(snapshot_, file_, all(), true)) {
            require(token.offset >= end && token.length > 0, "tokens out of order");
            end = token.offset + token.length;
            within({token.offset, end});
        }
        for (const OutlineSymbol& symbol : outlineOf(*file_.tree))
            outline(symbol);
        for (const FoldingRange& range : foldingRanges(file_))
            require(range.firstLine < range.lastLine && range.lastLine <= file_.source().lineCount(),
                    "a fold outside");
        for (const InlayHint& hint : inlayHints(snapshot_, file_, all()))
            require(hint.offset <= size() && !hint.label.empty(), "a hint outside");
        for (const FileLink& link : documentLinks(file_))
            within(link.range);
        for (const CodeLens& lens : codeLenses(snapshot_, file_)) {
            within(lens.range);
            incomingCalls(snapshot_, lens.key);
            outgoingCalls(snapshot_, lens.key);
        }
        workspaceSymbols(snapshot_, "m");
        return problem_;
    }

  private:
    uint32_t size() const { return static_cast<uint32_t>(file_.text().size()); }
    SourceRange all() const { return {0, size()}; }
    void require(bool holds, const char* promise) {
        if (!holds && !problem_) problem_ = promise;
    }
    void within(SourceRange range) {
        require(range.begin <= range.end && range.end <= size(), "a range outside of the text");
    }
    void within(const Location& place) {
        require(place.file && place.range.begin <= place.range.end &&
                    place.range.end <= place.file->text().size() && place.whole.begin <= place.range.begin &&
                    place.whole.end >= place.range.end,
                "a place outside of its file");
    }
    void edits(const std::vector<TextEdit>& list) {
        for (const TextEdit& edit : list)
            within(edit.range);
    }
    void outline(const OutlineSymbol& symbol) {
        within(symbol.range);
        require(!symbol.name.empty() && symbol.range.begin <= symbol.selection.begin &&
                    symbol.selection.end <= symbol.range.end,
                "a symbol whose name is outside of it");
        for (const OutlineSymbol& child : symbol.children)
            outline(child);
    }
    void complete(uint32_t offset) {
        const CompletionList list = completionAt(snapshot_, file_, offset);
        within(list.replace);
        for (const CompletionItem& item : list.items) {
            require(!item.label.empty() && !item.insertText.empty() && !item.sortText.empty(),
                    "an item without a text");
            edits(item.edits);
        }
        if (!list.items.empty()) resolveItem(snapshot_, list.items[offset % list.items.size()].key);
    }
    void navigate(uint32_t offset) {
        for (const Location& place : definitionAt(snapshot_, file_, offset))
            within(place);
        for (const Location& place : typeDefinitionAt(snapshot_, file_, offset))
            within(place);
        for (const Location& place : implementationAt(snapshot_, file_, offset))
            within(place);
        const auto highlights = highlightsAt(snapshot_, file_, offset);
        for (const Use& use : highlights)
            within(use.place);
        const Meaning meaning = meaningAt(snapshot_, file_, offset);
        if (meaning.found() && !isInComment(file_, offset))
            require(!highlights.empty(), "a name that is not among its own uses");
        const RenameTarget target = renameTargetAt(snapshot_, file_, offset);
        within(target.range);
        callItemAt(snapshot_, file_, offset);
    }

    const Snapshot& snapshot_;
    const FileView& file_;
    const char* problem_ = nullptr;
};

} // namespace rapid::query::testing
