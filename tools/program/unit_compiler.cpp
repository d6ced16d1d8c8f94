#include "tools/program/unit_compiler.h"

#include "frontend/diag/messages/names.h"
#include "ir/lower/lower.h"
#include "runtime/program/program_tables.h"
#include "stdlib/native_table.h"
#include "tools/program/constant_calls.h"
#include "tools/program/native_library.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc {

namespace sema = rapid::sema;
namespace diag = rapid::diag;

namespace {

using File = std::shared_ptr<const rapid::SourceFile>;

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

} // namespace

/// The files of all tasks that are in program memory now.
std::vector<sema::TaskInput> SourceCompiler::inputs(const rt::ProgramState& state) const {
    std::vector<sema::TaskInput> result;
    for (size_t i = 0; i < sources_.tasks.size(); ++i) {
        const ProgramSources::Task& task = sources_.tasks[i];
        const auto number = static_cast<int32_t>(i);
        sema::TaskInput& input = result.emplace_back(task.input);
        input.incomplete = true; // what is missing may come later
        input.files.clear();
        for (size_t k = 0; k < task.input.files.size(); ++k) {
            const auto& names = task.modules[k];
            const bool erased =
                !names.empty() && std::none_of(names.begin(), names.end(), [&](const std::string& name) {
                    const rt::LoadedModule* module = state.tables.findModule(number, name);
                    return module != nullptr && module->unit == nullptr;
                });
            if (!erased) input.files.push_back(task.input.files[k]);
        }
        for (const rt::LoadedModule& module : state.tables.modules())
            for (const rt::LoadedFile& file : state.files)
                if (module.unit && module.task == number && file.task == number && file.path == module.file)
                    input.files.push_back(std::make_shared<const rapid::SourceFile>(file.shown, file.bytes));
    }
    return result;
}

rt::CompiledUnit SourceCompiler::compile(const rt::LoadRequest& request, const rt::ProgramState& state) {
    rt::CompiledUnit result;
    const auto file = std::make_shared<const rapid::SourceFile>(request.shown, request.bytes);
    std::vector<sema::TaskInput> tasks = inputs(state);
    const auto input = std::find_if(tasks.begin(), tasks.end(),
                                    [&](const sema::TaskInput& task) { return task.name == request.task; });
    if (input == tasks.end()) {
        result.problems = "the task is not part of the program";
        return result;
    }
    if (file->isBinary()) {
        result.problems = request.shown + ": this is not text";
        return result;
    }
    std::erase_if(input->files, [&](const File& other) { return other->path() == file->path(); });
    input->files.push_back(file);
    sema::CheckOptions options = sources_.options;
    options.requireMain = false;
    diag::Sink sink;
    const auto program = sema::check(tasks, options, sink);
    const sema::Task* task = findTask(*program, request.task);
    std::vector<const sema::Module*> modules;
    for (const sema::Module* module : task->modules)
        if (module->tree->source == file) modules.push_back(module);
    if (modules.size() == 1) {
        result.module = modules.front()->name;
        if (state.tables.findModule(request.taskIndex, result.module)) {
            result.verdict = rt::LoadResult::Verdict::Loaded;
            return result;
        }
    }
    if (sink.hasErrors())
        result.problems = problemsOf(sink);
    else if (modules.size() != 1)
        result.problems = fmt::format("{}: found {} modules, expected one", request.shown, modules.size());
    else
        result.problems = unknownTypes(*modules.front());
    if (result.problems.empty() && generate(*program, *modules.front(), request, state, result))
        result.verdict = rt::LoadResult::Verdict::Made;
    return result;
}

bool SourceCompiler::generate(const sema::CheckedProgram& program, const sema::Module& module,
                              const rt::LoadRequest& request, const rt::ProgramState& state,
                              rt::CompiledUnit& result) {
    rapid::lower::UnitOptions unit;
    unit.program.programName = result.module;
    unit.program.stepping = sources_.stepping;
    unit.program.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    unit.program.evaluate = constantCalls();
    unit.program.sharedModules = sources_.sharedModules;
    unit.exists = [&](std::string_view moduleName, std::string_view name) {
        return rt::findUnitData(state.tables, name, moduleName, request.taskIndex) != nullptr;
    };
    ir::Module made;
    diag::Sink sink;
    if (!rapid::lower::lowerUnit(program, static_cast<uint32_t>(request.taskIndex), module, unit, sink,
                                 made) ||
        !runIrPasses(made, {.profile = sources_.stepping ? ir::Profile::Stepping : ir::Profile::Release},
                     sink)) {
        result.problems = problemsOf(sink);
        return false;
    }
    for (const ir::Global& global : made.globals)
        if (global.kind == ir::GlobalKind::External) {
            const bool anywhere = global.typeDesc != ir::kNone; // a persistent that others declare, too
            result.data.push_back({global.name, global.displayName, anywhere ? "" : global.moduleName});
        }
    return codegen::emitImage(made, codegenOptions(sources_.optimise), result.image, result.problems);
}

rt::OpenReferences SourceCompiler::unresolved(const std::string& task, const rt::ProgramState& state) {
    sema::CheckOptions options = sources_.options;
    options.requireMain = false;
    diag::Sink sink;
    const std::vector<sema::TaskInput> tasks = inputs(state);
    const auto program = sema::check(tasks, options, sink);
    const sema::Task* wanted = findTask(*program, task);
    rt::OpenReferences result;
    for (const diag::Diagnostic& diagnostic : sink.sorted()) {
        if (diagnostic.code != diag::say::MayBeDeclared.code || !diagnostic.file) continue;
        const bool own =
            std::any_of(wanted->modules.begin(), wanted->modules.end(),
                        [&](const sema::Module* module) { return module->tree->source == diagnostic.file; });
        if (!own) continue;
        const std::string_view name = diagnostic.file->text().substr(
            diagnostic.range.begin, diagnostic.range.end - diagnostic.range.begin);
        const std::filesystem::path path = diagnostic.file->path();
        result.names.push_back(fmt::format("'{}' ({}:{})", name, path.filename().string(),
                                           diagnostic.file->lineColumn(diagnostic.range.begin).line));
    }
    return result;
}

} // namespace rapidc
