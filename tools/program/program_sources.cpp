#include "tools/program/program_sources.h"

#include "runtime/abi/rt_abi.h"
#include "runtime/host/cbor.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"
#include "tools/program/controller_environment.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc {

namespace sema = rapid::sema;

namespace {

using Json = nlohmann::json;

/// Code of one version fits to an executable of the same version only: what is predefined and how memory is laid out.
std::string fingerprint() {
    uint64_t hash = 14695981039346656037u; // FNV-1a
    const auto add = [&](std::string_view bytes) {
        for (const char c : bytes)
            hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    };
    for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources())
        add(source.text);
    for (const rt::SupportEntry& entry : rt::supportTable())
        add(entry.symbol);
    add(fmt::format("{} {} {} {} {} {}", sizeof(rt::ProgramDesc), sizeof(rt::RoutineDesc),
                    sizeof(rt::GlobalDesc), sizeof(rt::RoutineEntry), sizeof(rt::TypeDesc),
                    sizeof(rt::TaskCore)));
    return fmt::format("{:016x}", hash);
}

Json jsonOf(const ProgramSources::Task& task) {
    Json json{{"name", task.input.name},
              {"type", task.input.type},
              {"entry", task.input.entry},
              {"missing", task.input.missingModules},
              {"incomplete", task.input.incomplete || task.input.bindsLate},
              {"optional", task.input.optional},
              {"modules", task.modules},
              {"files", Json::array()}};
    for (const auto& file : task.input.files)
        json["files"].push_back({file->path(), rt::binaryJson(file->bytes())});
    return json;
}

ProgramSources::Task taskOf(const Json& json) {
    ProgramSources::Task task;
    task.input.name = json.at("name").get<std::string>();
    task.input.type = json.at("type").get<std::string>();
    task.input.entry = json.at("entry").get<std::string>();
    task.input.missingModules = json.at("missing").get<std::vector<std::string>>();
    task.input.incomplete = json.at("incomplete").get<bool>();
    task.input.optional = json.at("optional").get<bool>();
    task.modules = json.at("modules").get<std::vector<std::vector<std::string>>>();
    for (const Json& file : json.at("files"))
        task.input.files.push_back(std::make_shared<const rapid::SourceFile>(file.at(0).get<std::string>(),
                                                                             rt::bytesOf(file.at(1))));
    return task;
}

} // namespace

std::unique_ptr<ProgramSources> sourcesOf(const Compilation& compilation, bool stepping, bool optimise) {
    auto sources = std::make_unique<ProgramSources>();
    sources->options = compilation.options;
    sources->library = compilation.library;
    sources->options.library = sources->library;
    sources->sharedModules = compilation.sharedModules;
    sources->stepping = stepping;
    sources->optimise = optimise;
    for (const auto& checked : compilation.program->tasks) {
        ProgramSources::Task& task = sources->tasks.emplace_back();
        const auto found =
            std::find_if(compilation.tasks.begin(), compilation.tasks.end(),
                         [&](const sema::TaskInput& input) { return input.name == checked->name; });
        task.input.name = checked->name;
        if (found != compilation.tasks.end()) task.input = *found;
        task.modules.resize(task.input.files.size());
        for (const sema::Module* module : checked->modules)
            for (size_t i = 0; i < task.input.files.size(); ++i)
                if (task.input.files[i] == module->tree->source) task.modules[i].push_back(module->name);
    }
    return sources;
}

std::string pack(const ProgramSources& sources) {
    const sema::CheckOptions& options = sources.options;
    Json json{{"version", RAPIDC_VERSION},
              {"fingerprint", fingerprint()},
              {"stepping", sources.stepping},
              {"optimise", sources.optimise},
              {"shared", sources.sharedModules},
              {"configurationKnown", options.configurationKnown},
              {"options", nullptr},
              {"signals", Json::array()},
              {"tasks", Json::array()}};
    if (options.robotWareOptions) json["options"] = *options.robotWareOptions;
    for (const sema::SignalInfo& signal : options.signals)
        json["signals"].push_back({signal.name, signal.type});
    for (const ProgramSources::Task& task : sources.tasks)
        json["tasks"].push_back(jsonOf(task));
    return rt::writeCbor(json);
}

std::unique_ptr<ProgramSources> unpack(std::string_view bytes, std::string& problem) try {
    const Json json = rt::readCbor(bytes);
    const auto version = json.at("version").get<std::string>();
    if (json.at("fingerprint").get<std::string>() != fingerprint()) {
        problem = fmt::format("the executable was built by {} rapidc {}, this is rapidc {}",
                              version == RAPIDC_VERSION ? "another build of" : "", version, RAPIDC_VERSION);
        return nullptr;
    }
    auto sources = std::make_unique<ProgramSources>();
    sources->library = controllerEnvironment().library(false);
    sources->options.library = sources->library;
    sources->stepping = json.at("stepping").get<bool>();
    sources->optimise = json.at("optimise").get<bool>();
    sources->sharedModules = json.at("shared").get<std::set<std::string>>();
    sources->options.configurationKnown = json.at("configurationKnown").get<bool>();
    if (!json.at("options").is_null())
        sources->options.robotWareOptions = json.at("options").get<std::vector<std::string>>();
    for (const Json& signal : json.at("signals"))
        sources->options.signals.push_back(
            {signal.at(0).get<std::string>(), signal.at(1).get<std::string>()});
    for (const Json& task : json.at("tasks"))
        sources->tasks.push_back(taskOf(task));
    return sources;
} catch (const Json::exception&) {
    problem = "what the executable says about its sources cannot be read";
    return nullptr;
}

} // namespace rapidc
