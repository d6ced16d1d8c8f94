// check(): the library first, then each task: parse, collect names, resolve declarations, check bodies.

#include "frontend/sema/analysis.h"

#include "frontend/syntax/parser.h"

#include <map>

namespace rapid::sema {

using namespace syntax;

Analyzer::Analyzer(CheckedProgram& program, const CheckOptions& options, diag::Sink& sink)
    : program_(program), options_(options), sink_(sink) {
    const auto make = [&](TypeKind kind, const char* name) {
        Type& type = program_.types.emplace_back();
        type.kind = kind;
        type.name = name;
        return &type;
    };
    program_.errorType = make(TypeKind::Error, "?");
    program_.num = make(TypeKind::Num, "num");
    program_.dnum = make(TypeKind::Dnum, "dnum");
    program_.boolean = make(TypeKind::Bool, "bool");
    program_.string = make(TypeKind::String, "string");
    switchType_ = make(TypeKind::Switch, "switch");
    anyType_ = make(TypeKind::AnyType, "anytype");
    // Known even without a library; its declarations take these over.
    for (const Type* atomic : {program_.num, program_.dnum, program_.boolean, program_.string,
                               static_cast<const Type*>(switchType_), static_cast<const Type*>(anyType_)}) {
        TypeSymbol& symbol = program_.typeSymbols.emplace_back();
        symbol.kind = SymbolKind::Type;
        symbol.progress = Progress::Done;
        symbol.name = atomic->name;
        symbol.nameId = interner_.intern(atomic->name);
        symbol.predefined = true;
        symbol.type = const_cast<Type*>(atomic);
        put<Symbol>(predefined_, symbol.nameId, &symbol);
    }
}

void Analyzer::loadLibrary() {
    Task library;
    task_ = &library;
    std::vector<std::pair<NameId, Symbol*>> atomics;
    for (NameId id = 0; id < predefined_.size(); ++id)
        if (predefined_[id]) atomics.emplace_back(id, std::exchange(predefined_[id], nullptr));
    for (const LibraryText& text : options_.library) {
        auto file = std::make_shared<const SourceFile>(std::string(text.name), std::string(text.text));
        ParseOptions parseOptions;
        parseOptions.declarations = true;
        program_.trees.push_back(parse(std::move(file), sink_, parseOptions));
        const SyntaxTree& tree = *program_.trees.back();
        FileFacts& facts = *program_.facts.emplace_back(std::make_unique<FileFacts>(
            tree, program_.errorType, std::make_shared<FileSymbols>(), ++lastStamp_));
        for (const ModuleDecl* decl : tree.modules)
            program_.predefinedModules.push_back(addModule(tree, *decl, true, facts));
    }
    for (Module* module : program_.predefinedModules)
        collect(*module);
    for (const auto& [id, atomic] : atomics) {
        Symbol* declared = at(predefined_, id);
        if (TypeSymbol* type = asType(declared))
            type->type = static_cast<TypeSymbol*>(atomic)->type;
        else
            put(predefined_, id, atomic);
    }
    for (Module* module : program_.predefinedModules)
        for (TypeSymbol* type : module->types)
            ensureType(*type);
    const auto typeNamed = [&](const char* name) -> const Type* {
        const TypeSymbol* symbol = asType(at(predefined_, interner_.intern(name)));
        return symbol ? symbol->type->base() : nullptr;
    };
    program_.pos = typeNamed("pos");
    program_.orient = typeNamed("orient");
    if (const TypeSymbol* symbol = asType(at(predefined_, interner_.intern("intnum"))))
        intnum_ = symbol->type;
    for (Module* module : program_.predefinedModules)
        for (RoutineSymbol* routine : module->routines)
            resolveSignature(*routine);
    for (Module* module : program_.predefinedModules) {
        for (DataSymbol* data : module->data)
            ensureValue(*data);
        for (RoutineSymbol* routine : module->routines)
            checkRoutine(*routine);
    }
}

void Analyzer::startTask(const TaskInput& input) {
    program_.tasks.push_back(std::make_unique<Task>());
    task_ = program_.tasks.back().get();
    task_->name = input.name;
    task_->type = input.type;
    task_->entry = input.entry;
    globals_.assign(globals_.size(), nullptr);
    configured_.assign(configured_.size(), nullptr);
    moduleNames_ = {};
    files_.clear();
    assumed_.clear();
    spareAssumed_.clear();
    entangled_ = false;
    setMissingModules(input);
    task_->incomplete = incomplete_;
    clearLooseEnds();
    declareConfiguration();
}

void Analyzer::readFiles(const TaskInput& input, bool declare) {
    std::unordered_set<std::string_view> paths;
    for (const auto& file : input.files) {
        if (!paths.insert(file->path()).second) {
            sink_.report(Code::SameFileTwice, nullptr, {}, {file->path()});
            continue;
        }
        readFile(file);
        if (declare) declareModules(files_.back().modules);
    }
}

void Analyzer::readFile(const std::shared_ptr<const SourceFile>& file) {
    const size_t errorsBefore = sink_.errorCount();
    ParseOptions parseOptions;
    parseOptions.wholeAggregates = options_.onlyDiagnostics;
    program_.trees.push_back(parse(file, sink_, parseOptions));
    const SyntaxTree& tree = *program_.trees.back();
    FileFacts& facts = *program_.facts.emplace_back(
        std::make_unique<FileFacts>(tree, program_.errorType, std::make_shared<FileSymbols>(), ++lastStamp_));
    TaskFile& entry = files_.emplace_back();
    entry.slot = program_.trees.size() - 1;
    entry.broken = sink_.errorCount() > errorsBefore;
    if (entry.broken) brokenTrees_.push_back(&tree);
    for (const ModuleDecl* decl : tree.modules) {
        entry.modules.push_back(addModule(tree, *decl, false, facts));
        task_->modules.push_back(entry.modules.back());
    }
}

void Analyzer::declareModules(std::span<Module* const> modules) {
    for (Module* module : modules) {
        enterModule(module);
        const NameId name = interner_.intern(module->name);
        Module* other = moduleNames_.find(name);
        duplicateModule_ = other != nullptr;
        if (other) {
            entangled_ = true;
            auto& d = report(Code::DuplicateModule, range(module->decl->name), {module->name});
            d.notes.push_back({other->tree->source, other->tree->range(other->decl->name),
                               "'" + other->name + "' is declared here"});
        } else if (!module->name.empty()) {
            moduleNames_.set(name, module);
        }
        collect(*module);
    }
    duplicateModule_ = false;
}

void Analyzer::checkTask(const TaskInput& input) {
    startTask(input);
    readFiles(input, true);
    checkModuleNames(task_->modules);
    if (leaveOut(input)) return;
    checkModules(task_->modules);
    finishTask();
}

void Analyzer::checkFiles() {
    declareModules(task_->modules);
    checkModuleNames(task_->modules);
    checkModules(task_->modules);
}

void Analyzer::checkModules(std::span<Module* const> modules) {
    for (Module* module : modules)
        for (TypeSymbol* type : module->types)
            ensureType(*type);
    for (Module* module : modules)
        for (RoutineSymbol* routine : module->routines)
            resolveSignature(*routine);
    // File by file: what concerns one of them stays in the cache.
    for (size_t first = 0, end = 0; first < modules.size(); first = end) {
        const size_t said = sink_.all().size();
        for (; end < modules.size() && modules[end]->facts == modules[first]->facts; ++end) {
            enterModule(modules[end]);
            for (DataSymbol* data : modules[end]->data)
                ensureValue(*data);
            for (RoutineSymbol* routine : modules[end]->routines)
                checkRoutine(*routine);
        }
        finishFile(modules.subspan(first, end - first), said);
    }
    tellOnce();
}

void Analyzer::finishFile(std::span<Module* const> modules, size_t said) {
    if (!unknownNames_.empty()) gatherUnknown(modules);
    gatherRepeats(modules, said);
    if (options_.onFile) options_.onFile(program_, *task_, modules);
    if (!options_.onlyDiagnostics) return;
    for (Module* module : modules)
        for (RoutineSymbol* routine : module->routines)
            routine->data = {};
    modules.front()->facts->dropInner();
}

void Analyzer::finishTask() {
    listSignals();
    checkEntry(*task_);
}

// Configured objects that the task names, in the order of its files.
void Analyzer::listSignals() {
    for (DataSymbol* signal : task_->signals)
        signal->module = nullptr;
    task_->signals.clear();
    for (const TaskFile& file : files_) {
        for (const auto& [signal, token] : program_.facts[file.slot]->signals) {
            if (signal->module) continue;
            signal->module = file.modules.front(); // where it is named first
            signal->nameToken = token;
            task_->signals.push_back(signal);
        }
    }
}

// Whether the file refers to the symbol for the first time.
bool Analyzer::markUsed(Symbol& symbol) {
    FileFacts& file = facts();
    if (std::exchange(symbol.lastUser, file.stamp) == file.stamp) return false;
    symbol.used = true;
    ++symbol.users;
    file.used.push_back(&symbol);
    return true;
}

void Analyzer::markAssigned(DataSymbol& symbol) {
    FileFacts& file = facts();
    if (std::exchange(symbol.lastWriter, file.stamp) == file.stamp) return;
    symbol.assigned = true;
    ++symbol.writers;
    file.assigned.push_back(&symbol);
}

// A LOCAL routine with the name of the entry. Only of a program that is to run, or in which everything else is known:
// modules that a part of a program consists of may have a LOCAL main of their own, called by name from elsewhere.
const Symbol* Analyzer::localEntry(const Task& task, NameId name) {
    const Symbol* local = nullptr;
    for (size_t i = 0; i < task.modules.size() && !local; ++i)
        local = scopes_[task.modules[i]->id]->names.find(name);
    if (!local || options_.requireMain) return local;
    const auto isOpen = [](const Module* module) {
        const auto& tokens = module->tree->tokens;
        return module->facts->open || std::any_of(tokens.begin(), tokens.end(), [](const Token& t) {
                   return t.kind == TokenKind::Percent; // a call by name
               });
    };
    const bool part =
        incomplete_ || local->used || std::any_of(task.modules.begin(), task.modules.end(), isOpen);
    return part ? nullptr : local;
}

void Analyzer::checkEntry(Task& task) {
    const NameId name = interner_.intern(task.entry);
    Symbol* symbol = at(globals_, name);
    RoutineSymbol* routine = asRoutine(symbol);
    const bool procedure = routine && routine->routineKind == RoutineKind::Proc;
    if (procedure && nextRequired(*routine, 0) >= routine->params.size()) {
        task.entryRoutine = routine;
        ++routine->users;
        routine->used = true;
        return;
    }
    if (symbol) { // what is no procedure, or wants arguments, can be the entry of no task
        enterModule(symbol->module);
        std::string found = procedure ? "a procedure with required parameters" : describe(*symbol);
        report(Code::EntryNotProcedure, range(symbol->nameToken), {symbol->name, std::move(found)});
        return;
    }
    if (const Symbol* local = localEntry(task, name)) {
        enterModule(local->module);
        report(Code::EntryLocal, range(local->nameToken), {task.name, local->name});
        return;
    }
    if (!options_.requireMain) return;
    if (incomplete_ || !mayReportUnknown(name)) return;
    if (task.modules.empty()) { // why there is none has been told as a rule
        if (!sink_.hasErrors()) sink_.report(Code::NoEntry, nullptr, {}, {task.name, task.entry});
        return;
    }
    const ModuleDecl& first = *task.modules.front()->decl;
    enterModule(task.modules.front());
    report(Code::NoEntry, range(first.name == kNoToken ? first.first : first.name), {task.name, task.entry});
}

// A task that may lack its entry routine, and does, is no part of the program; nothing else in it is judged.
bool Analyzer::leaveOut(const TaskInput& input) {
    if (!options_.requireMain || !input.optional || at(globals_, interner_.intern(input.entry))) return false;
    sink_.report(Code::TaskLeftOut, nullptr, {},
                 {input.name,
                  "none of its modules that can be read declares its entry routine '" + input.entry + "'"});
    program_.tasks.pop_back();
    task_ = nullptr;
    return true;
}

// Each task has types of its own: they are the same when their names and components are.
bool Analyzer::sameStructure(const Type& left, const Type& right) {
    const Type &a = *left.base(), &b = *right.base();
    if (&a == &b || a.kind == TypeKind::Error || b.kind == TypeKind::Error) return true;
    if (a.kind != b.kind || interner_.intern(a.name) != interner_.intern(b.name) ||
        a.components.size() != b.components.size())
        return false;
    for (size_t i = 0; i < a.components.size(); ++i)
        if (interner_.intern(a.components[i].name) != interner_.intern(b.components[i].name) ||
            !sameStructure(*a.components[i].type, *b.components[i].type))
            return false;
    return true;
}

namespace {
/// Names of components, but of long records only some, from the first that is different.
std::string componentNames(const Type& record, size_t different) {
    constexpr size_t kShown = 6;
    const size_t count = record.components.size();
    const size_t begin = count <= kShown ? 0 : std::min(different, count - kShown);
    std::string all = begin > 0 ? "..." : "";
    for (size_t i = begin; i < std::min(count, begin + kShown); ++i)
        all += (all.empty() ? "" : ", ") + record.components[i].name;
    return all + (begin + kShown < count ? ", ..." : "");
}
} // namespace

// What is different in two types of one name: "place.x is num" and "place.x is dnum", or the names of the components.
std::pair<std::string, std::string> Analyzer::difference(const Type& left, const Type& right,
                                                         const std::string& where) {
    const Type &a = *left.base(), &b = *right.base();
    const std::string what = where.empty() ? std::string() : where + " is ";
    if (interner_.intern(a.name) != interner_.intern(b.name)) return {what + a.name, what + b.name};
    size_t i = 0;
    for (; i < std::min(a.components.size(), b.components.size()); ++i) {
        if (interner_.intern(a.components[i].name) != interner_.intern(b.components[i].name)) break;
        if (!sameStructure(*a.components[i].type, *b.components[i].type))
            return difference(*a.components[i].type, *b.components[i].type,
                              (where.empty() ? std::string() : where + ".") + a.components[i].name);
    }
    return {what + componentNames(a, i), what + componentNames(b, i)};
}

// The data of a module that is installed shared are one and the same for all tasks (manual 1.2.2).
void Analyzer::checkSharedModules() {
    if (options_.sharedModules.empty() || program_.tasks.size() < 2) return;
    std::map<std::pair<std::string, NameId>, const DataSymbol*> known; // module and name
    for (const auto& task : program_.tasks) {
        for (Module* module : task->modules) {
            const std::string name = foldName(module->name);
            if (!options_.sharedModules.contains(name)) continue;
            for (DataSymbol* data : module->data) {
                const bool everywhere = data->dataKind == DataKind::Pers && data->scope == ScopeWord::None;
                if (data->dataKind == DataKind::Const || data->scope == ScopeWord::Task || everywhere)
                    continue;
                const auto [first, isNew] = known.try_emplace({name, data->nameId}, data);
                const DataSymbol& other = *first->second;
                if (isNew ||
                    (sameShape(data->type, other.type) && sameStructure(*data->type.type, *other.type.type)))
                    continue;
                enterModule(module);
                noteDeclared(
                    report(Code::SharedDataConflict, range(data->nameToken), {data->name, module->name}),
                    other);
            }
        }
    }
}

// A global persistent is one object for all tasks that declare it (manual 1.20).
void Analyzer::checkShared(const DataSymbol& data, const DataSymbol& other, DifferentRecords& told) {
    const bool sameTypes = sameStructure(*data.type.type, *other.type.type);
    if (sameTypes && sameShape(data.type, other.type)) return;
    std::string own = typeName(data.type), theirs = typeName(other.type);
    if (own == theirs) { // records of one name
        if (!told.insert({data.type.type->base(), other.type.type->base()}).second) return;
        const auto [mine, yours] = difference(*data.type.type, *other.type.type, "");
        own += " (" + mine + ")";
        theirs += " (" + yours + ")";
    }
    enterModule(data.module);
    noteDeclared(
        report(Code::PersConflict, range(data.nameToken), {data.name, std::move(own), std::move(theirs)}),
        other);
}

void Analyzer::checkAcrossTasks() {
    constexpr size_t kMaxTasks = 20; // manual 1.20
    if (program_.tasks.size() > kMaxTasks)
        sink_.report(Code::TooManyTasks, nullptr, {}, {std::to_string(program_.tasks.size())});
    checkSharedModules();
    NameMap<DataSymbol> shared;
    NameMap<const Task> names;
    DifferentRecords told;
    const bool several = program_.tasks.size() > 1; // the names of one task are judged already
    for (const auto& task : program_.tasks) {
        const NameId taskName = interner_.intern(task->name);
        if (names.find(taskName)) sink_.report(Code::DuplicateTask, nullptr, {}, {task->name});
        names.set(taskName, task.get());
        for (Module* module : task->modules) {
            for (DataSymbol* data : several ? module->persistents : std::vector<DataSymbol*>()) {
                DataSymbol* other = shared.find(data->nameId);
                if (!other) {
                    shared.set(data->nameId, data);
                    continue;
                }
                checkShared(*data, *other, told);
            }
        }
    }
}

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
