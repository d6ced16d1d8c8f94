#include "tools/rapidc/dap/context.h"

#include "tools/rapidc/dap/source_requests.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc::dap {

namespace fs = std::filesystem;

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string pathOfUri(const std::string& uri) {
    constexpr std::string_view kScheme = "file://";
    if (uri.rfind(kScheme, 0) != 0) return uri;
    std::string path;
    for (std::size_t i = kScheme.size(); i < uri.size(); ++i) {
        const bool code =
            uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0;
        path += code ? static_cast<char>(hexDigit(uri[i + 1]) * 16 + hexDigit(uri[i + 2])) : uri[i];
        i += code ? 2 : 0;
    }
    return path;
}

std::string uriOfPath(const std::string& path) {
    constexpr std::string_view kPlain = "/-._~:";
    std::string uri = "file://";
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || kPlain.find(c) != std::string_view::npos)
            uri += c;
        else
            uri += fmt::format("%{:02X}", byte);
    }
    return uri;
}

} // namespace

std::string ClientFacts::pathOut(const std::string& path) const {
    return usesUris ? uriOfPath(path) : path;
}

uint32_t ClientFacts::lineIn(int64_t line) const {
    return static_cast<uint32_t>(std::clamp<int64_t>(line + (linesStartAt1 ? 0 : 1), 1, INT32_MAX));
}

void Context::requireProgram() const {
    if (!program) throw Refusal(hasEnded ? "the program has ended" : "no program has been launched");
}

rt::Controller& Context::controller() const {
    requireProgram();
    return program->controller();
}

rt::Debugger& Context::debugger() const {
    rt::Controller& host = controller();
    if (program->arguments().noDebug) throw Refusal("the program was launched without debugging (noDebug)");
    return host.debugger();
}

rt::Task& Context::task(int64_t thread) const {
    const auto& tasks = controller().tasks();
    if (thread < 1 || thread > static_cast<int64_t>(tasks.size()))
        throw Refusal(fmt::format("there is no thread {}", thread));
    return *tasks[static_cast<std::size_t>(thread - 1)];
}

void Context::requireStop() const {
    if (!debugger().standsStill()) throw Refusal("the program is executing: pause it first");
}

Json Context::source(const std::string& file) const {
    if (file.empty()) return nullptr;
    const std::string path = program ? program->hostPath(file) : file;
    Json source{{"name", fs::path(path).filename().string()}};
    if (!path.empty() && path.front() == '/')
        source["path"] = facts.pathOut(path);
    else if (const int64_t reference = libraryReference(path); reference != 0)
        source["sourceReference"] = reference;
    return source;
}

std::string Context::pathIn(const Arguments& source) const {
    const std::string path = source.text("path", source.text("name", ""));
    if (path.empty()) throw Refusal("the source has neither path nor name");
    return path.rfind("file://", 0) == 0 ? pathOfUri(path) : path;
}

Json Context::place(const rt::SourcePlace& place) const {
    Json json = Json::object();
    if (Json file = source(place.file); !file.is_null()) json["source"] = std::move(file);
    if (place.line > 0) {
        json["line"] = facts.lineOut(place.line);
        json["column"] = facts.columnOut(std::max(place.column, 1u));
    }
    return json;
}

} // namespace rapidc::dap
