// Notifications: documents, files on disk, folders, settings.

#include "config/json_text.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/settings.h"
#include "tools/lsp/uri.h"

#include <algorithm>
#include <fmt/format.h>

namespace lsp {

namespace {

void didOpen(State& state, const Json& params) {
    const Json& given = objectField(params, "textDocument");
    const Json* language = optionalField(given, "languageId");
    const Document& document = state.documents.open(
        textField(given, "uri"), language && language->is_string() ? language->get<std::string>() : "",
        integerField(given, "version"), textField(given, "text"));
    state.workspace.setText(document.path, document.text);
}

Document& openDocument(State& state, const Json& params) {
    const std::string uri = documentUri(params);
    if (Document* document = state.documents.find(uri)) return *document;
    throw RequestError{error::kInvalidParams, fmt::format("'{}' is not open", uri)};
}

// All changes or none: a text that lacks some of them would be another one than the client's.
void didChange(State& state, const Json& params) {
    Document& document = openDocument(state, params);
    const int64_t version = integerField(objectField(params, "textDocument"), "version");
    Document changed = document;
    for (const Json& change : arrayField(params, "contentChanges"))
        applyChange(changed, change, state.encoding);
    document = std::move(changed);
    document.version = version;
    state.workspace.setText(document.path, document.text);
}

void didClose(State& state, const Json& params) {
    const Document document = openDocument(state, params);
    state.documents.close(document.uri);
    state.workspace.dropText(document.path);
    if (Documents::isUnsaved(document.path))
        state.notify("textDocument/publishDiagnostics",
                     {{"uri", document.uri}, {"diagnostics", Json::array()}});
}

void didSave(State& state, const Json& params) {
    const std::string path = state.documents.pathOfUri(documentUri(params));
    if (!path.empty()) state.workspace.fileChanged(path);
}

void filesChanged(State& state, const Json& params) {
    for (const Json& change : arrayField(params, "changes"))
        if (const auto path = pathOf(textField(change, "uri"))) state.workspace.fileChanged(*path);
}

void foldersChanged(State& state, const Json& params) {
    const Json& event = objectField(params, "event");
    std::vector<std::string> folders = state.workspace.folders();
    for (const Json& folder : arrayField(event, "removed"))
        if (const auto path = pathOf(textField(folder, "uri"))) std::erase(folders, *path);
    for (const Json& folder : arrayField(event, "added"))
        if (const auto path = pathOf(textField(folder, "uri"))) folders.push_back(*path);
    state.workspace.setFolders(folders);
}

void nothing(State&, const Json&) {}

} // namespace

const std::map<std::string_view, NotificationHandler>& notifications() {
    static const std::map<std::string_view, NotificationHandler> all = {
        {"textDocument/didOpen", didOpen},
        {"textDocument/didChange", didChange},
        {"textDocument/didClose", didClose},
        {"textDocument/didSave", didSave},
        {"textDocument/willSave", nothing},
        {"workspace/didChangeConfiguration", configurationChanged},
        {"workspace/didChangeWatchedFiles", filesChanged},
        {"workspace/didChangeWorkspaceFolders", foldersChanged},
        {"workspace/didRenameFiles", filesRenamed},
        {"workspace/didCreateFiles", filesCreatedOrDeleted},
        {"workspace/didDeleteFiles", filesCreatedOrDeleted},
        {"window/workDoneProgress/cancel", nothing},
    };
    return all;
}

} // namespace lsp
