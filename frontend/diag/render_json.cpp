// Diagnostics for programs: the JSON array of `check --format=json` and SARIF 2.1.0.

#include "frontend/diag/catalogue.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

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
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A path as a relative URI reference.
std::string uriOf(std::string_view path) {
    static constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    std::string out;
    for (const char c : path) {
        if (kPlain.find(c) != std::string_view::npos) {
            out.push_back(c);
        } else {
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return out;
}

Json sarifLocation(const Place& place) {
    Json location = {{"physicalLocation",
                      {{"artifactLocation", {{"uri", uriOf(place.file)}}},
                       {"region",
                        {{"startLine", place.begin.line},
                         {"startColumn", place.begin.column},
                         {"endLine", place.end.line},
                         {"endColumn", place.end.column}}}}}};
    return location;
}

Json sarifRules(std::span<const Diagnostic> diagnostics) {
    std::set<Code> used;
    for (const Diagnostic& d : diagnostics)
        used.insert(d.code);
    Json rules = Json::array();
    for (const Code code : used) {
        const CatalogueEntry* entry = findEntry(static_cast<uint16_t>(code));
        if (!entry) continue;
        rules.push_back({{"id", codeName(code)},
                         {"name", std::string(entry->name)},
                         {"shortDescription", {{"text", std::string(entry->text)}}}});
    }
    return rules;
}

Json sarifResult(const Diagnostic& d) {
    Json result = {{"ruleId", codeName(d.code)},
                   {"level", std::string(severityName(d.severity))},
                   {"message", {{"text", d.message}}}};
    if (d.file) result["locations"] = Json::array({sarifLocation(placeOf(d.file, d.range))});
    Json related = Json::array();
    for (const Diagnostic::Note& note : d.notes) {
        if (!note.file) continue;
        Json location = sarifLocation(placeOf(note.file, note.range));
        location["message"] = {{"text", note.message}};
        related.push_back(std::move(location));
    }
    if (!related.empty()) result["relatedLocations"] = std::move(related);
    return result;
}

} // namespace

std::string renderJson(std::span<const Diagnostic> diagnostics) {
    Json array = Json::array();
    for (const Diagnostic& d : diagnostics) {
        Json object = placeJson(placeOf(d.file, d.range));
        object["severity"] = std::string(severityName(d.severity));
        object["code"] = codeName(d.code);
        object["message"] = d.message;
        Json notes = Json::array();
        for (const Diagnostic::Note& note : d.notes) {
            Json item = placeJson(placeOf(note.file, note.range));
            item["message"] = note.message;
            notes.push_back(std::move(item));
        }
        if (!notes.empty()) object["notes"] = std::move(notes);
        array.push_back(std::move(object));
    }
    return dump(array);
}

std::string renderSarif(std::span<const Diagnostic> diagnostics) {
    Json results = Json::array();
    for (const Diagnostic& d : diagnostics)
        results.push_back(sarifResult(d));
    const Json run = {
        {"tool",
         {{"driver", {{"name", "rapidc"}, {"version", "0.1.0"}, {"rules", sarifRules(diagnostics)}}}}},
        {"columnKind", "unicodeCodePoints"},
        {"results", std::move(results)}};
    return dump({{"version", "2.1.0"},
                 {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                 {"runs", Json::array({run})}});
}

} // namespace rapid::diag
