#include "tools/rws/programs.h"
#include "tools/rws/request_values.h"

#include "config/atomic_file.h"
#include "config/letter_case.h"
#include "config/read_file.h"
#include "frontend/project/program_file.h"
#include "tools/rws/module_text.h"
#include "tools/rws/rapid_support.h"
#include "tools/service/file_volumes.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

namespace fs = std::filesystem;
using rapid::config::sameName;

constexpr const char* kProgramPath = "/rw/rapid/tasks/{task}/program";

std::string programFile(const std::vector<std::string>& files) {
    std::string text = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\n<Program>\n";
    for (const std::string& file : files)
        text += "\t<Module>" + file + "</Module>\n";
    return text + "</Program>\n";
}

} // namespace

void Programs::addTo(Router& router) {
    router.getBoth(kProgramPath, [this](const Request& request) { return show(request); });
    const auto order = [&](std::initializer_list<const char*> oldNames, const char* newName,
                           Reply (Programs::*handler)(const Request&), bool changes) {
        Handler call = [this, handler](const Request& request) { return (this->*handler)(request); };
        if (changes) call = access_.guarded(Domain::Rapid, std::move(call));
        for (const char* name : oldNames)
            router.action(kProgramPath, name, call);
        router.post(Dialect::V2, std::string(kProgramPath) + "/" + newName, call);
    };
    order({"loadprog", "load"}, "load", &Programs::load, true);
    order({"save", "saveprog"}, "save", &Programs::save, false);
    order({"unloadprog", "unload"}, "unload", &Programs::unload, true);
    order({"setname", "set-name", "name"}, "name", &Programs::setName, true);
    order({"setentrypoint", "set-entrypoint", "entrypoint"}, "entrypoint", &Programs::setEntry, true);
    const Handler errors = [this](const Request& request) {
        if (taskOf(controller_, request) == nullptr) return noTask(request);
        return Reply::of(Document{}); // a program with mistakes is not taken, so there never are any
    };
    router.getBoth(std::string(kProgramPath) + "/builderror", errors);
    router.getBoth("/rw/rapid/tasks/{task}/builderror", errors);
    addBreakpoints(router);
}

void Programs::addBreakpoints(Router& router) {
    const Handler list = [this](const Request& request) { return listBreaks(request); };
    const Handler set =
        access_.guarded(Domain::Rapid, [this](const Request& request) { return setBreak(request); });
    const Handler remove =
        access_.guarded(Domain::Rapid, [this](const Request& request) { return removeBreak(request); });
    const std::string oldPath = std::string(kProgramPath) + "/breakpoint",
                      newPath = std::string(kProgramPath) + "/breakpoints";
    router.get(Dialect::V1, oldPath, list);
    router.get(Dialect::V1, "/rw/rapid/tasks/{task}/breakpoints", list);
    router.action(oldPath, "set", set);
    router.action(oldPath, "remove", remove);
    router.get(Dialect::V2, newPath, list);
    router.post(Dialect::V2, newPath, set);
    router.add(Dialect::V2, {Method::Delete, newPath, {}, remove});
}

std::string Programs::nameOf(const rt::Task& task) const {
    const auto found = names_.find(task.name());
    return found != names_.end() ? found->second : controller_.core().program().name;
}

std::string Programs::entryOf(const rt::Task& task) const {
    const auto& tasks = controller_.program().compilation().program->tasks;
    return task.index() < tasks.size() ? tasks[task.index()]->entry : "main";
}

/// Those that are not system modules.
std::vector<std::string> Programs::programModules(const rt::Task& task) {
    std::vector<std::string> names;
    for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
        std::string text;
        if (module.task != static_cast<int32_t>(task.index())) continue;
        if (controller_.moduleText(task, module.name, text) && !isSystemModule(text, module.name))
            names.push_back(module.name);
    }
    return names;
}

Reply Programs::show(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    if (programModules(*task).empty()) return Reply::done();
    Document document;
    document.add("rap-program", "program").value("name", nameOf(*task)).value("entrypoint", entryOf(*task));
    return Reply::of(std::move(document));
}

/// All modules of a program file, or one module, at once: when one has mistakes, nothing has changed.
Reply Programs::load(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string given = request.form.text("progpath"), mode = request.form.text("loadmode");
    if (!mode.empty() && !sameName(mode, "add") && !sameName(mode, "replace"))
        return badParameter("loadmode", "add or replace");
    const std::optional<VolumePath> path = volumePath(controller_, given);
    std::string text;
    if (!path || !rapid::config::readFile(path->host, text).empty())
        return Reply::refuse(ReturnCode::NoLoadPath, "There is no file " + given);
    std::vector<std::string> names, files;
    if (!rapid::project::readProgramFile(text, names)) names = {fs::path(path->host).filename().string()};
    const std::string folder = fs::path(path->rapid).parent_path().string();
    for (const std::string& name : names) {
        const std::optional<VolumePath> file = volumePath(controller_, folder + "/" + name);
        std::error_code code;
        if (!file || !fs::is_regular_file(file->host, code))
            return Reply::refuse(ReturnCode::NoLoadPath, "There is no file " + name + " beside the program");
        files.push_back(file->host);
    }
    const service::Refusal refusal = controller_.loadProgram(*task, files, !sameName(mode, "add"));
    if (refusal.empty()) names_[task->name()] = fs::path(path->host).stem().string();
    return replyTo(refusal, ReturnCode::Rejected, 400);
}

/// Into a folder, which may not exist yet: each module and NAME.pgf. A name of the request may have its extension.
Reply Programs::save(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string given = request.form.text("path");
    std::string name = fieldOf(request, "name");
    if (name.empty()) name = nameOf(*task);
    if (!service::isPlainFileName(name)) return badParameter("name", "a name that a file may have");
    if (!sameName(fs::path(name).extension().string(), ".pgf")) name += ".pgf";
    const std::optional<VolumePath> folder = volumePath(controller_, given);
    std::error_code code;
    if (!folder || (fs::create_directories(folder->host, code), !fs::is_directory(folder->host, code)))
        return Reply::refuse(ReturnCode::NoLoadPath, given + " is not a folder of a volume");
    const char* extension = request.dialect == Dialect::V1 ? ".mod" : ".modx";
    std::vector<std::string> files;
    for (const std::string& each : programModules(*task)) {
        std::string text;
        const auto* module =
            controller_.core().tables().findModule(static_cast<int32_t>(task->index()), each);
        if (module == nullptr || !controller_.moduleText(*task, each, text)) continue;
        files.push_back(each + extension);
        const std::string file = (fs::path(folder->host) / files.back()).string();
        if (const std::string problem = saveModule(controller_.core(), *task, *module, text, file);
            !problem.empty())
            return Reply::refuse(ReturnCode::Rejected, problem);
    }
    const std::string file = (fs::path(folder->host) / name).string();
    const std::string problem = rapid::config::replaceFile(file, programFile(files));
    return problem.empty() ? Reply::done() : Reply::refuse(ReturnCode::Rejected, problem);
}

Reply Programs::unload(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    if (programModules(*task).empty()) return Reply::done();
    const service::Refusal refusal = controller_.unloadProgram(*task);
    if (refusal.empty()) names_.erase(task->name());
    return replyTo(refusal);
}

Reply Programs::setName(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string name = request.form.text("name");
    if (!service::isPlainFileName(name)) return badParameter("name", "a name that a file may have");
    names_[task->name()] = name;
    return Reply::done();
}

Reply Programs::setEntry(const Request& request) {
    rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string routine = request.form.text("routine");
    if (routine.empty()) return badParameter("routine", "the name of a procedure");
    if (sameName(routine, entryOf(*task))) return Reply::done();
    return replyTo(controller_.setEntry(*task, routine), ReturnCode::Rejected, 400);
}

// ---- Breakpoints -----------------------------------------------------------------------------------------------------

Reply Programs::listBreaks(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    Document document;
    for (const service::BreakpointList::Mark& each : breakpoints_.all()) {
        if (!sameName(each.task, task->name())) continue;
        document.add("rap-breakpoint-li", fmt::format("{}/{},{}", each.module, each.shownLine(), each.column))
            .value("module", each.module)
            .value("row", std::to_string(each.shownLine()))
            .value("column", std::to_string(each.column));
    }
    return Reply::of(std::move(document));
}

Reply Programs::setBreak(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string module = fieldOf(request, "module"), columnText = fieldOf(request, "column");
    const auto row = wholeIn(fieldOf(request, "row"), 1, 10'000'000);
    const auto column = columnText.empty() ? 1 : wholeIn(columnText, 0, 10'000'000);
    if (!row) return badParameter("row", "the number of a line");
    if (!column) return badParameter("column", "a number");
    const auto* found = controller_.core().tables().findModule(static_cast<int32_t>(task->index()), module);
    if (found == nullptr) return Reply::refuse(ReturnCode::NoModule, "There is no module " + module);
    service::BreakpointList::Mark mark;
    mark.task = task->name();
    mark.module = found->name;
    mark.line = static_cast<uint32_t>(*row);
    mark.column = static_cast<uint32_t>(*column);
    using Added = service::BreakpointList::Added;
    const Added added = breakpoints_.add(mark, true);
    if (added == Added::TooMany) return Reply::refuse(ReturnCode::TooLarge, "There are too many breakpoints");
    if (added == Added::NoInstruction || added == Added::NotInLine)
        return badParameter("row", "a line in which an instruction begins");
    return Reply::done();
}

Reply Programs::removeBreak(const Request& request) {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const auto row = wholeIn(fieldOf(request, "row"), 1, 10'000'000);
    if (!row ||
        breakpoints_.remove(task->name(), fieldOf(request, "module"), static_cast<uint32_t>(*row)) == 0)
        return badParameter("module or row", "the place of a breakpoint");
    return Reply::done();
}

} // namespace rapidc::rws
