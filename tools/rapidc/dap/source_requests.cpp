#include "tools/rapidc/dap/source_requests.h"

#include "config/read_file.h"
#include "frontend/source/source_file.h"
#include "stdlib/stdlib_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace rapidc::dap {

int64_t libraryReference(std::string_view name) {
    const auto& sources = rapid::stdlib::sources();
    for (std::size_t i = 0; i < sources.size(); ++i)
        if (sources[i].name == name) return static_cast<int64_t>(i) + 1;
    return 0;
}

void SourceRequests::addTo(Handlers& handlers) {
    const auto add = registrar(handlers, *this);
    add("source", &SourceRequests::source);
    add("loadedSources", &SourceRequests::loadedSources);
    add("modules", &SourceRequests::modules);
}

Json SourceRequests::source(const Arguments& arguments) {
    const Arguments given = arguments.object("source");
    int64_t reference = arguments.number("sourceReference", 0);
    if (reference == 0) reference = given.number("sourceReference", 0);
    if (reference != 0) {
        const auto& sources = rapid::stdlib::sources();
        if (reference < 1 || reference > static_cast<int64_t>(sources.size()))
            throw Refusal(fmt::format("there is no source {}", reference));
        return {{"content", std::string(sources[static_cast<std::size_t>(reference - 1)].text)},
                {"mimeType", "text/x-rapid"}};
    }
    // Only files of the program: the adapter does not serve other files.
    const std::string path = context_.pathIn(given);
    const auto& modules = context_.controller().tables().modules();
    const bool known = std::any_of(modules.begin(), modules.end(), [&](const rt::LoadedModule& module) {
        return context_.program->hostPath(module.file) == path;
    });
    if (!known) throw Refusal(fmt::format("'{}' is not a file of the program", path));
    std::string bytes;
    if (const std::string problem = rapid::config::readFile(path, bytes); !problem.empty())
        throw Refusal(fmt::format("'{}' cannot be read: {}", path, problem));
    const rapid::SourceFile file(path, bytes);
    return {{"content", std::string(file.text())}, {"mimeType", "text/x-rapid"}};
}

std::set<std::string> SourceRequests::files() const {
    std::set<std::string> files;
    for (const rt::LoadedModule& module : context_.controller().tables().modules())
        if (!module.file.empty()) files.insert(module.file);
    return files;
}

void SourceRequests::programMade() {
    known_ = files();
    count_ = context_.controller().tables().modules().size();
}

bool SourceRequests::hasOtherCount() const {
    return context_.controller().tables().modules().size() != count_;
}

void SourceRequests::look() {
    count_ = context_.controller().tables().modules().size();
    std::set<std::string> now = files();
    const auto send = [this](const char* reason, const std::set<std::string>& list,
                             const std::set<std::string>& but) {
        for (const std::string& file : list)
            if (!but.contains(file))
                context_.client.event("loadedSource",
                                      {{"reason", reason}, {"source", context_.source(file)}});
    };
    send("new", now, known_);
    send("removed", known_, now);
    known_ = std::move(now);
}

Json SourceRequests::loadedSources(const Arguments&) {
    Json list = Json::array();
    for (const std::string& file : files())
        list.push_back(context_.source(file));
    return {{"sources", std::move(list)}};
}

Json SourceRequests::modules(const Arguments& arguments) {
    const int64_t start = arguments.number("startModule", 0);
    const int64_t count = arguments.number("moduleCount", 0);
    if (start < 0 || count < 0) throw Refusal("'startModule' and 'moduleCount' must not be negative");
    const auto& modules = context_.controller().tables().modules();
    Json list = Json::array();
    for (std::size_t i = static_cast<std::size_t>(start); i < modules.size(); ++i) {
        if (count > 0 && list.size() >= static_cast<std::size_t>(count)) break;
        const rt::LoadedModule& module = modules[i];
        const auto& tasks = context_.controller().tasks();
        const bool owned = module.task >= 0 && module.task < static_cast<int32_t>(tasks.size());
        Json json{{"id", owned ? fmt::format("{}/{}", tasks[static_cast<std::size_t>(module.task)]->name(),
                                             module.name)
                               : module.name},
                  {"name", module.name},
                  {"isUserCode", true}};
        if (!module.file.empty()) json["path"] = context_.program->hostPath(module.file);
        list.push_back(std::move(json));
    }
    return {{"modules", std::move(list)}, {"totalModules", modules.size()}};
}

} // namespace rapidc::dap
