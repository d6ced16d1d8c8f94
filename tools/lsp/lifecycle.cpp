// initialize: what the server offers and what the client is like; initialized: what the client is asked for.

#include "config/json_text.h"
#include "frontend/project/settings.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/settings.h"
#include "tools/lsp/uri.h"

namespace lsp {

namespace {

/// The folders of the client: those of the workspace, or the one root that older clients name.
std::vector<std::string> foldersOf(const Json& params) {
    std::vector<std::string> folders;
    const auto add = [&](const std::string& uri) {
        if (const auto path = pathOf(uri)) folders.push_back(*path);
    };
    const Json* list = optionalField(params, "workspaceFolders");
    if (list && !list->is_array())
        throw RequestError{error::kInvalidParams, "'workspaceFolders': expected an array"};
    if (list && !list->empty()) {
        for (const Json& folder : *list)
            add(textField(folder, "uri"));
        return folders;
    }
    if (optionalField(params, "rootUri"))
        add(textField(params, "rootUri"));
    else if (optionalField(params, "rootPath"))
        add(fileUri(textField(params, "rootPath")));
    return folders;
}

PositionEncoding encodingOf(const Json& params) {
    const Json* list = at(params, "capabilities.general.positionEncodings");
    if (!list || !list->is_array() || list->empty()) return PositionEncoding::Utf16;
    return list->front() == "utf-8" ? PositionEncoding::Utf8 : PositionEncoding::Utf16;
}

/// Files that the server reads: patterns for watchers and file operations.
const char* const kPatterns[] = {"**/*.{mod,modx,sys,sysx,prg,cfg,pgf}",
                                 "**/*.{MOD,MODX,SYS,SYSX,PRG,CFG,PGF}", "**/rapidc.json", "**/backinfo.txt"};

void watchFiles(State& state) {
    if (!state.can("workspace.didChangeWatchedFiles.dynamicRegistration")) return;
    Json watchers = Json::array();
    for (const char* pattern : kPatterns)
        watchers.push_back({{"globPattern", pattern}});
    const Json registration{{"id", "rapidc-files"},
                            {"method", "workspace/didChangeWatchedFiles"},
                            {"registerOptions", {{"watchers", std::move(watchers)}}}};
    state.request("client/registerCapability", {{"registrations", Json::array({registration})}}, nullptr);
}

Json fileOperations() {
    Json filters = Json::array();
    filters.push_back(
        {{"scheme", "file"}, {"pattern", {{"glob", kPatterns[0]}, {"options", {{"ignoreCase", true}}}}}});
    filters.push_back({{"scheme", "file"}, {"pattern", {{"glob", "**"}, {"matches", "folder"}}}});
    const Json registration{{"filters", std::move(filters)}};
    return {{"willRename", registration},
            {"didRename", registration},
            {"didCreate", registration},
            {"didDelete", registration}};
}

} // namespace

void initialize(State& state, const Json& params) {
    objectField(params, "capabilities");
    if (const Json* process = optionalField(params, "processId"); process && !process->is_number_integer())
        throw RequestError{error::kInvalidParams, "'processId': expected an integer or null"};
    const std::vector<std::string> folders = foldersOf(params);
    state.setInitialization(params);
    state.encoding = encodingOf(params);
    if (const Json* options = optionalField(params, "initializationOptions")) applySettings(state, *options);
    state.workspace.setFolders(folders);
    state.settingsKnown = !state.can("workspace.configuration");
    state.settingsDeadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
}

void afterInitialized(State& state) {
    watchFiles(state);
    if (state.can("workspace.configuration")) askForSettings(state);
}

Json capabilities(State& state) {
    Json offered{
        {"positionEncoding", state.encoding == PositionEncoding::Utf8 ? "utf-8" : "utf-16"},
        {"textDocumentSync",
         {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}, {"willSave", false}}},
        {"diagnosticProvider",
         {{"identifier", "rapidc"}, {"interFileDependencies", true}, {"workspaceDiagnostics", true}}},
        {"documentFormattingProvider", true},
        {"documentRangeFormattingProvider", true},
        {"documentOnTypeFormattingProvider",
         {{"firstTriggerCharacter", "\n"}, {"moreTriggerCharacter", Json::array({";"})}}},
        {"codeActionProvider",
         {{"codeActionKinds", Json::array({"quickfix", "refactor", "refactor.extract", "refactor.inline",
                                           "refactor.rewrite", "source.fixAll", "source"})}}},
        {"workspace",
         {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}},
          {"fileOperations", fileOperations()}}}};
    addLanguageCapabilities(offered);
    return {{"capabilities", std::move(offered)},
            {"serverInfo", {{"name", "rapidc"}, {"version", RAPIDC_VERSION}}}};
}

} // namespace lsp
