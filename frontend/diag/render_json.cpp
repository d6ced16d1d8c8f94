// Diagnostics for programs: the JSON array of `check --format=json`.

#include "config/json_text.h"
#include "frontend/diag/catalogue.h"

namespace rapid::diag {

namespace {

using Json = nlohmann::ordered_json;

struct Place {
    std::string file;
    LineColumn begin;
    LineColumn end;
};

Place placeOf(const std::shared_ptr<const SourceFile>& file, SourceRange range) {
    if (!file) return {};
    return {file->path(), file->lineColumn(range.begin), file->lineColumn(std::max(range.begin, range.end))};
}

Json placeJson(const Place& place) {
    return {{"file", place.file},
            {"line", place.begin.line},
            {"column", place.begin.column},
            {"endLine", place.end.line},
            {"endColumn", place.end.column}};
}

/// A path need not be UTF-8, a JSON text must be.
std::string dump(const Json& json) {
    return config::textOf(json, 2) + "\n";
}

Json fixesJson(const Diagnostic& d) {
    Json fixes = Json::array();
    for (const Diagnostic::Fix& fix : d.fixes) {
        Json edits = Json::array();
        for (const TextEdit& edit : fix.edits) {
            Json item = placeJson(placeOf(d.file, edit.range));
            item["text"] = edit.replacement;
            edits.push_back(std::move(item));
        }
        fixes.push_back({{"message", fix.message}, {"certain", fix.certain}, {"edits", std::move(edits)}});
    }
    return fixes;
}

} // namespace

std::string renderJson(std::span<const Diagnostic> diagnostics) {
    Json array = Json::array();
    for (const Diagnostic& d : diagnostics) {
        Json object = placeJson(placeOf(d.file, d.range));
        object["severity"] = std::string(severityName(d.severity));
        object["code"] = codeName(d.code);
        const CatalogueEntry* entry = findEntry(static_cast<uint16_t>(d.code));
        if (entry && isSwitchable(*entry)) object["name"] = kebabName(*entry);
        object["message"] = d.message;
        Json notes = Json::array();
        for (const Diagnostic::Note& note : d.notes) {
            Json item = placeJson(placeOf(note.file, note.range));
            item["message"] = note.message;
            notes.push_back(std::move(item));
        }
        if (!notes.empty()) object["notes"] = std::move(notes);
        if (!d.fixes.empty()) object["fixes"] = fixesJson(d);
        array.push_back(std::move(object));
    }
    return dump(array);
}

} // namespace rapid::diag
