// VirtualController: program memory. A module that is not part of the compiled program comes and goes while everything else continues, as
// with Load and UnLoad. One that is part of it takes a new program: data, program pointers and signals stay, background tasks begin as
// after a restart.

#include "config/letter_case.h"
#include "config/read_file.h"
#include "frontend/syntax/parser.h"
#include "runtime/base/text_util.h"
#include "runtime/debug/call_chain.h"
#include "runtime/host/module_units.h"
#include "tools/program/program_sources.h"
#include "tools/service/virtual_controller.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace rapidc::service {

namespace fs = std::filesystem;

namespace {

/// Takes the place of an unloaded program, since a task needs a main. A system module, so that clients do not see it as part of a
/// program.
constexpr const char* kEmptyProgram = "empty_program.sysx";
constexpr const char* kEmptyText =
    "MODULE EmptyProgram(SYSMODULE, NOVIEW)\n  PROC main()\n  ENDPROC\nENDMODULE\n";

/// The file of the compiled program that holds the module, and how many modules it holds; null when there is none.
std::shared_ptr<const rapid::SourceFile> fileOf(const ProgramSources& sources, const rt::Task& task,
                                                const std::string& module, std::size_t& modules) {
    if (task.index() >= sources.tasks.size()) return nullptr;
    const ProgramSources::Task& own = sources.tasks[task.index()];
    for (std::size_t i = 0; i < own.modules.size(); ++i) {
        const auto& names = own.modules[i];
        if (std::none_of(names.begin(), names.end(),
                         [&](const std::string& name) { return rt::sameName(name, module); }))
            continue;
        modules = names.size();
        return own.input.files[i];
    }
    return nullptr;
}

struct ModuleHead {
    std::string name;
    bool isSystem = false;
};

/// The modules that a file holds.
std::vector<ModuleHead> headsOf(const rapid::SourceFile& file) {
    rapid::diag::Sink ignored;
    const auto tree = rapid::syntax::parse(std::make_shared<const rapid::SourceFile>(file), ignored);
    std::vector<ModuleHead> heads;
    for (const rapid::syntax::ModuleDecl* decl : tree->modules)
        heads.push_back(
            {std::string(tree->text(decl->name)), (decl->attributes & rapid::syntax::kAttrSysmodule) != 0});
    return heads;
}

std::string keyOf(const rt::Task& task, const std::string& module) {
    return task.name() + "/" + rapid::config::lowerCase(module);
}

} // namespace

Refusal VirtualController::replaceProgram(ModuleEdits edits, const rt::Task& task, const std::string& what) {
    if (Refusal refusal = programStopped("changing the program"); !refusal.empty()) return refusal;
    std::string problems;
    rt::ExitStatus status = rt::ExitStatus::Ended;
    auto next = std::make_unique<Succession>();
    next->program = compile(edits, problems, status);
    if (!next->program) return "the program would have mistakes:\n" + problems;
    edits_ = std::move(edits);
    noteModules(task, what);
    if (release_) release_();
    next->state = core_->captureState();
    next->modules = loadedModules();
    next->powerOn = false;
    next->motorsOn = core_->motorsOn();
    for (rt::SignalId id = 0; id < static_cast<rt::SignalId>(core_->io().size()); ++id)
        next->signals[core_->io().config(id).name] = core_->io().value(id);
    succession_ = std::move(next);
    core_->endRun();
    return {};
}

/// The modules of Load and of clients, in the order in which they came.
std::vector<VirtualController::CarriedModule> VirtualController::loadedModules() const {
    std::vector<CarriedModule> modules;
    const auto& keepers = core_->service<rt::StateKeepers>();
    for (const rt::LoadedModule& present : core_->tables().modules()) {
        if (present.unit == nullptr || present.task < 0) continue;
        const rt::Task& task = *core_->tasks()[static_cast<std::size_t>(present.task)];
        CarriedModule module{task.name(),
                             {task.name(), present.task, present.file, present.name, {}},
                             present.dynamic,
                             false,
                             present.fileTime,
                             {},
                             {}};
        if (!moduleText(task, present.name, module.request.bytes)) continue;
        for (const ModuleHead& head : headsOf(rapid::SourceFile(present.file, module.request.bytes)))
            module.isSystem = head.isSystem;
        for (uint32_t i = 0; i < present.unit->globalCount; ++i) {
            const rt::GlobalDesc& data = present.unit->globals[i];
            if (data.kind != rt::kGlobalPersistent && data.kind != rt::kGlobalVariable) continue;
            std::string value;
            if (rt::valueToImage(data.address, *data.type, 1, keepers, value))
                (data.kind == rt::kGlobalPersistent ? module.persistents : module.variables)[data.name] =
                    std::move(value);
        }
        modules.push_back(std::move(module));
    }
    return modules;
}

/// Persistents keep their values; variables do so where the program continues, as those of the compiled program.
void VirtualController::bringBack(const CarriedModule& module) {
    rt::Task* task = core_->findTask(module.task);
    if (task == nullptr) return;
    rt::LoadRequest request = module.request;
    request.taskIndex = static_cast<int32_t>(task->index());
    const rt::LoadResult result =
        rt::linkUnit(*core_, *rt::units(*core_).loader, request, module.dynamic, module.fileTime);
    if (result.verdict != rt::LoadResult::Verdict::Made) {
        noteModules(*task, fmt::format("module {} cannot be loaded again: {}", request.shown,
                                       result.verdict == rt::LoadResult::Verdict::Loaded
                                           ? "the program has a module of this name"
                                           : result.problems));
        return;
    }
    const auto& keepers = core_->service<rt::StateKeepers>();
    for (uint32_t i = 0; i < result.unit->globalCount; ++i) {
        const rt::GlobalDesc& data = result.unit->globals[i];
        const bool isVariable = data.kind == rt::kGlobalVariable;
        if (isVariable && !task->isReentering()) continue;
        const auto& values = isVariable ? module.variables : module.persistents;
        if (const auto found = values.find(data.name); found != values.end())
            (void)rt::imageToValue(found->second, data.address, *data.type, 1, keepers);
    }
}

void VirtualController::noteModules(const rt::Task& task, const std::string& what) {
    ++changes_[task.name()];
    core_->log().write(rt::EventId::ProgramLoaded, &task, {task.name(), what});
    observers_.changed(Change::Modules, &task);
}

/// A module that is not compiled into the program takes the place of the one that was loaded before, or comes new.
Refusal VirtualController::link(rt::Task& task, const rt::LoadRequest& request,
                                const rt::LoadedModule* before, int64_t fileTime) {
    rt::ModuleLoader* loader = rt::units(*core_).loader;
    const auto index = static_cast<int32_t>(task.index());
    std::optional<rt::LoadedModule> old;
    if (before != nullptr) {
        if (Refusal refusal = programStopped("replacing a module"); !refusal.empty()) return refusal;
        leaveModule(*before);
        old = *before;
        rt::removeModule(*core_, index, old->name);
    }
    const rt::LoadResult result = rt::linkUnit(*core_, *loader, request, false, fileTime);
    if (result.verdict == rt::LoadResult::Verdict::Made) {
        texts_[keyOf(task, result.module)] = request.bytes;
        noteModules(task, fmt::format("module {} has been loaded from {}", result.module, request.shown));
        return {};
    }
    if (old) rt::addModule(*core_, *old->unit, *old);
    switch (result.verdict) {
    case rt::LoadResult::Verdict::Loaded: return fmt::format("module {} is loaded already", result.module);
    case rt::LoadResult::Verdict::Full: return "there is no program memory left";
    default: return fmt::format("{} has mistakes:\n{}", request.shown, result.problems);
    }
}

/// No task may be in a module that goes: the program pointers of stopped tasks are moved to main.
void VirtualController::leaveModule(const rt::LoadedModule& module) {
    if (rt::executes(*core_, module)) (void)core_->debugger().pointerToMain();
}

Refusal VirtualController::loadModule(rt::Task& task, const std::string& path, const std::string& shown,
                                      bool replace) {
    std::error_code code;
    if (!fs::is_regular_file(path, code)) return fmt::format("there is no file {}", shown);
    if (fs::file_size(path, code) > rt::kLargestModule)
        return fmt::format("{} is too large for a module", shown);
    std::string bytes;
    if (const std::string problem = rapid::config::readFile(path, bytes); !problem.empty())
        return fmt::format("{} cannot be read: {}", shown, problem);
    const auto index = static_cast<int32_t>(task.index());
    const rt::LoadRequest request{task.name(), index, path, shown, bytes};
    const rt::LoadResult probe = rt::units(*core_).loader->make(request, core_->tables());
    if (probe.verdict != rt::LoadResult::Verdict::Loaded || !replace) return link(task, request, nullptr, -1);
    const rt::LoadedModule* present = core_->tables().findModule(index, probe.module);
    if (present != nullptr && present->unit != nullptr) return link(task, request, present, -1);
    return setModuleText(task, probe.module, bytes);
}

Refusal VirtualController::unloadModule(rt::Task& task, const std::string& module) {
    const auto index = static_cast<int32_t>(task.index());
    const rt::LoadedModule* present = core_->tables().findModule(index, module);
    if (present == nullptr) return fmt::format("there is no module {} in task {}", module, task.name());
    if (Refusal refusal = programStopped("unloading a module"); !refusal.empty()) return refusal;
    const std::string what = fmt::format("module {} has been unloaded", present->name);
    if (present->unit != nullptr) {
        leaveModule(*present);
        texts_.erase(keyOf(task, module));
        rt::removeModule(*core_, index, std::string(present->name));
        noteModules(task, what);
        return {};
    }
    std::size_t modules = 0;
    const auto file = fileOf(program_->sources(), task, module, modules);
    if (!file || modules != 1)
        return fmt::format("the file of module {} holds other modules as well", module);
    ModuleEdits edits = edits_;
    edits.remove(task.name(), file->path());
    return replaceProgram(std::move(edits), task, what);
}

Refusal VirtualController::loadProgram(rt::Task& task, const std::vector<std::string>& files, bool replace) {
    if (task.index() >= program_->sources().tasks.size()) return "the task has no program of its own";
    ModuleEdits edits = edits_;
    std::set<std::string> names; // lower case
    std::map<std::string, std::string> texts;
    for (const std::string& file : files) {
        std::string bytes;
        const std::string name = fs::path(file).filename().string();
        std::error_code code;
        if (fs::file_size(file, code) > rt::kLargestModule || code)
            return fmt::format("{} cannot be read, or is too large for a module", name);
        if (const std::string problem = rapid::config::readFile(file, bytes); !problem.empty())
            return fmt::format("{} cannot be read: {}", name, problem);
        for (const ModuleHead& head : headsOf(rapid::SourceFile(file, bytes)))
            names.insert(rapid::config::lowerCase(head.name));
        texts[file] = std::move(bytes);
    }
    for (const auto& source : program_->sources().tasks[task.index()].input.files) {
        const std::vector<ModuleHead> heads = headsOf(*source);
        const bool goes = std::any_of(heads.begin(), heads.end(), [&](const ModuleHead& head) {
            return names.contains(rapid::config::lowerCase(head.name)) || (replace && !head.isSystem);
        });
        if (goes) edits.remove(task.name(), source->path());
    }
    edits.remove(task.name(), kEmptyProgram);
    if (replace) edits.clearEntry(task.name());
    for (auto& [file, bytes] : texts)
        edits.set(task.name(), file, std::move(bytes));
    std::string what = fmt::format("a program of {} modules has been loaded", files.size());
    if (files.empty()) {
        what = "the program has been unloaded";
        edits.setEntry(task.name(), "main");
        edits.set(task.name(), kEmptyProgram, kEmptyText);
    }
    if (Refusal refusal = replaceProgram(std::move(edits), task, what); !refusal.empty()) return refusal;
    succession_->state.clear();
    std::erase_if(succession_->modules, [&](const CarriedModule& module) {
        return replace && !module.isSystem && module.task == task.name();
    });
    return {};
}

Refusal VirtualController::unloadProgram(rt::Task& task) {
    return loadProgram(task, {}, true);
}

Refusal VirtualController::setEntry(rt::Task& task, const std::string& routine) {
    ModuleEdits edits = edits_;
    edits.setEntry(task.name(), routine);
    if (Refusal refusal = replaceProgram(std::move(edits), task, "the program begins with " + routine);
        !refusal.empty())
        return refusal;
    succession_->state.clear();
    return {};
}

Refusal VirtualController::setModuleText(rt::Task& task, const std::string& module, const std::string& text) {
    const auto index = static_cast<int32_t>(task.index());
    const rt::LoadedModule* present = core_->tables().findModule(index, module);
    if (present == nullptr) return fmt::format("there is no module {} in task {}", module, task.name());
    if (present->unit != nullptr)
        return link(task, {task.name(), index, present->file, present->file, text}, present, -1);
    std::size_t modules = 0;
    const auto file = fileOf(program_->sources(), task, module, modules);
    if (!file || modules != 1)
        return fmt::format("the file of module {} holds other modules as well", module);
    ModuleEdits edits = edits_;
    edits.set(task.name(), file->path(), text);
    return replaceProgram(std::move(edits), task, fmt::format("module {} has been changed", present->name));
}

bool VirtualController::moduleText(const rt::Task& task, const std::string& module, std::string& text) const {
    const rt::LoadedModule* present = core_->tables().findModule(static_cast<int32_t>(task.index()), module);
    if (present == nullptr) return false;
    if (const auto found = texts_.find(keyOf(task, module));
        found != texts_.end() && present->unit != nullptr) {
        text = found->second;
        return true;
    }
    std::size_t modules = 0;
    if (const auto file = fileOf(program_->sources(), task, module, modules)) {
        text = std::string(file->text());
        return true;
    }
    return present->unit != nullptr && rapid::config::readFile(present->file, text).empty();
}

uint64_t VirtualController::structuralChanges(const rt::Task& task) const {
    const auto found = changes_.find(task.name());
    return found == changes_.end() ? 0 : found->second;
}

} // namespace rapidc::service
