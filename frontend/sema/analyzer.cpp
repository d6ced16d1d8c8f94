// check(): the library first, then each task: parse, collect names, resolve declarations, check bodies.

#include "frontend/sema/analyzer.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/sema/across_tasks.h"
#include "frontend/sema/collect.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/repeats.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/resolve_types.h"
#include "frontend/sema/routine.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include "frontend/syntax/parser.h"

#include <filesystem>

namespace rapid::sema {

using namespace syntax;

Analyzer::Analyzer(CheckedProgram& program, const CheckOptions& options, diag::Sink& sink)
    : state_(program, options, sink) {
    const auto make = [&](TypeKind kind, const char* name) {
        Type& type = state_.program.types.emplace_back();
        type.kind = kind;
        type.name = name;
        return &type;
    };
    state_.program.errorType = make(TypeKind::Error, "?");
    state_.program.num = make(TypeKind::Num, "num");
    state_.program.dnum = make(TypeKind::Dnum, "dnum");
    state_.program.boolean = make(TypeKind::Bool, "bool");
    state_.program.string = make(TypeKind::String, "string");
    state_.switchType = make(TypeKind::Switch, "switch");
    const Type* anyType = make(TypeKind::AnyType, "anytype");
    // Known even without a library; its declarations take these over.
    for (const Type* atomic : {state_.program.num, state_.program.dnum, state_.program.boolean,
                               state_.program.string, static_cast<const Type*>(state_.switchType), anyType}) {
        TypeSymbol& symbol = state_.program.typeSymbols.emplace_back();
        symbol.kind = SymbolKind::Type;
        symbol.progress = Progress::Done;
        symbol.name = atomic->name;
        symbol.nameId = state_.names.intern(atomic->name);
        symbol.predefined = true;
        symbol.type = const_cast<Type*>(atomic);
        put<Symbol>(state_.predefined, symbol.nameId, &symbol);
    }
}

void Analyzer::loadLibrary() {
    Task library;
    state_.task.task = &library;
    std::vector<std::pair<NameId, Symbol*>> atomics;
    for (NameId id = 0; id < state_.predefined.size(); ++id)
        if (state_.predefined[id]) atomics.emplace_back(id, std::exchange(state_.predefined[id], nullptr));
    for (const LibraryText& text : state_.options.library) {
        auto file = std::make_shared<const SourceFile>(std::string(text.name), std::string(text.text));
        ParseOptions parseOptions;
        parseOptions.declarations = true;
        state_.program.trees.push_back(parse(std::move(file), state_.sink, parseOptions));
        const SyntaxTree& tree = *state_.program.trees.back();
        FileFacts& facts = *state_.program.facts.emplace_back(std::make_unique<FileFacts>(
            tree, state_.program.errorType, std::make_shared<FileSymbols>(), ++state_.lastStamp));
        for (const ModuleDecl* decl : tree.modules)
            state_.program.predefinedModules.push_back(collector_.addModule(tree, *decl, true, facts));
    }
    for (Module* module : state_.program.predefinedModules)
        collector_.collect(*module);
    for (const auto& [id, atomic] : atomics) {
        Symbol* declared = at(state_.predefined, id);
        if (TypeSymbol* type = asType(declared))
            type->type = static_cast<TypeSymbol*>(atomic)->type;
        else
            put(state_.predefined, id, atomic);
    }
    for (Module* module : state_.program.predefinedModules)
        for (TypeSymbol* symbol : module->types) {
            const Type* type = types_.ensureType(*symbol);
            state_.program.known[static_cast<size_t>(type->known)] = type;
        }
    state_.program.known[static_cast<size_t>(KnownType::None)] = nullptr;
    for (Module* module : state_.program.predefinedModules)
        for (RoutineSymbol* routine : module->routines)
            types_.resolveSignature(*routine);
    for (Module* module : state_.program.predefinedModules) {
        for (DataSymbol* data : module->data)
            data_.ensureValue(*data);
        for (RoutineSymbol* routine : module->routines)
            routines_.checkRoutine(*routine);
    }
}

void Analyzer::setMissingModules(const TaskInput& input) {
    state_.task.missingModules = input.missingModules;
    for (const auto& file : input.files) // what a file declares that cannot be read is not known
        if (file->isBinary())
            state_.task.missingModules.push_back(std::filesystem::path(file->path()).filename().string());
    state_.task.bindsLate = input.bindsLate;
    state_.task.incomplete = input.incomplete || input.bindsLate ||
                             state_.task.missingModules.size() > input.missingModules.size();
}

void Analyzer::startTask(const TaskInput& input) {
    state_.program.tasks.push_back(std::make_unique<Task>());
    state_.task = {};
    state_.task.task = state_.program.tasks.back().get();
    state_.task.task->name = input.name;
    state_.task.task->type = input.type;
    state_.task.task->entry = input.entry;
    setMissingModules(input);
    state_.task.task->incomplete = state_.task.incomplete;
    clearLooseEnds();
    scopes_.declareConfiguration();
}

void Analyzer::readFiles(const TaskInput& input, bool declare) {
    std::unordered_set<std::string_view> paths;
    for (const auto& file : input.files) {
        if (!paths.insert(file->path()).second) {
            state_.sink.report(say::SameFileTwice, nullptr, {}, {file->path()});
            continue;
        }
        readFile(file);
        if (declare) collector_.declareModules(state_.task.files.back().modules);
    }
}

void Analyzer::readFile(const std::shared_ptr<const SourceFile>& file) {
    const size_t errorsBefore = state_.sink.errorCount();
    ParseOptions parseOptions;
    parseOptions.wholeAggregates = state_.options.onlyDiagnostics;
    state_.program.trees.push_back(parse(file, state_.sink, parseOptions));
    const SyntaxTree& tree = *state_.program.trees.back();
    FileFacts& facts = *state_.program.facts.emplace_back(std::make_unique<FileFacts>(
        tree, state_.program.errorType, std::make_shared<FileSymbols>(), ++state_.lastStamp));
    TaskFile& entry = state_.task.files.emplace_back();
    entry.slot = state_.program.trees.size() - 1;
    entry.broken = state_.sink.errorCount() > errorsBefore;
    if (entry.broken) state_.task.brokenTrees.push_back(&tree);
    for (const ModuleDecl* decl : tree.modules) {
        entry.modules.push_back(collector_.addModule(tree, *decl, false, facts));
        state_.task.task->modules.push_back(entry.modules.back());
    }
}

void Analyzer::checkTask(const TaskInput& input) {
    startTask(input);
    readFiles(input, true);
    collector_.checkModuleNames(state_.task.task->modules);
    if (leaveOut(input)) return;
    checkModules(state_.task.task->modules);
    finishTask();
}

void Analyzer::checkFiles() {
    collector_.declareModules(state_.task.task->modules);
    collector_.checkModuleNames(state_.task.task->modules);
    checkModules(state_.task.task->modules);
}

void Analyzer::resolveDeclarations(std::span<Module* const> modules) {
    for (Module* module : modules)
        for (TypeSymbol* type : module->types)
            types_.ensureType(*type);
    for (Module* module : modules)
        for (RoutineSymbol* routine : module->routines)
            types_.resolveSignature(*routine);
}

void Analyzer::checkModules(std::span<Module* const> modules) {
    resolveDeclarations(modules);
    TaskContext& task = state_.task;
    task.isLoose =
        task.comparisonsLeft + task.elsewhere.comparisons != kMaxComparisons || !task.unknownNames.empty();
    // File by file: what concerns one of them stays in the cache.
    for (size_t first = 0, end = 0; first < modules.size(); first = end) {
        const size_t said = state_.sink.all().size();
        const size_t left = task.comparisonsLeft, known = task.earlierUnknownNames.size();
        for (; end < modules.size() && modules[end]->facts == modules[first]->facts; ++end) {
            state_.enterModule(modules[end]);
            for (DataSymbol* data : modules[end]->data)
                data_.ensureValue(*data);
            for (RoutineSymbol* routine : modules[end]->routines)
                routines_.checkRoutine(*routine);
        }
        finishFile(modules.subspan(first, end - first), said);
        modules[first]->facts->spent = {left - task.comparisonsLeft, task.earlierUnknownNames.size() - known};
        task.isLoose |= !task.unknownNames.empty();
    }
    repeats_.mergeCauses();
}

void Analyzer::finishFile(std::span<Module* const> modules, size_t said) {
    if (!state_.task.unknownNames.empty()) repeats_.gatherUnknown(modules);
    repeats_.gatherRepeats(modules, said);
    state_.reports.forgetMisfits();
    if (state_.options.onFile) state_.options.onFile(state_.program, *state_.task.task, modules);
    if (!state_.options.onlyDiagnostics) return;
    for (Module* module : modules)
        for (RoutineSymbol* routine : module->routines)
            routine->data = {};
    modules.front()->facts->dropInner();
}

void Analyzer::finishTask() {
    listSignals();
    entry_.checkEntry(*state_.task.task);
}

// Configured objects that the task names, in the order of its files.
void Analyzer::listSignals() {
    for (DataSymbol* signal : state_.task.task->signals)
        signal->module = nullptr;
    state_.task.task->signals.clear();
    for (const TaskFile& file : state_.task.files) {
        for (const auto& [signal, token] : state_.program.facts[file.slot]->signals) {
            if (signal->module) continue;
            signal->module = file.modules.front(); // where it is named first
            signal->nameToken = token;
            state_.task.task->signals.push_back(signal);
        }
    }
}

// A task that may lack its entry routine, and does, is not part of the program: nothing else in it is checked.
bool Analyzer::leaveOut(const TaskInput& input) {
    if (!state_.options.requireMain || !input.optional ||
        at(state_.task.globals, state_.names.intern(input.entry)))
        return false;
    state_.sink.report(say::TaskLeftOut, nullptr, {},
                       {input.name, "none of its modules that can be read declares its entry routine '" +
                                        input.entry + "'"});
    state_.program.tasks.pop_back();
    state_.task.task = nullptr;
    return true;
}

TaskComparison::TaskComparison(State& state) : CheckerPart(state) {}

std::unique_ptr<CheckedProgram> check(const std::vector<TaskInput>& tasks, const CheckOptions& options,
                                      diag::Sink& sink) {
    auto program = std::make_unique<CheckedProgram>();
    Analyzer analyzer(*program, options, sink);
    analyzer.loadLibrary();
    std::vector<std::string> names;
    for (const TaskInput& task : tasks)
        names.push_back(task.name);
    analyzer.setTaskNames(std::move(names));
    for (const TaskInput& task : tasks)
        analyzer.checkTask(task);
    analyzer.checkAcrossTasks();
    return program;
}

} // namespace rapid::sema
