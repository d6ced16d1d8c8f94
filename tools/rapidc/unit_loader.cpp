#include "tools/rapidc/unit_loader.h"

#include "ir/lower/lower.h"
#include "runtime/host/program_tables.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <thread>

namespace rapidc {

namespace sema = rapid::sema;
namespace diag = rapid::diag;

namespace {

/// "HOME:/part.modx:3:5: cannot assign 'string' to 'num' (RAP2104)"
std::string shortText(const diag::Diagnostic& diagnostic) {
    std::string place;
    if (diagnostic.file) {
        const rapid::LineColumn at = diagnostic.file->lineColumn(diagnostic.range.begin);
        place = fmt::format("{}:{}:{}: ", diagnostic.file->path(), at.line, at.column);
    }
    return fmt::format("{}{} ({})", place, diagnostic.message, diag::codeName(diagnostic.code));
}

std::string problemsOf(const diag::Sink& sink) {
    constexpr size_t kShown = 5;
    std::string text;
    size_t count = 0;
    for (const diag::Diagnostic& diagnostic : sink.sorted()) {
        if (diagnostic.severity != diag::Severity::Error || ++count > kShown) continue;
        text += (text.empty() ? "" : "\n") + shortText(diagnostic);
    }
    if (count > kShown) text += fmt::format("\nand {} more", count - kShown);
    return text;
}

/// Code and data of a unit are never given back, because data may be referred to: that bounds their number.
constexpr size_t kMostUnits = 1000;

/// Tells apart what compiling a module depends on: the file and every module in memory.
std::string keyOf(const rt::LoadRequest& request, const rt::ProgramTables& present) {
    std::string key =
        fmt::format("{}|{}|{}|{}", request.taskIndex, request.shown, request.bytes.size(), request.bytes);
    for (const rt::LoadedModule& module : present.modules())
        key += fmt::format("|{}:{}:{}", module.task, module.name, static_cast<const void*>(module.unit));
    return key;
}

/// Variables and persistents that lie in the unit itself.
std::vector<std::pair<void*, std::string>> initialData(const rt::ProgramDesc& unit,
                                                       const rt::ProgramTables& present) {
    constexpr uint8_t kConst = 2; // ir::GlobalKind::Const
    std::set<const void*> elsewhere;
    for (const rt::GlobalDesc* data : present.globals())
        elsewhere.insert(data->address);
    std::vector<std::pair<void*, std::string>> result;
    for (uint32_t i = 0; i < unit.globalCount; ++i) {
        const rt::GlobalDesc& data = unit.globals[i];
        if ((data.flags & rt::kDataPredefined) == 0 && data.kind < kConst &&
            !elsewhere.contains(data.address))
            result.emplace_back(data.address,
                                std::string(static_cast<const char*>(data.address), data.type->size));
    }
    return result;
}

/// A task of the program has a small stack, too small for a compiler.
template <class Work> void onOwnStack(Work&& work) {
    std::thread(std::forward<Work>(work)).join();
}

const sema::Task* findTask(const sema::CheckedProgram& program, const std::string& name) {
    for (const auto& task : program.tasks)
        if (task->name == name) return task.get();
    return nullptr;
}

/// A type that nothing declares cannot wait until the program runs: without it data have no size.
std::string unknownTypes(const sema::Module& module) {
    const auto isUnknown = [](const sema::Type* type) {
        return type != nullptr && type->base()->kind == sema::TypeKind::Error;
    };
    std::string text;
    const auto look = [&](const sema::Symbol& symbol, const sema::Type* type) {
        if (!isUnknown(type) || symbol.nameToken == rapid::syntax::kNoToken) return;
        const rapid::LineColumn at =
            module.tree->source->lineColumn(module.tree->range(symbol.nameToken).begin);
        text += fmt::format("{}{}:{}:{}: the type of '{}' is declared nowhere", text.empty() ? "" : "\n",
                            module.tree->source->path(), at.line, at.column, symbol.name);
    };
    for (const sema::DataSymbol* data : module.data)
        look(*data, data->type.type);
    for (const sema::TypeSymbol* type : module.types)
        for (const auto& component : type->type->components)
            look(*type, component.type);
    for (const sema::RoutineSymbol* routine : module.routines) {
        if (routine->routineKind == rapid::syntax::RoutineKind::Func)
            look(*routine, routine->returnType.type);
        for (const sema::DataSymbol* param : routine->params)
            if (!param->isSwitch) look(*param, param->type.type);
        for (const sema::DataSymbol* data : routine->data)
            if (data->storage == sema::Storage::RoutineData && data->decl) look(*data, data->type.type);
    }
    return text;
}

/// Data of a module; without module, a persistent that modules share.
const rt::GlobalDesc* findData(const rt::ProgramTables& present, std::string_view name,
                               std::string_view module, int32_t task) {
    constexpr uint8_t kPersistent = 1; // ir::GlobalKind::Persistent
    const rt::GlobalDesc* data = present.findGlobal(name, module, task, !module.empty());
    return data && module.empty() && data->kind != kPersistent ? nullptr : data;
}

} // namespace

UnitLoader::UnitLoader(const Compilation& compilation, bool stepping, codegen::CodegenOptions options,
                       const std::vector<codegen::NativeSymbol>& natives)
    : compilation_(compilation), stepping_(stepping), options_(options), natives_(natives) {}

UnitLoader::~UnitLoader() = default;

/// The files of all tasks that are in program memory now.
std::vector<sema::TaskInput> UnitLoader::inputs(const rt::ProgramTables& present) const {
    std::vector<sema::TaskInput> result;
    for (size_t i = 0; i < compilation_.program->tasks.size(); ++i) {
        const sema::Task& task = *compilation_.program->tasks[i];
        const auto number = static_cast<int32_t>(i);
        const auto source =
            std::find_if(compilation_.tasks.begin(), compilation_.tasks.end(),
                         [&](const sema::TaskInput& input) { return input.name == task.name; });
        if (source == compilation_.tasks.end()) continue;
        std::set<std::string> erased; // files none of whose modules is left
        for (const sema::Module* module : task.modules)
            erased.insert(module->tree->source->path());
        for (const sema::Module* module : task.modules)
            if (present.findModule(number, module->name)) erased.erase(module->tree->source->path());
        sema::TaskInput& input = result.emplace_back(*source);
        input.incomplete = true; // what is missing may come later
        std::erase_if(input.files, [&](const File& file) { return erased.contains(file->path()); });
        for (const rt::LoadedModule& module : present.modules())
            if (const auto found = loaded_.find({number, module.file});
                module.unit && module.task == number && found != loaded_.end())
                input.files.push_back(found->second);
    }
    return result;
}

rt::LoadResult UnitLoader::make(const rt::LoadRequest& request, const rt::ProgramTables& present) {
    const std::string key = keyOf(request, present);
    if (compiled_.contains(key)) return reuse(key, request, present);
    rt::LoadResult result;
    if (units_.size() >= kMostUnits) {
        result.verdict = rt::LoadResult::Verdict::Full;
        return result;
    }
    onOwnStack([&] { result = compile(request, present); });
    if (result.verdict == rt::LoadResult::Verdict::Made)
        compiled_[key] = {result.module, result.unit, loaded_[{request.taskIndex, request.path}],
                          initialData(*result.unit, present)};
    return result;
}

/// The same module beside the same others: its data begin anew.
rt::LoadResult UnitLoader::reuse(const std::string& key, const rt::LoadRequest& request,
                                 const rt::ProgramTables& present) {
    const Compiled& compiled = compiled_.at(key);
    rt::LoadResult result;
    result.module = compiled.module;
    result.unit = compiled.unit;
    if (present.findModule(request.taskIndex, compiled.module)) {
        result.verdict = rt::LoadResult::Verdict::Loaded;
        return result;
    }
    result.verdict = rt::LoadResult::Verdict::Made;
    loaded_[{request.taskIndex, request.path}] = compiled.file;
    for (const auto& [address, bytes] : compiled.initial)
        std::memcpy(address, bytes.data(), bytes.size());
    return result;
}

rt::LoadResult UnitLoader::compile(const rt::LoadRequest& request, const rt::ProgramTables& present) {
    rt::LoadResult result;
    auto file = std::make_shared<const rapid::SourceFile>(request.shown, request.bytes);
    std::vector<sema::TaskInput> tasks = inputs(present);
    const auto input = std::find_if(tasks.begin(), tasks.end(),
                                    [&](const sema::TaskInput& task) { return task.name == request.task; });
    if (input == tasks.end()) {
        result.problems = "the task is not part of the program";
        return result;
    }
    if (file->isBinary()) {
        result.problems = request.shown + ": this is no text";
        return result;
    }
    std::erase_if(input->files, [&](const File& other) { return other->path() == file->path(); });
    input->files.push_back(file);
    sema::CheckOptions options = compilation_.options;
    options.requireMain = false;
    diag::Sink sink;
    const auto program = sema::check(tasks, options, sink);
    const sema::Task* task = findTask(*program, request.task);
    std::vector<const sema::Module*> modules;
    for (const sema::Module* module : task->modules)
        if (module->tree->source == file) modules.push_back(module);
    if (modules.size() == 1) {
        result.module = modules.front()->name;
        if (present.findModule(request.taskIndex, result.module)) {
            result.verdict = rt::LoadResult::Verdict::Loaded;
            return result;
        }
    }
    if (!sink.hasErrors() && modules.size() != 1) {
        result.problems = fmt::format("{}: found {} modules, expected one", request.shown, modules.size());
        return result;
    }
    ir::Module module;
    rapid::lower::UnitOptions unit;
    unit.program.programName = result.module;
    unit.program.stepping = stepping_;
    unit.program.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    unit.program.sharedModules = compilation_.sharedModules;
    unit.exists = [&](std::string_view moduleName, std::string_view name) {
        return findData(present, name, moduleName, request.taskIndex) != nullptr;
    };
    if (!sink.hasErrors()) {
        result.problems = unknownTypes(*modules.front());
        if (!result.problems.empty()) return result;
    }
    const bool lowered = !sink.hasErrors() &&
                         rapid::lower::lowerUnit(*program, static_cast<uint32_t>(request.taskIndex),
                                                 *modules.front(), unit, sink, module) &&
                         runIrPasses(module, stepping_, sink);
    if (!lowered) {
        result.problems = problemsOf(sink);
        return result;
    }
    if (generate(module, present, request.taskIndex, result))
        loaded_[{request.taskIndex, request.path}] = file;
    return result;
}

bool UnitLoader::generate(ir::Module& module, const rt::ProgramTables& present, int32_t taskIndex,
                          rt::LoadResult& result) {
    std::vector<codegen::NativeSymbol> symbols = natives_;
    for (const ir::Global& global : module.globals) {
        if (global.kind != ir::GlobalKind::External) continue;
        const bool anywhere = global.typeDesc != ir::kNone; // a persistent that others declare, too
        const rt::GlobalDesc* data =
            findData(present, global.displayName, anywhere ? "" : global.moduleName, taskIndex);
        if (!data) data = findData(present, global.displayName, "", taskIndex);
        if (data) symbols.push_back({global.name, data->address});
    }
    auto program = codegen::jit(module, options_, symbols, result.problems);
    if (!program) return false;
    result.unit = program->program();
    result.verdict = rt::LoadResult::Verdict::Made;
    units_.push_back(std::move(program));
    return true;
}

std::vector<std::string> UnitLoader::unresolved(const std::string& task, int32_t,
                                                const rt::ProgramTables& present) {
    std::vector<std::string> result;
    onOwnStack([&] { result = openReferences(task, present); });
    return result;
}

std::vector<std::string> UnitLoader::openReferences(const std::string& task,
                                                    const rt::ProgramTables& present) const {
    sema::CheckOptions options = compilation_.options;
    options.requireMain = false;
    diag::Sink sink;
    const std::vector<sema::TaskInput> tasks = inputs(present);
    const auto program = sema::check(tasks, options, sink);
    const sema::Task* wanted = findTask(*program, task);
    std::vector<std::string> result;
    for (const diag::Diagnostic& diagnostic : sink.sorted()) {
        if (diagnostic.code != diag::Code::MayBeDeclared || !diagnostic.file) continue;
        const bool own =
            std::any_of(wanted->modules.begin(), wanted->modules.end(),
                        [&](const sema::Module* module) { return module->tree->source == diagnostic.file; });
        if (!own) continue;
        const std::string_view name = diagnostic.file->text().substr(
            diagnostic.range.begin, diagnostic.range.end - diagnostic.range.begin);
        const std::filesystem::path path = diagnostic.file->path();
        result.push_back(fmt::format("'{}' ({}:{})", name, path.filename().string(),
                                     diagnostic.file->lineColumn(diagnostic.range.begin).line));
    }
    return result;
}

} // namespace rapidc
