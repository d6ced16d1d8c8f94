#include "frontend/query/item_key.h"

#include "frontend/sema/names.h"

#include <charconv>
#include <fmt/format.h>

namespace rapid::query {

std::string keyOf(const Snapshot& snapshot, const Meaning& meaning) {
    const Location place = declarationOf(snapshot, meaning);
    if (place.file) return fmt::format("{}:{}", place.range.begin, place.file->path());
    return meaning.symbol ? "=" + meaning.symbol->name : std::string();
}

std::string keyOf(const Snapshot& snapshot, const sema::Symbol& symbol) {
    Meaning meaning;
    meaning.symbol = &symbol;
    return keyOf(snapshot, meaning);
}

Meaning meaningOfKey(const Snapshot& snapshot, std::string_view key) {
    if (key.starts_with('=')) {
        const auto found = snapshot.configured().find(sema::foldName(key.substr(1)));
        Meaning meaning;
        if (found != snapshot.configured().end()) meaning.symbol = found->second;
        return meaning;
    }
    const size_t colon = key.find(':');
    uint32_t offset = 0;
    if (colon == std::string_view::npos ||
        std::from_chars(key.data(), key.data() + colon, offset).ptr != key.data() + colon)
        return {};
    const FileView* file = snapshot.file(key.substr(colon + 1));
    if (!file || offset > file->text().size()) return {};
    return meaningAt(snapshot, *file, offset);
}

} // namespace rapid::query
