#include "tools/lsp/diagnostics.h"

#include "config/json_text.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/project/files.h"
#include "tools/lsp/readable_texts.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lsp {

namespace diag = rapid::diag;
namespace fs = std::filesystem;
using diag::Code;
namespace say = diag::say;
using Diagnostics = std::vector<const diag::Diagnostic*>;

namespace {

/// Also of those read by a name that is not absolute (rapidc.json).
std::string absolutePath(const std::string& path) {
    if (path.starts_with('/')) return path;
    std::error_code ignored;
    return fs::absolute(path, ignored).lexically_normal().string();
}

constexpr int kUnnecessary = 1;

bool isUnnecessary(Code code) {
    switch (code) {
    case say::UnusedVariable.code:
    case say::UnusedParameter.code:
    case say::UnusedRoutine.code:
    case say::UnusedType.code:
    case say::TrapNotConnected.code: return true;
    default: return false;
    }
}

uint64_t hashOf(const Diagnostics& diagnostics) {
    uint64_t hash = 14695981039346656037u; // FNV-1a
    const auto add = [&hash](const void* data, size_t size) {
        for (size_t i = 0; i < size; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
    };
    const auto number = [&](uint64_t value) { add(&value, sizeof value); };
    // An edit may leave the offset of a place and change its line or column, in UTF-16 as well.
    const auto place = [&](const rapid::SourceFile& file, uint32_t offset) {
        offset = std::min(offset, static_cast<uint32_t>(file.text().size()));
        const rapid::LineColumn at = file.lineColumn(offset);
        number((uint64_t{at.line} << 32) | at.column);
        const uint32_t start = file.lineStart(at.line);
        const bool ascii = offset - start == at.column - 1;
        if (!ascii) add(file.text().data() + start, offset - start);
    };
    const auto places = [&](const std::shared_ptr<const rapid::SourceFile>& file, rapid::SourceRange range) {
        if (!file) return;
        place(*file, range.begin);
        place(*file, range.end);
    };
    for (const diag::Diagnostic* d : diagnostics) {
        number(static_cast<uint64_t>(d->code) * 4 + static_cast<uint64_t>(d->severity));
        places(d->file, d->range);
        add(d->message.data(), d->message.size());
        for (const diag::Diagnostic::Note& note : d->notes) {
            places(note.file, note.range);
            add(note.message.data(), note.message.size());
            if (note.file) add(note.file->path().data(), note.file->path().size());
        }
    }
    return hash | 1; // 0 means never sent
}

void add(DiagnosticsByPath& out, State& state, rapid::workspace::Program& program) {
    std::map<std::string_view, std::string> owned; // "" for files of another program
    for (const diag::Diagnostic& d : program.diagnostics()) {
        if (d.severity == diag::Severity::Note) continue;
        if (!d.file) continue; // those go into the log
        auto known = owned.find(d.file->path());
        if (known == owned.end()) {
            std::string path = absolutePath(d.file->path());
            if (state.workspace.ownerOf(path) != &program) path.clear();
            known = owned.emplace(d.file->path(), std::move(path)).first;
        }
        if (!known->second.empty()) out[known->second].push_back(&d);
    }
}

} // namespace

DiagnosticsByPath diagnosticsByPath(State& state) {
    for (const auto& [uri, document] : state.documents.all())
        state.workspace.adopt(document.path);
    DiagnosticsByPath out;
    for (rapid::workspace::Program* program : state.workspace.programs())
        add(out, state, *program);
    return out;
}

Diagnostics diagnosticsOf(State& state, const std::string& path) {
    state.workspace.adopt(path);
    rapid::workspace::Program* owner = state.workspace.ownerOf(path);
    if (!owner) return {};
    DiagnosticsByPath all;
    add(all, state, *owner);
    return all[path];
}

Json toJson(State& state, const diag::Diagnostic& d) {
    Json range = toJson(Range{});
    if (d.file) range = toJson(state.positions(d.file)->range(d.range));
    Json out{{"range", std::move(range)},
             {"severity", d.severity == diag::Severity::Error ? 1 : 2},
             {"code", diag::codeName(d.code)},
             {"source", "rapidc"},
             {"message", d.message}};
    if (state.can("textDocument.publishDiagnostics.codeDescriptionSupport"))
        if (const std::string page = explanationUri(d.code); !page.empty())
            out["codeDescription"] = {{"href", page}};
    if (isUnnecessary(d.code) &&
        hasElement(state.capability("textDocument.publishDiagnostics.tagSupport.valueSet"), kUnnecessary))
        out["tags"] = Json::array({kUnnecessary});
    if (!state.can("textDocument.publishDiagnostics.relatedInformation")) return out;
    Json related = Json::array();
    for (const diag::Diagnostic::Note& note : d.notes)
        if (note.file)
            related.push_back(
                {{"location", state.location(note.file, note.range)}, {"message", note.message}});
    if (!related.empty()) out["relatedInformation"] = std::move(related);
    return out;
}

void Publisher::send(State& state, const std::string& path, const Diagnostics& diagnostics) {
    const Document* document = state.documents.byPath(path);
    Json list = Json::array();
    for (const diag::Diagnostic* d : diagnostics)
        list.push_back(toJson(state, *d));
    Json params{{"uri", state.documents.uriOf(path)}, {"diagnostics", std::move(list)}};
    if (document) params["version"] = document->version;
    state.notify("textDocument/publishDiagnostics", std::move(params));
}

bool Publisher::publishQuickly(State& state) {
    bool nothingSlow = true;
    for (const auto& [uri, document] : state.documents.all()) {
        rapid::workspace::Program* owner = state.workspace.programOf(document.path);
        if (!owner || !owner->isSlowToJudge()) continue;
        nothingSlow = false;
        const std::vector<diag::Diagnostic> found = owner->quickDiagnostics(document.path);
        Diagnostics diagnostics;
        for (const diag::Diagnostic& d : found)
            if (d.severity != diag::Severity::Note) diagnostics.push_back(&d);
        const Sent fresh{hashOf(diagnostics), document.version};
        Sent& before = sent_[document.path];
        if (before.hash == fresh.hash && before.version == fresh.version) continue;
        send(state, document.path, diagnostics);
        before = fresh;
    }
    return nothingSlow;
}

// Paths of open documents come first: they are what the user looks at.
void Publisher::publish(State& state) {
    static const Diagnostics kNone;
    const DiagnosticsByPath found = diagnosticsByPath(state);
    std::vector<std::string> paths;
    for (const auto& [uri, document] : state.documents.all())
        paths.push_back(document.path);
    const size_t open = paths.size();
    for (const auto& [path, diagnostics] : found)
        paths.push_back(path);
    for (const auto& [path, sent] : sent_)
        if (!found.contains(path)) paths.push_back(path);
    std::map<std::string, Sent> now;
    for (size_t i = 0; i < paths.size(); ++i) {
        const std::string& path = paths[i];
        if (now.contains(path)) continue;
        const auto at = found.find(path);
        const Diagnostics& diagnostics = at == found.end() ? kNone : at->second;
        const Document* document = state.documents.byPath(path);
        const Sent fresh{hashOf(diagnostics), document ? document->version : -1};
        const auto before = sent_.find(path);
        const bool same = before != sent_.end() && before->second.hash == fresh.hash &&
                          before->second.version == fresh.version;
        if (!document && Documents::isUnsaved(path)) continue; // said when it was closed
        if (!same && !(before == sent_.end() && diagnostics.empty() && i >= open))
            send(state, path, diagnostics);
        if (document || !diagnostics.empty()) now[path] = fresh;
    }
    sent_ = std::move(now);
    logOthers(state);
    state.dirty = false;
}

/// Problems with options, folders without modules, unknown robots: once, into the log.
void Publisher::logOthers(State& state) {
    std::string all;
    for (rapid::workspace::Program* program : state.workspace.programs()) {
        for (const std::string& problem : program->loaded().usageErrors)
            all += problem + "\n";
        for (const diag::Diagnostic& d : program->diagnostics())
            if (!d.file && d.severity != diag::Severity::Note && d.code != say::NoInput.code)
                all += fmt::format("{}: {}\n", diag::codeName(d.code), d.message);
    }
    if (all == logged_) return;
    logged_ = all;
    if (!all.empty()) state.log(2, all);
}

namespace {

std::string resultId(const Diagnostics& diagnostics) {
    return fmt::format("{:016x}", hashOf(diagnostics));
}

Json report(State& state, const Diagnostics& diagnostics, const Json* previous) {
    const std::string id = resultId(diagnostics);
    if (previous && previous->is_string() && previous->get<std::string>() == id)
        return {{"kind", "unchanged"}, {"resultId", id}};
    Json items = Json::array();
    for (const diag::Diagnostic* d : diagnostics)
        items.push_back(toJson(state, *d));
    return {{"kind", "full"}, {"resultId", id}, {"items", std::move(items)}};
}

} // namespace

Json pullDiagnostics(State& state, const Json& params) {
    const std::string uri = documentUri(params);
    const std::string path = state.documents.pathOfUri(uri);
    if (path.empty())
        throw RequestError{error::kInvalidParams, fmt::format("'{}' is not open, and it names no file", uri)};
    return report(state, diagnosticsOf(state, path), optionalField(params, "previousResultId"));
}

Json pullWorkspaceDiagnostics(State& state, const Json& params) {
    std::map<std::string, Json> previous;
    for (const Json& each : arrayField(params, "previousResultIds"))
        previous[state.documents.pathOfUri(textField(each, "uri"))] = textField(each, "value");
    DiagnosticsByPath found = diagnosticsByPath(state);
    for (const auto& [path, id] : previous)
        if (!path.empty()) found[path]; // it has none any more
    for (const auto& [uri, document] : state.documents.all())
        found[document.path];
    Json items = Json::array();
    for (const auto& [path, diagnostics] : found) {
        const auto known = previous.find(path);
        Json item = report(state, diagnostics, known == previous.end() ? nullptr : &known->second);
        const Document* document = state.documents.byPath(path);
        item["uri"] = state.documents.uriOf(path);
        item["version"] = document ? Json(document->version) : Json(nullptr);
        items.push_back(std::move(item));
    }
    return {{"items", std::move(items)}};
}

} // namespace lsp
