#include "tools/rws/modules.h"
#include "tools/rws/request_values.h"

#include "config/atomic_file.h"
#include "config/letter_case.h"
#include "runtime/host/module_saver.h"
#include "tools/rws/mod_pos.h"
#include "tools/rws/module_text.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/symbol_text.h"
#include "tools/service/file_volumes.h"

#include <filesystem>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

constexpr std::size_t kLargestText = std::size_t{512} << 10; // bytes of a text that a reply holds
constexpr const char* kOldList = "/rw/rapid/modules";
constexpr const char* kOld = "/rw/rapid/modules/{module}";
constexpr const char* kNewList = "/rw/rapid/tasks/{task}/modules";
constexpr const char* kNew = "/rw/rapid/tasks/{task}/modules/{module}";

/// From startrow, startcol, endrow, endcol. None: they make no sense.
std::optional<TextRange> rangeOf(const Request& request) {
    TextRange range;
    const auto read = [&](const char* name, int64_t otherwise, int64_t& into) {
        const std::string text = fieldOf(request, name);
        const auto number = text.empty() ? otherwise : wholeIn(text, -1, 10'000'000);
        into = number.value_or(0);
        return number && *number != 0;
    };
    const bool reads = read("startrow", 1, range.startRow) && read("startcol", 1, range.startColumn) &&
                       read("endrow", range.startRow, range.endRow) && read("endcol", -1, range.endColumn);
    if (!reads || range.startRow < 1 || range.startColumn < 1) return std::nullopt;
    return range;
}

std::string extensionOf(std::string_view name) {
    for (const char* known : {".modx", ".sysx", ".mod", ".sys", ".prg"}) {
        const std::string_view extension = known;
        if (name.size() > extension.size() &&
            sameName(name.substr(name.size() - extension.size()), extension))
            return std::string(name.substr(name.size() - extension.size()));
    }
    return {};
}

} // namespace

Handler Modules::with(Method method) {
    return [this, method](const Request& request) {
        Asked asked;
        asked.task = taskOf(controller_, request);
        if (asked.task == nullptr) return noTask(request);
        const std::string& name = request.parameter("module");
        asked.module =
            controller_.core().tables().findModule(static_cast<int32_t>(asked.task->index()), name);
        if (asked.module == nullptr || !controller_.moduleText(*asked.task, asked.module->name, asked.text))
            return Reply::refuse(ReturnCode::NoModule,
                                 "There is no module " + name + " in task " + asked.task->name());
        return (this->*method)(request, asked);
    };
}

void Modules::addTo(Router& router) {
    router.get(Dialect::V1, kOldList, [this](const Request& request) { return list(request); });
    router.get(Dialect::V2, kNewList, [this](const Request& request) { return list(request); });
    router.get(Dialect::V1, kOld, with(&Modules::showOld));
    router.get(Dialect::V2, kNew, with(&Modules::show));
    router.get(Dialect::V1, std::string(kOld) + "/routine", with(&Modules::routine));
    const auto get = [&](const char* name, Method method) {
        router.get(Dialect::V2, std::string(kNew) + "/" + name, with(method));
    };
    get("text", &Modules::text);
    get("text/range", &Modules::range);
    get("text/search", &Modules::search);
    get("changecount", &Modules::changeCount);
    get("module-extension", &Modules::extension);
    router.get(Dialect::V2, std::string(kNew) + "/sync-pers", [](const Request&) {
        Document document;
        document.add("rap-syncper-status", "sync-pers").value("syncperstatus", "1");
        return Reply::of(std::move(document));
    });
    const Handler text = access_.guarded(Domain::Rapid, with(&Modules::setText));
    const Handler range = access_.guarded(Domain::Rapid, with(&Modules::setRange));
    for (const char* action : {"set-module-text", "setmoduletext", "set-text"})
        router.action(kOld, action, text);
    for (const char* action : {"set-text-range", "settextrange", "set-range"})
        router.action(kOld, action, range);
    router.post(Dialect::V2, std::string(kNew) + "/text", text);
    router.post(Dialect::V2, std::string(kNew) + "/text/range", range);
    const Handler modify = access_.guarded(Domain::Rapid, with(&Modules::modify));
    for (const char* action : {"modify-position", "set-modify-position", "modpos"})
        router.action(kOld, action, modify);
    router.post(Dialect::V2, std::string(kNew) + "/modify-position", modify);
    router.action(kOld, "set-syncpers", with(&Modules::keepValues));
    router.action(kOld, "save", with(&Modules::save));
    router.post(Dialect::V2, std::string(kNew) + "/save", with(&Modules::save));
}

bool Modules::isSystem(const rt::Task& task, const rt::LoadedModule& module) {
    std::string text;
    return controller_.moduleText(task, module.name, text) && isSystemModule(text, module.name);
}

void Modules::describe(const rt::Task& task, const rt::LoadedModule& module, Document& document) {
    Entry& entry = document.add("rap-module-info-li", module.name);
    entry.value("name", module.name).value("type", isSystem(task, module) ? "SysMod" : "ProgMod");
}

Reply Modules::list(const Request& request) {
    const bool all = request.dialect == Dialect::V1 && !request.query.has("task");
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr && !all) return noTask(request);
    Document document;
    for (const auto& each : controller_.core().tasks()) {
        if (!all && each.get() != task) continue;
        for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
            if (module.task >= 0 && module.task != static_cast<int32_t>(each->index())) continue;
            describe(*each, module, document);
            document.entries.back().self =
                request.dialect == Dialect::V1
                    ? fmt::format("modules/{}?task={}", module.name, each->name())
                    : fmt::format("tasks/{}/modules/{}", each->name(), module.name);
        }
    }
    return Reply::of(std::move(document));
}

/// RWS 1.0 selects what is shown by ?resource=; rows and columns select a part of the text.
Reply Modules::showOld(const Request& request, const Asked& asked) {
    const std::string resource = request.query.text("resource");
    if (sameName(resource, "module-text")) return text(request, asked);
    if (sameName(resource, "change-count") || sameName(resource, "changecount"))
        return changeCount(request, asked);
    if (sameName(resource, "module-extension")) return extension(request, asked);
    if (sameName(resource, "search") || sameName(resource, "text-search")) return search(request, asked);
    if (!resource.empty())
        return badParameter("resource", "module-text, change-count, module-extension or search");
    if (request.query.has("text")) return search(request, asked);
    return request.query.has("startrow") ? range(request, asked) : show(request, asked);
}

/// The routine that a place of the text belongs to.
Reply Modules::routine(const Request& request, const Asked& asked) {
    if (!request.query.text("resource").empty())
        return Reply::refuse(ReturnCode::NotSupported,
                             "arguments of calls are not described: only routines are", 404);
    const auto row = countIn(request.query.text("row"));
    if (!row || *row == 0) return badParameter("row", "a number from 1");
    const auto found = routineOfRow(asked.text, asked.module->name, *row);
    if (!found) return Reply::refuse(ReturnCode::NotFound, fmt::format("row {} is not in a routine", *row));
    Document document;
    document.add("rap-routine-prop", found->name)
        .value("name", found->name)
        .value("symtyp", std::string(symtypOf(found->type)))
        .value("named", "true")
        .value("local", found->isLocal ? "true" : "false")
        .value("npar", fmt::format("{}", found->parameters));
    return Reply::of(std::move(document));
}

Reply Modules::show(const Request&, const Asked& asked) {
    const rt::LoadedModule& module = *asked.module;
    Document document;
    document.add("rap-module", asked.task->name() + "/" + module.name)
        .value("taskname", asked.task->name())
        .value("modname", module.name)
        .value("filename", std::filesystem::path(module.file).filename().string())
        .value("attribute", attributesOf(asked.text, module.name));
    return Reply::of(std::move(document));
}

/// A large text comes by a file in $TEMP, which the client reads and deletes.
Reply Modules::text(const Request& request, const Asked& asked) {
    Document document;
    Entry& entry = document.add("rap-module-text", asked.module->name);
    entry.value("change-count", std::to_string(controller_.structuralChanges(*asked.task)))
        .value("module-length", std::to_string(asked.text.size()));
    if (asked.text.size() <= kLargestText) {
        entry.value("module-text", asked.text);
        return Reply::of(std::move(document));
    }
    const std::string path = fmt::format("$TEMP/{}_text_{}.modx", asked.module->name,
                                         request.session ? request.session->number : 0);
    const std::optional<VolumePath> file = volumePath(controller_, path);
    const std::string problem =
        file ? rapid::config::replaceFile(file->host, asked.text) : "there is no volume $TEMP";
    if (!problem.empty()) return Reply::refuse(ReturnCode::Rejected, problem);
    entry.value("file-path", request.dialect == Dialect::V1 ? path : path.substr(1));
    return Reply::of(std::move(document));
}

/// The values of persistents are written when a module is saved, so there is nothing to do.
Reply Modules::keepValues(const Request&, const Asked&) {
    return Reply::done();
}

Reply Modules::range(const Request& request, const Asked& asked) {
    const std::optional<TextRange> range = rangeOf(request);
    const std::optional<std::string> part = range ? partOf(asked.text, *range) : std::nullopt;
    if (!part) return badParameter("startrow, startcol, endrow or endcol", "a place in the module");
    Document document;
    document.add("rap-mod-text", asked.module->name).value("text", *part);
    return Reply::of(std::move(document));
}

Reply Modules::search(const Request& request, const Asked& asked) {
    const std::string wanted = request.query.text("text");
    if (wanted.empty()) return badParameter("text", "the text to search");
    Document document;
    for (const auto& [row, column] : placesOf(asked.text, wanted, 1000))
        document.add("rap-text-position", fmt::format("{},{}", row, column))
            .value("Row", std::to_string(row))
            .value("Column", std::to_string(column));
    return Reply::of(std::move(document));
}

Reply Modules::changeCount(const Request&, const Asked& asked) {
    Document document;
    document.add("rap-module-changecount", asked.module->name)
        .value("count", std::to_string(controller_.structuralChanges(*asked.task)));
    return Reply::of(std::move(document));
}

Reply Modules::extension(const Request&, const Asked& asked) {
    const auto [lines, columns] = sizeOf(asked.text);
    Document document;
    document.add("rap-module-extension", asked.module->name)
        .value("num-of-lines", std::to_string(lines))
        .value("max-num-of-col", std::to_string(columns))
        .value("count", std::to_string(controller_.structuralChanges(*asked.task)));
    return Reply::of(std::move(document));
}

Reply Modules::setText(const Request& request, const Asked& asked) {
    if (!request.form.has("text")) return badParameter("text", "the text of the module");
    return replyTo(controller_.setModuleText(*asked.task, asked.module->name, request.form.text("text")),
                   ReturnCode::Rejected, 400);
}

/// replace-mode: After and Before insert at the end or the beginning of the range, Replace (standard) takes its place.
Reply Modules::setRange(const Request& request, const Asked& asked) {
    const std::optional<TextRange> range = rangeOf(request);
    const std::string mode = request.form.text("replace-mode");
    if (!request.form.has("text")) return badParameter("text", "the new text");
    if (!mode.empty() && !sameName(mode, "Replace") && !sameName(mode, "After") && !sameName(mode, "Before"))
        return badParameter("replace-mode", "Replace, After or Before");
    const RangeMode how = sameName(mode, "After")    ? RangeMode::After
                          : sameName(mode, "Before") ? RangeMode::Before
                                                     : RangeMode::Replace;
    const std::optional<std::string> changed =
        range ? withRange(asked.text, *range, request.form.text("text"), how) : std::nullopt;
    if (!changed) return badParameter("startrow, startcol, endrow or endcol", "a place in the module");
    return replyTo(controller_.setModuleText(*asked.task, asked.module->name, *changed), ReturnCode::Rejected,
                   400);
}

Reply Modules::modify(const Request& request, const Asked& asked) {
    std::optional<TextRange> range = rangeOf(request);
    if (!range) return badParameter("startrow, startcol, endrow or endcol", "a place in the module");
    range->startColumn = 1; // whole rows: a column only says where the cursor is
    range->endColumn = -1;
    return replyTo(modifyPositions(controller_, *asked.task, asked.module->name, asked.text, *range),
                   ReturnCode::Rejected, 400);
}

/// The module with the present values of its persistents, into a folder of a volume. RWS 2.0 always writes NAME.modx.
Reply Modules::save(const Request& request, const Asked& asked) {
    std::string name = request.form.text("name");
    if (name.empty()) name = asked.module->name;
    const std::string folder = request.form.text("path");
    if (!service::isPlainFileName(name)) return badParameter("name", "the name of a file, without a folder");
    const std::string extension = extensionOf(name);
    if (request.dialect == Dialect::V2)
        name = name.substr(0, name.size() - extension.size()) + ".modx";
    else if (extension.empty())
        name += ".mod";
    const std::optional<VolumePath> path = volumePath(controller_, folder);
    std::error_code code;
    if (!path || !std::filesystem::is_directory(path->host, code))
        return Reply::refuse(ReturnCode::NoLoadPath, "There is no folder " + folder);
    const std::optional<VolumePath> file = volumePath(controller_, path->rapid + "/" + name);
    if (!file) return Reply::refuse(ReturnCode::NoLoadPath, name + " is not a file of a volume");
    const std::string problem =
        saveModule(controller_.core(), *asked.task, *asked.module, asked.text, file->host);
    return problem.empty() ? Reply::done() : Reply::refuse(ReturnCode::Rejected, problem);
}

} // namespace rapidc::rws
