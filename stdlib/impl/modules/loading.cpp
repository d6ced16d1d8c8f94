// Manual 1.6: Load, UnLoad, EraseModule, CheckProgRef.

#include "stdlib/impl/modules/loading.h"

#include "runtime/base/text_util.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/module_units.h"
#include "runtime/host/rapidc_compiler.h"
#include "runtime/host/unit_loader.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/native_table.h"

#include "natives/various.h"
#include "stdlib_constants.h"

#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

namespace rt::lib {
namespace {

/// Loading as a controller does it: opening the file, then so much for each KiB.
constexpr Time kLoadingStart = kSecond / 50;
constexpr Time kLoadingPerKib = kSecond / 1000;

/// The RAPID path with its device: HOME: when the program names none (an editor finds the file by it).
std::string written(const String& directory, const String* file) {
    std::string text(directory.view());
    if (file != nullptr) {
        const std::string_view name = file->view();
        if (!text.empty() && text.back() != '/' && name.substr(0, 1) != "/") text += '/';
        text += name;
    }
    if (text.find(':') != std::string::npos) return text;
    return (text.substr(0, 1) == "/" ? "HOME:" : "HOME:/") + text;
}

bool hostPath(TaskCore* task, const String& directory, const String* file, std::string& path) {
    const Volumes& volumes = taskOf(task).controller().volumes();
    return file != nullptr ? volumes.resolve(directory.view(), file->view(), path)
                           : volumes.resolve(directory.view(), path);
}

bool isChanged(Controller& controller, const LoadedModule& module) {
    return persistentsOf(*module.unit) != units(controller).declared[module.unit];
}

std::string joined(const std::vector<std::string>& lines) {
    constexpr std::size_t kShown = 10;
    std::string text;
    for (std::size_t i = 0; i < lines.size() && i < kShown; ++i)
        text += (i > 0 ? ", " : "") + lines[i];
    if (lines.size() > kShown) text += fmt::format(" and {} more", lines.size() - kShown);
    return text;
}

/// In a built executable the installed rapidc compiles.
struct RapidcLoader {
    RapidcLoader(std::string_view sources, const IoSystem& io)
        : compiler(sources, io), loader(compiler, findNativeAddress) {}
    RapidcCompiler compiler;
    UnitLoader loader;
};

/// The object that compiles and maps modules; null when the program cannot have any.
ModuleLoader* loaderOf(Controller& controller) {
    ModuleUnits& all = units(controller);
    const ProgramDesc& program = controller.program();
    if (all.loader == nullptr && program.sources != nullptr) {
        auto& own = controller.service<std::unique_ptr<RapidcLoader>>();
        own = std::make_unique<RapidcLoader>(std::string_view(program.sources, program.sourcesSize),
                                             controller.io());
        all.loader = &own->loader;
    }
    return all.loader;
}

} // namespace

ReadProblem tryReadModule(TaskCore* task, const String& directory, const String* file, ModuleFile& out) {
    out.shown = written(directory, file);
    if (!hostPath(task, directory, file, out.path))
        return {err::ERR_FILNOTFND, fmt::format("{} is not a file in HOME:", out.shown)};
    struct stat status{};
    if (::stat(out.path.c_str(), &status) != 0)
        return {err::ERR_FILNOTFND, fmt::format("there is no file {}", out.shown)};
    std::ifstream in(out.path, std::ios::binary);
    if (!S_ISREG(status.st_mode) || !in)
        return {err::ERR_IOERROR, fmt::format("{} cannot be read", out.shown)};
    if (static_cast<std::size_t>(status.st_size) > kLargestModule)
        return {err::ERR_PRGMEMFULL, fmt::format("{} does not fit into program memory", out.shown)};
    std::stringstream bytes;
    bytes << in.rdbuf();
    if (in.bad()) return {err::ERR_IOERROR, fmt::format("{} cannot be read", out.shown)};
    out.bytes = bytes.str();
    out.time = static_cast<int64_t>(status.st_mtime);
    return {};
}

Status readModule(TaskCore* task, const String& directory, const String* file, ModuleFile& out) {
    const ReadProblem problem = tryReadModule(task, directory, file, out);
    return problem.number == kOk ? kOk : fail(task, problem.number, problem.text);
}

Time loadingTime(const ModuleFile& file) {
    return kLoadingStart + kLoadingPerKib * static_cast<Time>(file.bytes.size() / 1024);
}

Status checkReferencesOf(TaskCore* task) {
    const Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    ModuleLoader* const loader = loaderOf(controller);
    if (loader == nullptr) return kOk; // the program was checked when it was made
    const OpenReferences open =
        loader->unresolved(owner.name(), static_cast<int32_t>(owner.index()), controller.tables());
    if (!open.problem.empty())
        return fail(task, err::ERR_IOERROR, "references cannot be checked: " + open.problem);
    if (open.names.empty()) return kOk;
    return fail(task, err::ERR_LINKREF, "nothing in the task declares " + joined(open.names));
}

Status linkModule(TaskCore* task, const ModuleFile& file, bool dynamic, bool checkReferences) {
    const Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    const auto index = static_cast<int32_t>(owner.index());
    ModuleLoader* const loader = loaderOf(controller);
    if (loader == nullptr)
        return fail(task, err::ERR_IOERROR,
                    fmt::format("{} cannot be loaded: there is no compiler for it", file.shown));
    const LoadResult result = linkUnit(
        controller, *loader, {owner.name(), index, file.path, file.shown, file.bytes}, dynamic, file.time);
    if (result.verdict == LoadResult::Verdict::Loaded)
        return fail(task, err::ERR_LOADED,
                    fmt::format("module {} of {} is loaded already", result.module, file.shown));
    if (result.verdict == LoadResult::Verdict::Full)
        return fail(task, err::ERR_PRGMEMFULL,
                    fmt::format("there is no program memory left for {}", file.shown));
    if (result.verdict == LoadResult::Verdict::NoCompiler)
        return fail(task, err::ERR_IOERROR,
                    fmt::format("{} cannot be loaded: {}", file.shown, result.problems));
    if (result.verdict == LoadResult::Verdict::Wrong)
        return fail(task, err::ERR_SYNTAX, fmt::format("{} has errors:\n{}", file.shown, result.problems));
    const Status status = checkReferences ? checkReferencesOf(task) : kOk;
    if (status != kOk) removeModule(controller, index, result.module);
    return status;
}

Status unloadFile(TaskCore* task, const String& directory, const String* file) {
    const Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    const auto index = static_cast<int32_t>(owner.index());
    const std::string shown = written(directory, file);
    std::string path;
    const LoadedModule* module =
        hostPath(task, directory, file, path) ? controller.tables().findFile(index, path) : nullptr;
    if (module == nullptr)
        return fail(task, err::ERR_UNLOAD,
                    fmt::format("no module has been loaded from {} by this task", shown));
    if (executes(controller, *module))
        return fail(task, err::ERR_UNLOAD, fmt::format("module {} is executing", module->name));
    removeModule(controller, index, std::string(module->name));
    return kOk;
}

} // namespace rt::lib

using namespace rt;

extern "C" {

Status rt_Load(TaskCore* task, bool Dynamic, const String* FilePath, const String* File, bool CheckRef) {
    lib::ModuleFile file;
    if (const Status status = lib::readModule(task, *FilePath, File, file); status != kOk) return status;
    if (const Status status = taskOf(task).sleepFor(lib::loadingTime(file)); status != kOk) return status;
    return lib::linkModule(task, file, Dynamic, CheckRef);
}

Status rt_UnLoad(TaskCore* task, bool ErrIfChanged, bool Save, const String* FilePath, const String* File) {
    const Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    std::string path;
    const LoadedModule* module = lib::hostPath(task, *FilePath, File, path)
                                     ? controller.tables().findFile(static_cast<int32_t>(owner.index()), path)
                                     : nullptr;
    if (module != nullptr && (ErrIfChanged || Save)) {
        const bool changed = lib::isChanged(controller, *module);
        if (changed && ErrIfChanged)
            return lib::fail(
                task, err::ERR_NOTSAVED,
                fmt::format("persistents of module {} have changed since it was loaded", module->name));
        if (changed) {
            const auto saved = controller.saver().save(owner, module->name, module->file);
            if (saved.outcome != ModuleSaver::Outcome::Saved)
                return lib::fail(task, err::ERR_UNLOAD,
                                 fmt::format("module {} cannot be saved: {}", module->name, saved.text));
        }
    }
    return lib::unloadFile(task, *FilePath, File);
}

Status rt_EraseModule(TaskCore* task, const String* ModuleName) {
    const Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    const auto index = static_cast<int32_t>(owner.index());
    const LoadedModule* module = controller.tables().findModule(index, ModuleName->view());
    if (module == nullptr)
        return lib::fail(task, err::ERR_MODULE, fmt::format("there is no module {}", ModuleName->view()));
    if (executes(controller, *module))
        return lib::fail(task, err::ERR_MODULE, fmt::format("module {} is executing", module->name));
    const bool compiledIn = module->unit == nullptr;
    const std::string name = module->name;
    removeModule(controller, index, name);
    if (ModuleLoader* loader = lib::loaderOf(controller); compiledIn && loader != nullptr) {
        const OpenReferences open = loader->unresolved(owner.name(), index, controller.tables());
        if (!open.names.empty())
            controller.log().write(EventId::StillReferred, &owner, {name, lib::joined(open.names)});
    }
    return kOk;
}

Status rt_CheckProgRef(TaskCore* task) {
    return lib::checkReferencesOf(task);
}
}
