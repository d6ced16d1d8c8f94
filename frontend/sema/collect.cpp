// Declares the names of modules: modules themselves, types, data, routines (manual 1.1.3, 1.1.5, 1.2.2).

#include "frontend/sema/collect.h"
#include "frontend/diag/messages/names.h"

namespace rapid::sema {

using namespace syntax;

namespace {

/// RobotStudio writes the modules of each task into a folder of its name: given as one program, they are twins.
std::string remedyOfTwins(const SourceFile& one, const SourceFile& other) {
    const auto folderOf = [](const std::string& path) { return path.substr(0, path.rfind('/') + 1); };
    if (folderOf(one.path()) == folderOf(other.path())) return {};
    return ": if each folder is the program of a task, give --task=NAME=FOLDER for each";
}

} // namespace

Collector::Collector(State& state) : CheckerPart(state) {}

Module* Collector::addModule(const SyntaxTree& tree, const ModuleDecl& decl, bool predefined,
                             FileFacts& facts) {
    auto owned = std::make_unique<Module>();
    Module* module = owned.get();
    module->name = std::string(tree.text(decl.name));
    module->id = static_cast<uint32_t>(program_.moduleStore.size());
    module->tree = &tree;
    module->decl = &decl;
    module->predefined = predefined;
    module->facts = &facts;
    module->exprs = &facts.exprs;
    program_.moduleStore.push_back(std::move(owned));
    state_.scopes.push_back(std::make_unique<ModuleScope>());
    return module;
}

DataSymbol& Collector::newData(const DataDecl& decl) {
    DataSymbol& symbol =
        fill(context_.routine ? facts().locals.emplace_back()
                              : recycled(facts().symbols->dataSymbols, SymbolKind::Data, decl.name),
             SymbolKind::Data, decl, decl.name, decl.scope == ScopeWord::Local);
    symbol.dataKind = decl.dataKind;
    symbol.scope = decl.scope;
    symbol.init = decl.init;
    symbol.routine = context_.routine;
    symbol.storage = context_.routine ? Storage::RoutineData : Storage::ModuleData;
    return symbol;
}

RoutineSymbol& Collector::newRoutine(const RoutineDecl& decl) {
    RoutineSymbol& symbol = fill(recycled(facts().symbols->routineSymbols, SymbolKind::Routine, decl.name),
                                 SymbolKind::Routine, decl, decl.name, decl.local);
    symbol.routineKind = decl.routineKind;
    symbol.routineDecl = &decl;
    symbol.native = !decl.hasBody;
    symbol.noStepIn = (context_.module->decl->attributes & (kAttrNostepin | kAttrNoview)) != 0;
    return symbol;
}

TypeSymbol& Collector::newType(const Decl& decl, TokenIndex name, bool local) {
    return fill(recycled(facts().symbols->typeSymbols, SymbolKind::Type, name), SymbolKind::Type, decl, name,
                local);
}

void Collector::collect(Module& module) {
    state_.enterModule(&module);
    ModuleScope& scope = *state_.scopes[module.id];
    const std::span<Decl* const> decls = module.decl->decls;
    if (module.decl->name != kNoToken) notePlaceholders(module.decl->name, module.decl->name);
    for (size_t i = 0; i < decls.size(); ++i) {
        constexpr size_t kAhead = 8;
        if (i + kAhead < decls.size() && decls[i + kAhead]->kind == NodeKind::Data)
            names_.expect(context_.tree->text(as<DataDecl>(*decls[i + kAhead]).name));
        const Decl* decl = decls[i];
        if (decl->kind != NodeKind::Routine || !isName(as<RoutineDecl>(*decl).name))
            notePlaceholders(decl->first, decl->last);
        switch (decl->kind) {
        case NodeKind::Record:
        case NodeKind::Alias: {
            const bool record = decl->kind == NodeKind::Record;
            const TokenIndex name = record ? as<RecordDecl>(*decl).name : as<AliasDecl>(*decl).name;
            if (!isName(name)) break;
            TypeSymbol& symbol =
                newType(*decl, name, record ? as<RecordDecl>(*decl).local : as<AliasDecl>(*decl).local);
            module.types.push_back(&symbol);
            declareInModule(symbol, scope);
            break;
        }
        case NodeKind::Data: {
            const auto& data = as<DataDecl>(*decl);
            if (!isName(data.name)) break;
            DataSymbol& symbol = newData(data);
            symbol.index = static_cast<uint32_t>(module.data.size());
            module.data.push_back(&symbol);
            if (data.dataKind == DataKind::Pers && data.scope == ScopeWord::None)
                module.persistents.push_back(&symbol);
            declareInModule(symbol, scope);
            break;
        }
        case NodeKind::Routine: {
            const auto& routine = as<RoutineDecl>(*decl);
            if (!isName(routine.name)) break;
            RoutineSymbol& symbol = newRoutine(routine);
            module.routines.push_back(&symbol);
            declareInModule(symbol, scope);
            break;
        }
        default: break;
        }
    }
}

void Collector::declareInModule(Symbol& symbol, ModuleScope& scope) {
    if (const Symbol* other = scope.names.find(symbol.nameId)) {
        noteDeclared(
            report(say::DuplicateInModule, range(symbol.nameToken), {symbol.name, symbol.module->name}),
            *other);
        return;
    }
    scope.names.set(symbol.nameId, &symbol);
    if (symbol.isLocal) return;
    std::vector<Symbol*>& table = symbol.predefined ? state_.predefined : task_.globals;
    if (const Symbol* other = at(table, symbol.nameId)) {
        if (duplicateModule_) return;
        noteDeclared(
            report(say::DuplicateGlobal, range(symbol.nameToken), {symbol.name, other->module->name}),
            *other);
        return;
    }
    put(table, symbol.nameId, &symbol);
}

// A module must not have the name of global data or of a global routine (manual 1.1.3), nor of a global data type.
void Collector::checkModuleNames(std::span<Module* const> modules) {
    for (Module* module : modules) {
        state_.enterModule(module);
        const auto check = [&](const Symbol& symbol, const char* what) {
            if (symbol.isLocal || !task_.moduleNames.find(symbol.nameId)) return;
            report(say::NameOfModule, range(symbol.nameToken), {symbol.name, what});
        };
        for (const TypeSymbol* type : module->types)
            check(*type, "data type");
        for (const DataSymbol* data : module->data)
            check(*data, "data");
        for (const RoutineSymbol* routine : module->routines)
            check(*routine, "routine");
    }
}

void Collector::declareModules(std::span<Module* const> modules) {
    for (Module* module : modules) {
        state_.enterModule(module);
        const NameId name = names_.intern(module->name);
        Module* other = task_.moduleNames.find(name);
        duplicateModule_ = other != nullptr;
        if (other) {
            task_.dependsOnOrder = true;
            auto& d = report(say::DuplicateModule, range(module->decl->name),
                             {module->name, remedyOfTwins(*other->tree->source, *module->tree->source)});
            d.notes.push_back({other->tree->source, other->tree->range(other->decl->name),
                               "'" + other->name + "' is declared here"});
        } else if (!module->name.empty()) {
            task_.moduleNames.set(name, module);
        }
        collect(*module);
    }
    duplicateModule_ = false;
}

void Collector::collectAgain(Module& module, const NameMap<Symbol>& earlier) {
    earlier_ = &earlier;
    collect(module);
    earlier_ = nullptr;
}

// The symbol that other files refer to since an earlier check, emptied, or a new one.
template <class S> S& Collector::recycled(Store<S>& store, SymbolKind kind, TokenIndex name) {
    Symbol* old = earlier_ ? earlier_->find(idOf(name)) : nullptr;
    if (!old || old->kind != kind || old->decl) return store.emplace_back();
    S& symbol = static_cast<S&>(*old);
    symbol.reset();
    return symbol;
}

} // namespace rapid::sema
