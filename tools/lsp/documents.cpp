#include "tools/lsp/documents.h"

#include "config/json_text.h"
#include "config/text_util.h"
#include "frontend/project/files.h"
#include "tools/lsp/positions.h"
#include "tools/lsp/uri.h"

#include <algorithm>

namespace lsp {

namespace {

constexpr std::string_view kUnsaved = "/(unsaved)/";

/// Without slashes.
std::string encodedName(const std::string& uri) {
    std::string name = fileUri("/" + uri).substr(8);
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

/// Files that the server has an opinion on by their names.
bool isKnownFile(const std::string& path) {
    const std::string type = rapid::project::extensionOf(path);
    return rapid::project::isModule(path) || type == ".cfg" || type == ".pgf" || type == ".json" ||
           type == ".txt";
}

} // namespace

std::string Documents::pathFor(const std::string& uri, const std::string& languageId) {
    const auto path = lsp::pathOf(uri);
    const bool rapid = languageId == "rapid" || languageId == "abb-rapid";
    if (path && (!rapid || isKnownFile(*path))) return *path;
    return std::string(kUnsaved) + encodedName(uri) + (rapid ? ".modx" : "");
}

bool Documents::isUnsaved(std::string_view path) {
    return path.starts_with(kUnsaved);
}

Document& Documents::open(const std::string& uri, const std::string& languageId, int64_t version,
                          std::string text) {
    Document& document = byUri_[uri];
    document.uri = uri;
    document.path = pathFor(uri, languageId);
    document.languageId = languageId;
    document.version = version;
    document.text = std::move(text);
    return document;
}

void Documents::close(const std::string& uri) {
    if (const auto found = byUri_.find(uri); found != byUri_.end()) byUri_.erase(found);
}

Document* Documents::find(std::string_view uri) {
    const auto found = byUri_.find(uri);
    if (found != byUri_.end()) return &found->second;
    const auto path = lsp::pathOf(uri); // other words for the same file
    return path ? byPath(*path) : nullptr;
}

Document* Documents::byPath(std::string_view path) {
    for (auto& [uri, document] : byUri_)
        if (document.path == path) return &document;
    return nullptr;
}

std::string Documents::pathOfUri(const std::string& uri) {
    if (const Document* document = find(uri)) return document->path;
    return lsp::pathOf(uri).value_or("");
}

std::string Documents::uriOf(const std::string& path) {
    const Document* document = byPath(path);
    return document ? document->uri : fileUri(path);
}

void applyChange(Document& document, const Json& change, PositionEncoding encoding) {
    std::string text = textField(change, "text");
    const Json* range = optionalField(change, "range");
    if (!range) {
        document.text = std::move(text);
        return;
    }
    const Range where = rangeOf(*range);
    const size_t begin = offsetIn(document.text, where.start, encoding);
    const size_t end = std::max(begin, offsetIn(document.text, where.end, encoding));
    document.text.replace(begin, end - begin, text);
}

} // namespace lsp
