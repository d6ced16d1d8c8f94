// modules.*: modules in program memory.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/rws/module_text.h"
#include "tools/service/symbols.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

using rapid::config::endsWithName;
using rapid::config::sameName;

const char* nameOfRoutineKind(service::SymbolType type) {
    switch (type) {
    case service::SymbolType::Function: return "func";
    case service::SymbolType::Trap: return "trap";
    default: return "proc";
    }
}

class ModuleArea final : public Area {
  public:
    explicit ModuleArea(const Context& context) : controller_(context.controller) {}

    void addTo(MethodTable& methods) override {
        methods.add("modules.list", [this](Client&, const Json& params) { return list(params); });
        methods.add("modules.text", [this](Client&, const Json& params) {
            NamedModule named = moduleOf(controller_, params);
            return Json{{"text", std::move(named.text)},
                        {"changes", controller_.structuralChanges(named.task)}};
        });
        methods.add("modules.setText", [this](Client&, const Json& params) { return setText(params); });
        methods.add("modules.load", [this](Client&, const Json& params) { return load(params); });
        methods.add("modules.unload", [this](Client&, const Json& params) {
            const NamedModule named = moduleOf(controller_, params);
            refuseUnless(controller_.unloadModule(named.task, std::string(named.module.name)));
            return Json();
        });
        methods.add("modules.save", [this](Client&, const Json& params) { return save(params); });
        methods.add("modules.routines", [this](Client&, const Json& params) { return routines(params); });
    }

  private:
    Json list(const Json& params);
    Json setText(const Json& params);
    Json load(const Json& params);
    Json save(const Json& params);
    Json routines(const Json& params);
    /// A path of a volume that leads to this file of the host; "" when it is in none.
    std::string shownPath(const std::string& host) const;

    service::VirtualController& controller_;
};

std::string ModuleArea::shownPath(const std::string& host) const {
    for (const char* volume : {"HOME", "BACKUP", "TEMP", "RAMDISK"}) {
        const std::string folder = controller_.folderOf(volume);
        if (!folder.empty() && host.starts_with(folder + "/"))
            return fmt::format("{}:{}", volume, host.substr(folder.size()));
    }
    return {};
}

Json ModuleArea::list(const Json& params) {
    const rt::Task& task = taskOf(controller_, params);
    Json modules = Json::array();
    for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
        std::string text;
        if (module.task != static_cast<int32_t>(task.index()) ||
            !controller_.moduleText(task, module.name, text))
            continue;
        const std::string attributes = rws::attributesOf(text, module.name);
        const auto hasAttribute = [&](const char* name) {
            return rapid::config::containsName(attributes, name);
        };
        modules.push_back({{"name", module.name},
                           {"kind", hasAttribute("SYSMODULE") ? "system" : "program"},
                           {"lines", rws::sizeOf(text).first},
                           {"readOnly", hasAttribute("READONLY") || hasAttribute("VIEWONLY")},
                           {"path", shownPath(module.file)}});
    }
    return {{"modules", std::move(modules)}};
}

Json ModuleArea::setText(const Json& params) {
    const NamedModule named = moduleOf(controller_, params);
    const std::string text = textOf(params, "text");
    const uint64_t changes = controller_.structuralChanges(named.task);
    if (has(params, "changes") &&
        static_cast<uint64_t>(wholeOf(params, "changes", 0, int64_t{1} << 53)) != changes)
        throw RequestError{code::kRefused, "The program has changed since this text was read",
                           "Read the text again"};
    const std::string refusal = controller_.setModuleText(named.task, std::string(named.module.name), text);
    if (refusal.find('\n') != std::string::npos) badRequest(refusal); // mistakes, one per line
    refuseUnless(refusal);
    return {{"changes", changes + 1}};
}

Json ModuleArea::load(const Json& params) {
    rt::Task& task = taskOf(controller_, params);
    const HostFile file = fileOf(controller_, params, "path");
    const std::string refusal =
        controller_.loadModule(task, file.host, file.rapid, flagOr(params, "replace", false));
    if (refusal.find('\n') != std::string::npos) badRequest(refusal);
    refuseUnless(refusal);
    return {};
}

Json ModuleArea::save(const Json& params) {
    const NamedModule named = moduleOf(controller_, params);
    Json target = params;
    if (!has(params, "path")) {
        const std::string origin = shownPath(named.module.file);
        const bool isSystem = rws::isSystemModule(named.text, named.module.name);
        target["path"] =
            origin.empty() ? fmt::format("HOME:/{}.{}", named.module.name, isSystem ? "sys" : "mod") : origin;
    }
    const HostFile file = fileOf(controller_, target, "path");
    static constexpr const char* kExtensions[] = {".mod", ".modx", ".sys", ".sysx", ".prg"};
    const bool isModule =
        std::any_of(std::begin(kExtensions), std::end(kExtensions),
                    [&](const char* extension) { return endsWithName(file.rapid, extension); });
    if (!isModule)
        badRequest(fmt::format("{} is not a file of a module", file.rapid),
                   "Let its name end in .mod, .modx, .sys or .sysx");
    const std::string problem =
        rws::saveModule(controller_.core(), named.task, named.module, named.text, file.host);
    if (!problem.empty())
        throw RequestError{code::kFailed, fmt::format("{} cannot be written: {}", file.rapid, problem)};
    return {{"path", file.rapid}};
}

Json ModuleArea::routines(const Json& params) {
    const rt::Task& task = taskOf(controller_, params);
    service::SymbolQuery query;
    query.block = "RAPID/" + task.name();
    query.types = {service::SymbolType::Procedure, service::SymbolType::Function, service::SymbolType::Trap};
    query.skipPredefined = true;
    if (has(params, "module")) query.block += "/" + moduleOf(controller_, params).module.name;
    std::vector<service::SymbolInfo> found;
    (void)service::Symbols(controller_).search(query, found);
    Json routines = Json::array();
    for (const service::SymbolInfo& each : found) {
        const std::size_t end = each.url.rfind('/');
        const std::size_t begin = each.url.rfind('/', end - 1) + 1;
        routines.push_back({{"module", each.url.substr(begin, end - begin)},
                            {"name", each.name},
                            {"kind", nameOfRoutineKind(each.type)},
                            {"line", each.begin.line},
                            {"parameters", each.count}});
    }
    return {{"routines", std::move(routines)}};
}

} // namespace

std::unique_ptr<Area> makeModuleArea(const Context& context) {
    return std::make_unique<ModuleArea>(context);
}

} // namespace rapidc::pendant
