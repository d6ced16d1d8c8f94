#include "tools/lsp/state.h"

#include "config/json_text.h"
#include "frontend/project/files.h"
#include "tools/lsp/readable_texts.h"
#include "tools/lsp/uri.h"

#include <filesystem>
#include <fmt/format.h>

namespace lsp {

State::State(const rapid::workspace::Environment& given, Send send)
    : environment(given), workspace(given), send_(std::move(send)),
      initialization_(std::make_unique<Json>(Json::object())) {}
State::~State() = default;

void State::setInitialization(const Json& params) {
    *initialization_ = params;
}

const Json* State::capability(std::string_view path) const {
    return at(*initialization_, "capabilities." + std::string(path));
}

bool State::can(std::string_view path) const {
    return isTrue(*initialization_, "capabilities." + std::string(path));
}

void State::notify(const std::string& method, Json params) {
    send_(notification(method, std::move(params)));
}

void State::request(const std::string& method, Json params, Answered answered) {
    Json message = notification(method, std::move(params));
    message["id"] = ++lastRequest_;
    waiting_[lastRequest_] = std::move(answered);
    send_(message);
}

void State::answer(const Json& message) {
    const Json& id = message.at("id");
    const auto found = id.is_number_integer() ? waiting_.find(id.get<int64_t>()) : waiting_.end();
    if (found == waiting_.end()) return;
    const Answered answered = std::move(found->second);
    waiting_.erase(found);
    const auto result = message.find("result");
    if (answered) answered(*this, result == message.end() ? nullptr : &*result);
}

void State::log(int type, const std::string& text) {
    notify("window/logMessage", {{"type", type}, {"message", text}});
}

void State::show(int type, const std::string& text) {
    notify("window/showMessage", {{"type", type}, {"message", text}});
}

std::shared_ptr<const PositionMap> State::positions(const std::shared_ptr<const rapid::SourceFile>& file) {
    constexpr size_t kMostKept = 64; // they hold their texts
    const auto found = positions_.find(file.get());
    if (found != positions_.end()) return found->second;
    if (positions_.size() >= kMostKept) positions_.clear();
    return positions_[file.get()] = std::make_shared<const PositionMap>(file, encoding);
}

std::string State::pathOf(const Json& params) {
    const std::string uri = documentUri(params);
    std::string path = documents.pathOfUri(uri);
    if (path.empty())
        throw RequestError{error::kInvalidParams, fmt::format("'{}' is not open, and it names no file", uri)};
    return path;
}

Target State::target(const Json& params) {
    return targetOfPath(pathOf(params));
}

Target State::targetAt(const Json& params) {
    Target found = target(params);
    found.offset = found.positions->offset(positionOf(field(params, "position")));
    return found;
}

Target State::targetWhileTyping(const Json& params) {
    const std::string path = pathOf(params);
    const auto position = positionOf(field(params, "position"));
    Target found = targetIn(
        path, workspace.programAround(path, [&](const std::shared_ptr<const rapid::SourceFile>& text) {
            return positions(text)->offset(position);
        }));
    found.offset = found.positions->offset(position);
    return found;
}

const rapid::query::Snapshot& State::snapshot(const rapid::workspace::Program& program) {
    constexpr size_t kMostKept = 16;
    if (snapshots_.size() > kMostKept) snapshots_.clear();
    KeptSnapshot& kept = snapshots_[program.root()];
    if (kept.snapshot && kept.generation == program.generation()) return *kept.snapshot;
    std::vector<std::shared_ptr<const rapid::SourceFile>> configuration;
    const auto& loaded = program.loaded();
    for (size_t i = 0; i < loaded.configNames.size(); ++i)
        if (loaded.configNames[i].starts_with('/'))
            configuration.push_back(
                std::make_shared<const rapid::SourceFile>(loaded.configNames[i], loaded.configTexts[i]));
    kept.snapshot.reset();
    if (!kept.names) kept.names = std::make_shared<rapid::query::GlobalNames>();
    kept.snapshot =
        std::make_unique<rapid::query::Snapshot>(program.checked(), std::move(configuration), kept.names);
    kept.generation = program.generation();
    return *kept.snapshot;
}

void State::prepareNames() {
    for (const auto& [uri, document] : documents.all()) {
        const rapid::workspace::Program* program = workspace.programOf(document.path);
        if (!program) continue;
        const rapid::query::Snapshot& names = snapshot(*program);
        for (const auto& task : names.program().tasks)
            names.hasUniqueGlobals(*task);
        names.predefined();
    }
}

Target State::targetOfPath(const std::string& path) {
    return targetIn(path, workspace.programOf(path));
}

Target State::targetIn(const std::string& path, rapid::workspace::Program* program) {
    Target target;
    target.path = path;
    target.program = program;
    target.tree = target.program ? target.program->tree(path) : nullptr;
    const auto file = target.tree ? target.tree->source : workspace.read(path);
    if (!file)
        throw RequestError{error::kInvalidParams, fmt::format("'{}' is not open and cannot be read", path)};
    target.positions = positions(file);
    if (!target.tree) target.program = nullptr;
    if (!target.program) return target;
    target.snapshot = &snapshot(*target.program);
    target.view = target.snapshot->file(path);
    return target;
}

Json State::location(const std::shared_ptr<const rapid::SourceFile>& file, rapid::SourceRange range) {
    std::error_code ignored;
    const std::string path = std::filesystem::absolute(file->path(), ignored).lexically_normal().string();
    return {{"uri", documents.uriOf(path)}, {"range", toJson(positions(file)->range(range))}};
}

std::string State::uriOf(const rapid::query::Location& location) {
    if (!location.file) return {};
    if (!location.isLibrary) return documents.uriOf(location.file->path());
    const std::string path = declarationPath(environment, location.file->path());
    return path.empty() ? "" : fileUri(path);
}

Json State::location(const rapid::query::Location& location) {
    const std::string uri = uriOf(location);
    if (uri.empty()) return nullptr;
    return {{"uri", uri}, {"range", toJson(positions(location.file)->range(location.range))}};
}

Json State::edits(const PositionMap& positions, const std::vector<rapid::TextEdit>& edits) const {
    Json out = Json::array();
    for (const rapid::TextEdit& edit : edits)
        out.push_back({{"range", toJson(positions.range(edit.range))}, {"newText", edit.replacement}});
    return out;
}

Json State::workspaceEdit(
    const std::vector<std::pair<std::shared_ptr<const rapid::SourceFile>, std::vector<rapid::TextEdit>>>&
        files) {
    const bool versioned = can("workspace.workspaceEdit.documentChanges");
    Json documentChanges = Json::array(), changes = Json::object();
    for (const auto& [file, edits] : files) {
        const std::string uri = documents.uriOf(file->path());
        Json list = this->edits(*positions(file), edits);
        if (versioned) {
            const Document* document = documents.byPath(file->path());
            const Json version = document ? Json(document->version) : Json(nullptr);
            documentChanges.push_back(
                {{"textDocument", {{"uri", uri}, {"version", version}}}, {"edits", std::move(list)}});
        } else {
            changes[uri] = std::move(list);
        }
    }
    if (versioned) return {{"documentChanges", std::move(documentChanges)}};
    return {{"changes", std::move(changes)}};
}

} // namespace lsp
