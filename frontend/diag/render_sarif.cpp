// Diagnostics as SARIF 2.1.0 (OASIS), with what code scanning services ask for beyond the standard: rules with texts,
// a place for every result, relative URIs, and fingerprints that survive changes elsewhere in the file.

#include "config/json_text.h"
#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"

#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace rapid::diag {

namespace {

using Json = nlohmann::ordered_json;

Json textOf(std::string text) {
    return {{"text", std::move(text)}};
}

/// Bytes of a path as part of a URI.
std::string percentEncoded(std::string_view path) {
    static constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    std::string out;
    for (const char c : path) {
        if (kPlain.find(c) != std::string_view::npos)
            out.push_back(c);
        else
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

/// Relative to `root` where the file lies in it, else a file URI.
std::string uriOf(const std::string& path, std::string_view root) {
    namespace fs = std::filesystem;
    if (path.empty()) return ".";
    if (root.empty()) return percentEncoded(fs::path(path).lexically_normal().generic_string());
    const fs::path base = fs::path(root).lexically_normal();
    const fs::path whole = (base / path).lexically_normal();
    const fs::path relative = whole.lexically_relative(base);
    if (!relative.empty() && *relative.begin() != "..") return percentEncoded(relative.generic_string());
    return "file://" + percentEncoded(whole.generic_string());
}

class Writer {
  public:
    Writer(std::span<const Diagnostic> diagnostics, std::string_view root) : root_(root) {
        std::set<Code> used;
        for (const Diagnostic& d : diagnostics)
            used.insert(d.code);
        for (const Code code : used) {
            ruleIndex_[code] = rules_.size();
            rules_.push_back(rule(code));
        }
        for (const Diagnostic& d : diagnostics)
            results_.push_back(result(d));
    }

    Json log() && {
        Json driver = {{"name", "rapidc"}, {"semanticVersion", RAPIDC_VERSION}, {"rules", std::move(rules_)}};
        Json run;
        run["tool"] = {{"driver", std::move(driver)}};
        run["columnKind"] = "unicodeCodePoints";
        if (!root_.empty()) {
            Json place = {{"uri", "file://" + percentEncoded(root_) + "/"}};
            run["originalUriBaseIds"] = {{kRoot, std::move(place)}};
        }
        run["results"] = std::move(results_);
        return {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                {"version", "2.1.0"},
                {"runs", Json::array({std::move(run)})}};
    }

  private:
    static constexpr const char* kRoot = "%SRCROOT%";
    static constexpr size_t kFingerprintBytes =
        1000; ///< of a line: some are made by machines and have millions

    static Json rule(Code code) {
        const CatalogueEntry* entry = findEntry(static_cast<uint16_t>(code));
        const Explanation* explanation = findExplanation(static_cast<uint16_t>(code));
        const std::string meaning(explanation ? explanation->meaning : entry->text);
        std::string help = meaning, markdown = meaning;
        const auto example = [&](const char* title, std::string_view text) {
            if (text.empty()) return;
            help += fmt::format("\n\n{}:\n{}", title, text);
            markdown +=
                fmt::format("\n\n{}:\n\n```{}\n{}\n```", title, exampleLanguage(explanation->kind), text);
        };
        if (explanation) {
            example("Wrong", explanation->wrong);
            example("Right", explanation->right);
        }
        Json out;
        out["id"] = codeName(code);
        out["name"] = std::string(entry->name);
        out["shortDescription"] = textOf(title(*entry));
        out["fullDescription"] = textOf(meaning);
        out["help"] = {{"text", std::move(help)}, {"markdown", std::move(markdown)}};
        out["defaultConfiguration"] = {{"level", std::string(severityName(entry->severity))}};
        out["properties"] = {{"tags", Json::array({"rapid"})}};
        return out;
    }

    Json artifact(const std::string& path) const {
        Json out = {{"uri", uriOf(path, root_)}};
        if (!root_.empty() && !out["uri"].get_ref<const std::string&>().starts_with("file:"))
            out["uriBaseId"] = kRoot;
        return out;
    }

    static Json region(const SourceFile& file, SourceRange range) {
        const LineColumn begin = file.lineColumn(range.begin);
        const LineColumn end = file.lineColumn(std::max(range.begin, range.end));
        return {{"startLine", begin.line},
                {"startColumn", begin.column},
                {"endLine", end.line},
                {"endColumn", end.column}};
    }

    Json location(const std::shared_ptr<const SourceFile>& file, SourceRange range) const {
        Json physical = {{"artifactLocation", artifact(file ? file->path() : std::string())}};
        if (file) physical["region"] = region(*file, range);
        return {{"physicalLocation", std::move(physical)}};
    }

    /// The code, the text of the line and how many lines of the file with both came before: it stays the same when
    /// lines are inserted above.
    std::string fingerprint(const Diagnostic& d) {
        std::string key = codeName(d.code) + '\n';
        if (d.file) {
            const std::string_view line = d.file->lineText(d.file->lineColumn(d.range.begin).line);
            for (const char c : line.substr(0, kFingerprintBytes))
                if (c != ' ' && c != '\t') key.push_back(c);
            key += '\n' + d.file->path();
        } else {
            key += d.message;
        }
        uint64_t hash = 14695981039346656037u; // FNV-1a
        for (const char c : key)
            hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
        return fmt::format("{:016x}:{}", hash, ++fingerprints_[hash]);
    }

    Json fixes(const Diagnostic& d) const {
        Json out = Json::array();
        for (const Diagnostic::Fix& fix : d.fixes) {
            Json replacements = Json::array();
            for (const TextEdit& edit : fix.edits)
                replacements.push_back({{"deletedRegion", region(*d.file, edit.range)},
                                        {"insertedContent", textOf(edit.replacement)}});
            Json change = {{"artifactLocation", artifact(d.file->path())},
                           {"replacements", std::move(replacements)}};
            out.push_back({{"description", textOf(fix.message)},
                           {"artifactChanges", Json::array({std::move(change)})}});
        }
        return out;
    }

    Json result(const Diagnostic& d) {
        Json out = {{"ruleId", codeName(d.code)},
                    {"ruleIndex", ruleIndex_[d.code]},
                    {"level", std::string(severityName(d.severity))},
                    {"message", textOf(d.message)},
                    {"locations", Json::array({location(d.file, d.range)})}};
        Json related = Json::array();
        for (const Diagnostic::Note& note : d.notes) {
            if (!note.file) continue;
            Json place = {{"id", related.size() + 1}};
            place.update(location(note.file, note.range));
            place["message"] = textOf(note.message);
            related.push_back(std::move(place));
        }
        if (!related.empty()) out["relatedLocations"] = std::move(related);
        out["partialFingerprints"] = {{"primaryLocationLineHash", fingerprint(d)}};
        if (d.file && !d.fixes.empty()) out["fixes"] = fixes(d);
        return out;
    }

    std::string root_;
    Json rules_ = Json::array();
    Json results_ = Json::array();
    std::map<Code, size_t> ruleIndex_;
    std::map<uint64_t, unsigned> fingerprints_;
};

} // namespace

std::string renderSarif(std::span<const Diagnostic> diagnostics, std::string_view root) {
    // A path need not be UTF-8, a JSON text must be.
    return config::textOf(Writer(diagnostics, root).log(), 2) + "\n";
}

} // namespace rapid::diag
