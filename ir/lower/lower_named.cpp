// Facts that a program looks up by name at run time: calls by name, tables of routines, modules and data, names of arguments.

#include "config/letter_case.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

#include <algorithm>

namespace rapid::lower {

using namespace syntax;
using sema::BoundArg;
using sema::BoundCall;
using sema::DataSymbol;
using sema::LanguageError;
using sema::RoutineSymbol;
using sema::Storage;
using sema::TypeKind;

// ---- Parameters whose argument's name is asked for (ArgName) -------------------------------------------------------

/// Null when the program does not call it.
const RoutineSymbol* ProgramLowering::usedBuiltIn(sema::Role role) const {
    for (const sema::Module* lib : program_.predefinedModules)
        for (const RoutineSymbol* routine : lib->routines)
            if (routine->used && routine->role == role) return routine;
    return nullptr;
}

/// RaiseToUser \Continue occurs, or may come with a module: code of the stepping profile is ready for that, other code
/// would have to pay for it.
bool ProgramLowering::usesContinue() const {
    if (stepping() && (unit_ || program_.uses(sema::Trait::Loads))) return true;
    const RoutineSymbol* raise = usedBuiltIn(sema::Role::RaiseToUser);
    return raise && isGiven(*raise, "continue");
}

/// Some call of the routine has an argument for this parameter (lower case).
bool ProgramLowering::isGiven(const RoutineSymbol& routine, std::string_view param) const {
    for (const auto& facts : program_.facts)
        for (const auto& [node, call] : facts->calls)
            for (const BoundArg& arg : call.args)
                if (call.routine == &routine && arg.kind != BoundArg::Kind::Absent &&
                    config::lowerCase(arg.param->name) == param)
                    return true;
    return false;
}

/// ArgName follows a parameter through the calls that pass it on, so these parameters bring a name along.
void ProgramLowering::findNamedParameters() {
    const RoutineSymbol* argName = usedBuiltIn(sema::Role::ArgName);
    if (!argName) return;
    asksForNames_ = true;
    bool changed = true;
    const auto mark = [&](const BoundArg& arg, const sema::Module& module) {
        const DataSymbol* root = referredData(arg.value, module);
        if (root && root->storage == Storage::Parameter && namedParams_.insert(root).second) changed = true;
    };
    while (std::exchange(changed, false))
        for (const auto& facts : program_.facts)
            for (const auto& [node, call] : facts->calls) {
                // A procedure called by name may ask for the name of any argument.
                const bool any = !call.routine;
                for (size_t i = 0; i < call.args.size(); ++i) {
                    const BoundArg& arg = call.args[i];
                    const bool asked = any || (call.routine == argName ? i == 0 : passesName(*arg.param));
                    if (asked && arg.value && call.module) mark(arg, *call.module);
                }
            }
}

ir::ValueId RoutineLowering::argumentName(const BoundArg& arg) {
    const DataSymbol* root = referredData(arg.value, *module_);
    if (!root) return b_.nullPtr();
    if (root->storage != Storage::Parameter) return b_.globalAddr(program_.stringGlobal(root->name));
    const Slot* slot = findSlot(*root);
    return slot && slot->name != ir::kNone ? parameter(slot->name) : b_.nullPtr();
}

/// The native gets the name where it expects the parameter; null when there is none.
void RoutineLowering::lowerArgName(const BoundCall& call, ValueId resultAddr) {
    std::vector<ValueId> args{resultAddr == ir::kNone ? tempAddr(program_.stringType()) : resultAddr};
    args.push_back(argumentName(call.args[0]));
    args.push_back(b_.nullPtr());
    pushArgument(call.args[1], args);
    b_.callNative(program_.nativeFor(*call.routine), std::move(args));
}

// ---- Calls by name -------------------------------------------------------------------------------------------------

namespace {
/// Fields of the row that lateRow() describes.
enum LateField : uint32_t { kData, kType, kObjectName, kParameter, kFlags };
} // namespace

int32_t RoutineLowering::lateFlags(const BoundArg& arg) const {
    if (!arg.value) return rt::kLateSwitch;
    const Expr& value = unparen(*arg.value);
    const DataSymbol* root = rootSymbol(value);
    int32_t flags = 0;
    if (root) flags |= rt::kLateReference;
    if (info(value).constant ||
        (root && root->dataKind == DataKind::Const && root->storage != Storage::Parameter))
        flags |= rt::kLateConstant;
    if (arg.kind == BoundArg::Kind::Conditional && root && root->isSwitch) flags |= rt::kLateSwitch;
    return flags;
}

/// Address and type of an argument, null where a conditional one is absent.
void RoutineLowering::lateValue(const BoundArg& arg, ValueId present, std::vector<ValueId>& out) {
    if (!arg.value) { // a switch that is given
        out.push_back(present);
        out.push_back(b_.nullPtr());
        return;
    }
    if (arg.kind == BoundArg::Kind::Conditional) {
        const DataSymbol* source = rootSymbol(*arg.value);
        const Slot* slot = findSlot(*source);
        if (source->isSwitch) {
            out.push_back(b_.select(parameter(slot->param), present, b_.nullPtr()));
            out.push_back(b_.nullPtr());
            return;
        }
        out.push_back(addressIfPresent(*slot));
        Place p;
        p.type = source->type;
        for (int k = 0; k < source->type.rank; ++k)
            p.dims[static_cast<size_t>(k)] = parameter(slot->param + 1 + static_cast<uint32_t>(k));
        out.push_back(typeAddress(p));
        return;
    }
    const sema::DataType wanted = arg.param ? arg.param->type : info(unparen(*arg.value)).type();
    if (arg.param && passingOf(*arg.param) == Passing::Value) {
        const ir::TypeId type = program_.irType(wanted);
        const ValueId temporary = tempAddr(type);
        b_.store(type, lowerValueAs(*arg.value, wanted.type), temporary);
        out.push_back(temporary);
        out.push_back(b_.typeDescAddr(program_.typeDesc(wanted)));
        return;
    }
    if (arg.param && !wanted.isArray()) {
        out.push_back(argumentAddress(arg));
        out.push_back(b_.typeDescAddr(program_.typeDesc(wanted)));
        return;
    }
    const Place p = reference(*arg.value);
    out.push_back(p.addr);
    out.push_back(typeAddress(p));
}

/// A call whose target is found by name when it is executed. Arguments travel in a table (rt::LateCallArg).
void RoutineLowering::callByName(ValueId name, std::span<const BoundArg> args, ir::RoutineKind kind,
                                 ValueId result) {
    std::vector<const BoundArg*> given;
    for (const BoundArg& arg : args)
        if (arg.kind != BoundArg::Kind::Absent) given.push_back(&arg);
    const auto count = static_cast<int32_t>(given.size());
    const ir::TypeId row = program_.lateRow();
    ValueId table = b_.nullPtr();
    if (count > 0) table = tempAddr(program_.module().arrayOf(row, {count}));
    for (int32_t i = 0; i < count; ++i) {
        const BoundArg& arg = *given[static_cast<size_t>(i)];
        std::vector<ValueId> value;
        lateValue(arg, name, value);
        const ValueId at = b_.elemAddr(row, table, b_.constI32(i));
        const auto set = [&](LateField field, ValueId content) {
            b_.store(program_.module().type(row).fields[field].type, content, b_.fieldAddr(row, at, field));
        };
        set(kData, value[0]);
        set(kType, value[1]);
        set(kObjectName, program_.asksForNames() ? argumentName(arg) : b_.nullPtr());
        const bool byName = arg.argument && arg.argument->argKind != ArgKind::Required;
        set(kParameter, byName ? b_.globalAddr(program_.stringGlobal(module_->tree->text(arg.argument->name)))
                               : b_.nullPtr());
        set(kFlags, b_.constI32(lateFlags(arg)));
    }
    const uint32_t native = program_.support(Support::rt_lateCall);
    b_.callNative(native, {name, table, b_.constI32(count), b_.constI32(static_cast<int32_t>(kind)), result});
}

/// %name% args (manual 1.1.5).
void RoutineLowering::lowerLateCall(const CallStmt& stmt) {
    const ValueId name = stmt.lateName ? lowerAddr(*stmt.lateName)
                                       : b_.globalAddr(program_.stringGlobal(module_->tree->text(stmt.name)));
    const auto found = facts().calls.find(&stmt);
    if (found == facts().calls.end()) return;
    callByName(name, found->second.args, ir::RoutineKind::Procedure, b_.nullPtr());
}

ir::TypeId ProgramLowering::lateRow() {
    using Row = rt::LateCallArg;
    if (lateRow_ != ir::kVoid) return lateRow_;
    lateRow_ =
        module_.addRecord("rt.LateCallArg", {{"data", irTypeOf<decltype(Row::data)>(module_)},
                                             {"type", irTypeOf<decltype(Row::type)>(module_)},
                                             {"objectName", irTypeOf<decltype(Row::objectName)>(module_)},
                                             {"parameter", irTypeOf<decltype(Row::parameter)>(module_)},
                                             {"flags", irTypeOf<decltype(Row::flags)>(module_)}});
    static_assert(offsetof(Row, type) == 8 && offsetof(Row, objectName) == 16 &&
                  offsetof(Row, parameter) == 24 && offsetof(Row, flags) == 32 && sizeof(Row) == 40);
    return lateRow_;
}

// ---- Tables --------------------------------------------------------------------------------------------------------

bool ProgramLowering::searchesData() const {
    return program_.uses(sema::Trait::DataNames);
}

/// Data of the language can be read and searched by name, too.
void ProgramLowering::addPredefinedData(uint32_t task) {
    for (const sema::Module* lib : program_.predefinedModules)
        for (const DataSymbol* data : lib->data)
            if (data->storage == Storage::ModuleData && data->type.type->base()->kind != TypeKind::Error &&
                !(unit_ && unitOptions_->exists(lib->name, data->name)))
                globalFor(*data, task);
}

void ProgramLowering::addRoutineData(uint32_t task, const sema::Module& module) {
    for (const RoutineSymbol* routine : module.routines) {
        const auto add = [&](const DataSymbol& data, ir::GlobalKind kind) {
            if (data.isSwitch || data.type.type->base()->kind == TypeKind::Error) return;
            ir::RoutineData row;
            row.name = data.name;
            row.moduleName = module.name;
            row.routine = routine->name;
            row.typeDesc = typeDesc({data.type.type, 0, {0, 0, 0}});
            row.task = task;
            row.kind = kind;
            module_.routineData.push_back(std::move(row));
        };
        for (const DataSymbol* param : routine->params)
            add(*param, param->mode == ParamMode::Pers ? ir::GlobalKind::Persistent : ir::GlobalKind::Var);
        for (const DataSymbol* data : routine->data)
            if (data->storage == Storage::RoutineData)
                add(*data, data->dataKind == DataKind::Const ? ir::GlobalKind::Const : ir::GlobalKind::Var);
    }
}

void ProgramLowering::addSearchTypes() {
    std::vector<const sema::Module*> modules(program_.predefinedModules.begin(),
                                             program_.predefinedModules.end());
    for (const auto& task : program_.tasks)
        modules.insert(modules.end(), task->modules.begin(), task->modules.end());
    for (const sema::Module* module : modules)
        for (const sema::TypeSymbol* symbol : module->types) {
            const TypeKind kind = symbol->type->base()->kind;
            if (kind == TypeKind::Error || kind == TypeKind::Switch || kind == TypeKind::AnyType) continue;
            module_.searchTypes.push_back(typeDesc({symbol->type, 0, {0, 0, 0}}));
        }
}

void ProgramLowering::addNamedRoutine(const RoutineSymbol& symbol, uint32_t task) {
    ir::NamedRoutine named;
    named.routine = routineFor(symbol, task);
    module_.routines[named.routine].exported = true;
    named.isLocal = symbol.isLocal;
    named.task = task;
    switch (symbol.routineKind) {
    case RoutineKind::Proc: named.kind = ir::RoutineKind::Procedure; break;
    case RoutineKind::Func: named.kind = ir::RoutineKind::Function; break;
    case RoutineKind::Trap: named.kind = ir::RoutineKind::Interrupt; break;
    }
    named.late = symbol.routineKind != RoutineKind::Trap;
    for (const DataSymbol* param : symbol.params) {
        ir::ParamEntry entry;
        entry.name = param->name;
        if (!param->isSwitch) entry.typeDesc = typeDesc({param->type.type, 0, {0, 0, 0}});
        switch (param->mode) {
        case ParamMode::In: entry.mode = ir::ParamMode::In; break;
        case ParamMode::Var: entry.mode = ir::ParamMode::Variable; break;
        case ParamMode::Pers: entry.mode = ir::ParamMode::Persistent; break;
        case ParamMode::Inout:
        case ParamMode::Ref: entry.mode = ir::ParamMode::Either; break;
        }
        entry.optional = param->optional;
        entry.rank = param->type.rank;
        entry.group = static_cast<uint8_t>(std::min<uint32_t>(param->group, 255));
        entry.passesName = passesName(*param);
        named.params.push_back(std::move(entry));
    }
    module_.namedRoutines.push_back(std::move(named));
}

void ProgramLowering::addTablesOf(uint32_t task, const sema::Module& module, bool callsByName) {
    ir::ModuleEntry entry;
    entry.name = module.name;
    entry.file = fileIndex(module.tree->source->path());
    entry.task = task;
    if (erases_ && !unit_) entry.gone = goneFlag(module, task);
    module_.modules.push_back(std::move(entry));
    if (unit_ || program_.uses(sema::Trait::SearchesData)) addRoutineData(task, module);
    const auto& fromOutside = options_.calledFromOutside;
    for (const RoutineSymbol* routine : module.routines)
        if (callsByName || (fromOutside && fromOutside(*routine))) addNamedRoutine(*routine, task);
}

/// Needed when the program is complete: what it asks for by name.
void ProgramLowering::addTables() {
    const bool callsByName = options_.callsByName || natives_.contains("rt_lateCall") || erases_ ||
                             program_.uses(sema::Trait::CallsLater);
    for (uint32_t task = 0; task < program_.tasks.size(); ++task)
        for (const sema::Module* module : program_.tasks[task]->modules)
            addTablesOf(task, *module, callsByName);
    if (searchesData()) addSearchTypes();
}

// ---- Units: modules loaded while a program runs ----------------------------------------------------------------------

/// Does the object lie in another unit? Persistents and what the language predefines do, as soon as one has them.
bool ProgramLowering::isImported(const DataSymbol& symbol) const {
    if (!unit_ || !symbol.module) return false;
    if (symbol.module != unit_ && !symbol.predefined) return true;
    const bool constant = symbol.dataKind == DataKind::Const;
    const bool pers = symbol.dataKind == DataKind::Pers && symbol.scope == ScopeWord::None;
    if (symbol.predefined) return !constant && unitOptions_->exists(symbol.module->name, symbol.name);
    return pers && unitOptions_->exists("", symbol.name);
}

uint32_t ProgramLowering::importGlobal(const DataSymbol& symbol, uint32_t task) {
    const bool own = symbol.module == unit_; // a persistent that others have declared before
    ir::Global global;
    global.name = "import/" + symbol.module->name + "/" + symbol.name;
    global.displayName = symbol.name;
    global.moduleName = symbol.module->name;
    global.type = irType(symbol.type);
    global.kind = ir::GlobalKind::External;
    global.task = task;
    if (own) global.typeDesc = typeDesc(symbol.type); // gives it a row in the table of this unit
    module_.globals.push_back(std::move(global));
    return static_cast<uint32_t>(module_.globals.size() - 1);
}

// ---- Modules that leave memory --------------------------------------------------------------------------------------

uint32_t ProgramLowering::goneFlag(const sema::Module& module, uint32_t task) {
    auto [found, isNew] = goneFlags_.try_emplace({task, &module}, 0);
    if (isNew) found->second = addFlag("gone/" + this->task(task).name + "/" + module.name);
    return found->second;
}

uint32_t ProgramLowering::addFlag(std::string name) {
    ir::Global flag;
    flag.name = std::move(name);
    flag.type = ir::kI32;
    module_.globals.push_back(std::move(flag));
    return static_cast<uint32_t>(module_.globals.size() - 1);
}

/// True as long as the module of the symbol has not been erased.
ir::ValueId RoutineLowering::isInMemory(const sema::Symbol& symbol) {
    const ValueId gone = b_.load(ir::kI32, b_.globalAddr(program_.goneFlag(*symbol.module, task_)));
    return b_.binary(ir::Op::IEq, gone, b_.constI32(0));
}

/// A call of a routine of the program that EraseModule may have taken out: then by name, for another module may have come
/// that declares it.
ir::ValueId RoutineLowering::lowerErasableCall(const BoundCall& call, ValueId resultAddr) {
    const RoutineSymbol& callee = *call.routine;
    const bool isFunction = callee.routineKind == RoutineKind::Func;
    const ir::TypeId type = isFunction ? program_.irType(callee.returnType) : ir::kVoid;
    const bool scalar = isFunction && program_.module().isScalar(type);
    const bool aggregate = isFunction && !scalar;
    if (aggregate && resultAddr == ir::kNone) resultAddr = tempAddr(type);
    const ValueId result = scalar ? tempAddr(type) : resultAddr;
    const ir::BlockId direct = b_.addBlock("inmemory");
    const ir::BlockId late = b_.addBlock("erased");
    const ir::BlockId end = b_.addBlock("called");
    b_.condBr(isInMemory(callee), direct, late);
    b_.setBlock(direct);
    std::vector<ValueId> args;
    if (aggregate) args.push_back(resultAddr);
    for (const BoundArg& arg : call.args)
        pushArgument(arg, args);
    ValueId value = b_.call(program_.routineFor(callee, task_), std::move(args));
    if (scalar) b_.store(type, value, result);
    b_.br(end);
    b_.setBlock(late);
    value = lowerForeignCall(call, resultAddr);
    if (scalar) b_.store(type, value, result);
    b_.br(end);
    b_.setBlock(end);
    return scalar ? b_.load(type, result) : ir::kNone;
}

/// The data that a node names and that pass the test, each once; statements nested in it and the expression `except` are
/// left out.
void RoutineLowering::collectData(const Node& node, const Expr* except, const DataTest& test,
                                  std::vector<const DataSymbol*>& out) const {
    if (&node == except) return;
    if (node.kind == NodeKind::Name) {
        const sema::Symbol* symbol = info(as<NameExpr>(node)).symbol;
        if (!symbol || symbol->kind != sema::SymbolKind::Data) return;
        const auto* data = static_cast<const DataSymbol*>(symbol);
        if (test(*data) && std::find(out.begin(), out.end(), data) == out.end()) out.push_back(data);
        return;
    }
    forEachChild(node, [&](const Node& child) {
        if (!isStmt(child.kind)) collectData(child, except, test, out);
    });
}

/// The instruction raises `error`, which names what is missing, unless the condition holds.
void RoutineLowering::requireData(ValueId condition, LanguageError error, std::string_view missing) {
    const ir::BlockId absent = b_.addBlock("absent");
    const ir::BlockId there = b_.addBlock("present");
    b_.condBr(condition, there, absent);
    b_.setBlock(absent);
    raiseUnresolved(error, missing);
    b_.br(there);
    b_.setBlock(there);
}

/// Data that are not in memory or have no value yet raise an error when the instruction begins. `part`: the statement itself
/// or an expression of it; statements nested in it look after themselves.
void RoutineLowering::checkData(const Node& part) {
    checkForeignData(part);
    checkAssigned(part);
}

/// Data of modules that may have left memory.
void RoutineLowering::checkForeignData(const Node& part) {
    if (!program_.dataMayBeAbsent()) return;
    std::vector<const DataSymbol*> used;
    const auto mayBeAbsent = [&](const DataSymbol& data) {
        return data.storage == Storage::ModuleData &&
               (program_.isForeign(data) || program_.mayBeErased(data, module_));
    };
    collectData(part, nullptr, mayBeAbsent, used);
    for (const DataSymbol* data : used) {
        const ValueId present =
            program_.isForeign(*data)
                ? b_.binary(ir::Op::INe, b_.globalAddr(program_.globalFor(*data, task_)), b_.nullPtr())
                : isInMemory(*data);
        requireData(present, LanguageError::UnknownData, data->name);
    }
}

/// A routine of another unit.
ir::ValueId RoutineLowering::lowerForeignCall(const BoundCall& call, ValueId resultAddr) {
    const RoutineSymbol& callee = *call.routine;
    const ValueId name = b_.globalAddr(program_.stringGlobal(callee.module->name + ":" + callee.name));
    if (callee.routineKind != RoutineKind::Func) {
        callByName(name, call.args, ir::RoutineKind::Procedure, b_.nullPtr());
        return ir::kNone;
    }
    const ir::TypeId type = program_.irType(callee.returnType);
    const bool scalar = program_.module().isScalar(type);
    const ValueId result = !scalar && resultAddr != ir::kNone ? resultAddr : tempAddr(type);
    callByName(name, call.args, ir::RoutineKind::Function, result);
    return scalar ? b_.load(type, result) : ir::kNone;
}

} // namespace rapid::lower
