#include "frontend/query/references.h"

#include "frontend/sema/names.h"

#include <algorithm>
#include <set>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

std::string nameOf(const Meaning& meaning) {
    if (meaning.symbol) return foldName(meaning.symbol->name);
    if (meaning.module) return foldName(meaning.module->name);
    if (meaning.record)
        return foldName(meaning.record->components[static_cast<size_t>(meaning.component)].name);
    return {};
}

bool spells(const SyntaxTree& tree, const Token& token, const std::string& folded) {
    if (token.length != folded.size()) return false;
    const std::string_view text = tree.source->text().substr(token.offset, token.length);
    if ((text.front() | 0x20) != (folded.front() | 0x20) && static_cast<unsigned char>(text.front()) < 0x80)
        return false;
    return foldName(text) == folded;
}

/// Components of records of the library and names of the user are looked for in the user's files.
void addUses(const Snapshot& snapshot, const FileView& file, const std::string& name, const Entity& wanted,
             const Cancel* cancel, std::vector<Use>& out) {
    const uint32_t count = tokenCountOf(file);
    for (TokenIndex t = 0; t < count; ++t) {
        const Token& token = file.tree->tokens[t];
        if (!isWord(token.kind) || !spells(*file.tree, token, name)) continue;
        if (isCancelled(cancel)) return;
        const Meaning found = meaningOf(snapshot, file, t);
        if (!found.found() || entityOf(snapshot, found) != wanted) continue;
        Location place;
        place.file = file.tree->source;
        place.range = place.whole = found.range();
        place.isLibrary = file.isLibrary();
        out.push_back({std::move(place), found.access});
    }
}

bool before(const Use& a, const Use& b) {
    const int order = a.place.file->path().compare(b.place.file->path());
    return order != 0 ? order < 0 : a.place.range.begin < b.place.range.begin;
}

/// In one routine all names of its data, parameters and labels are.
bool isInner(const Meaning& meaning) {
    if (!meaning.symbol) return false;
    if (meaning.symbol->kind == SymbolKind::Label) return true;
    const DataSymbol* data = dataOf(meaning.symbol);
    return data && data->routine && data->storage != Storage::Parameter;
}

} // namespace

std::vector<Use> usesIn(const Snapshot& snapshot, const FileView& file, const Meaning& meaning,
                        const Cancel* cancel) {
    std::vector<Use> uses;
    const std::string name = nameOf(meaning);
    if (!name.empty()) addUses(snapshot, file, name, entityOf(snapshot, meaning), cancel, uses);
    return uses;
}

std::vector<Use> usesOf(const Snapshot& snapshot, const Meaning& meaning, bool withDeclaration,
                        const Cancel* cancel) {
    std::vector<Use> uses;
    const std::string name = nameOf(meaning);
    const Entity wanted = entityOf(snapshot, meaning);
    if (name.empty() || wanted.place.empty()) return uses;
    const Location declared = declarationOf(snapshot, meaning);
    for (const auto& file : snapshot.files()) {
        if (isCancelled(cancel)) break;
        const bool declares = declared.file && file->source().path() == declared.file->path();
        if (file->isLibrary() && !declares) continue; // what the library says of itself is of no interest
        if (isInner(meaning) && !declares) continue;
        addUses(snapshot, *file, name, wanted, cancel, uses);
    }
    if (!withDeclaration)
        std::erase_if(uses, [](const Use& use) { return use.access == Access::Declaration; });
    std::sort(uses.begin(), uses.end(), before);
    uses.erase(
        std::unique(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.place == b.place; }),
        uses.end());
    return uses;
}

size_t countUses(const Snapshot& snapshot, const Symbol& symbol, const Cancel* cancel) {
    Meaning meaning;
    meaning.symbol = &symbol;
    return usesOf(snapshot, meaning, false, cancel).size();
}

std::vector<Location> stringsSpelling(const Snapshot& snapshot, std::string_view name, const Cancel* cancel) {
    std::vector<Location> found;
    std::set<std::string> seen;
    const std::string folded = foldName(name);
    for (const auto& file : snapshot.files()) {
        if (file->isLibrary() || isCancelled(cancel) || !seen.insert(file->source().path()).second) continue;
        const uint32_t count = tokenCountOf(*file);
        for (TokenIndex t = 0; t < count; ++t) {
            const Token& token = file->tree->tokens[t];
            if (token.kind != TokenKind::StringLiteral || token.length < folded.size() + 2) continue;
            if (foldName(decodeStringLiteral(file->tree->text(t))) != folded) continue;
            Location place;
            place.file = file->tree->source;
            place.range = place.whole = file->tree->range(t);
            found.push_back(std::move(place));
        }
    }
    return found;
}

} // namespace rapid::query
