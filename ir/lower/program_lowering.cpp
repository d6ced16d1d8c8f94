#include "ir/lower/program_lowering.h"

#include "config/letter_case.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/syntax/limits.h"
#include "ir/lower/routine_lowering.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::lower {

using sema::DataSymbol;
using sema::DataType;
using sema::LanguageError;
using sema::RoutineSymbol;
using sema::TypeKind;

namespace {

static_assert(syntax::kStringCapacity == rt::kStringCapacity);

bool isScalarKind(TypeKind kind) {
    return kind == TypeKind::Num || kind == TypeKind::Dnum || kind == TypeKind::Bool;
}

ir::DescKind descKind(const sema::Type& type) {
    switch (type.base()->kind) {
    case TypeKind::Num: return ir::DescKind::Float;
    case TypeKind::Dnum: return ir::DescKind::Double;
    case TypeKind::Bool: return ir::DescKind::Bool;
    case TypeKind::String: return ir::DescKind::String;
    case TypeKind::Record: return ir::DescKind::Record;
    case TypeKind::NonValue: return type.base()->bytes > 0 ? ir::DescKind::Bytes : ir::DescKind::Handle;
    case TypeKind::SemiValue: return ir::DescKind::Handle;
    case TypeKind::Error:
    case TypeKind::Switch:
    case TypeKind::AnyType: return ir::DescKind::Other;
    }
    return ir::DescKind::Other;
}

} // namespace

rt::ParamShape shapeOf(const DataSymbol& param) {
    const TypeKind kind = param.type.type->base()->kind;
    rt::ParamShape shape;
    shape.isSwitch = param.isSwitch;
    shape.isAny = kind == TypeKind::AnyType;
    shape.isScalar = isScalarKind(kind);
    shape.isIn = param.mode == syntax::ParamMode::In;
    shape.optional = param.optional || param.requiredAlternative;
    shape.rank = param.type.rank;
    return shape;
}

bool isUnknown(const DataType& type) {
    return type.type->base()->kind == TypeKind::Error;
}

bool isWithoutForm(const DataSymbol& data) {
    bool sized = true;
    for (int k = 0; k < data.type.rank; ++k)
        sized = sized && data.type.dims[k] > 0;
    return isUnknown(data.type) || !sized;
}

ProgramLowering::ProgramLowering(const sema::CheckedProgram& program, const Options& options,
                                 diag::Sink& sink, ir::Module& out)
    : program_(program), options_(options), sink_(sink), module_(out),
      reachesRoutineData_(program.uses(sema::Trait::RoutineData)) {
    for (const sema::Module* lib : program.predefinedModules)
        for (const DataSymbol* data : lib->data)
            if (data->dataKind == syntax::DataKind::Const &&
                data->type.type->known == sema::KnownType::ErrorNumber) {
                const auto number = static_cast<int32_t>(data->value().number);
                if (data->languageError != LanguageError::None) errorNumbers_[data->languageError] = number;
                if (data->meaning == sema::Meaning::AllErrors) allErrors_ = number;
            }
    module_.overflowError = errorNumber(LanguageError::Overflow);
}

ir::TypeId ProgramLowering::irType(const sema::Type* type) {
    const sema::Type* base = type->base();
    switch (base->kind) {
    case TypeKind::Num: return ir::kF32;
    case TypeKind::Dnum: return ir::kF64;
    case TypeKind::Bool:
    case TypeKind::Switch: return ir::kBool;
    case TypeKind::String: return stringType();
    case TypeKind::NonValue:
        if (base->bytes > 0) return module_.stringOf(base->bytes);
        return ir::kI64;
    case TypeKind::SemiValue:
    case TypeKind::Error: return ir::kI64; // of a module that is not here: a place, which nothing reads
    case TypeKind::AnyType: return ir::kVoid;
    case TypeKind::Record: break;
    }
    if (auto found = records_.find(base); found != records_.end()) return found->second;
    std::vector<ir::Field> fields;
    for (const auto& component : base->components)
        fields.push_back({component.name, irType(component.type)});
    const ir::TypeId id = module_.addRecord(base->name, std::move(fields));
    records_[base] = id;
    return id;
}

ir::TypeId ProgramLowering::irType(const DataType& type) {
    const ir::TypeId element = irType(type.type);
    if (!type.isArray()) return element;
    return module_.arrayOf(element, std::vector<int32_t>(type.dims, type.dims + type.rank));
}

uint32_t ProgramLowering::typeDesc(const DataType& type) {
    const auto key = std::make_tuple(type.type, type.rank > 0 ? type.dims[0] : 0,
                                     type.rank > 1 ? type.dims[1] : 0, type.rank > 2 ? type.dims[2] : 0);
    if (auto found = descs_.find(key); found != descs_.end()) return found->second;
    ir::TypeDesc desc;
    desc.name = type.type->name;
    desc.baseName = type.type->base()->name;
    desc.type = irType(type);
    if (type.isArray()) {
        desc.kind = ir::DescKind::Array;
        desc.fieldDescs.push_back(typeDesc({type.type, 0, {0, 0, 0}}));
    } else {
        desc.kind = descKind(*type.type);
        if (desc.kind == ir::DescKind::Record)
            for (const auto& component : type.type->base()->components) {
                desc.fieldNames.push_back(component.name);
                desc.fieldDescs.push_back(typeDesc({component.type, 0, {0, 0, 0}}));
            }
    }
    const auto index = static_cast<uint32_t>(module_.typeDescs.size());
    module_.typeDescs.push_back(std::move(desc));
    descs_[key] = index;
    return index;
}

namespace {
/// Parts that a value does not give are zero.
sema::ConstValue member(const sema::ConstValue& value, size_t i) {
    return i < value.members().size() ? value.members()[i] : sema::ConstValue();
}
} // namespace

void ProgramLowering::flatten(const sema::ConstValue& value, const DataType& type, ir::ConstData& out) {
    using Kind = sema::ConstValue::Kind;
    if (type.isArray()) {
        DataType inner{type.type, static_cast<uint8_t>(type.rank - 1), {type.dims[1], type.dims[2], 0}};
        for (int32_t i = 0; i < type.dims[0]; ++i)
            flatten(member(value, static_cast<size_t>(i)), inner, out);
        return;
    }
    const sema::Type* base = type.type->base();
    ir::ConstScalar scalar;
    switch (base->kind) {
    case TypeKind::Record:
        for (size_t i = 0; i < base->components.size(); ++i)
            flatten(member(value, i), {base->components[i].type, 0, {0, 0, 0}}, out);
        return;
    case TypeKind::Num: scalar.kind = ir::TypeKind::F32; break;
    case TypeKind::Dnum: scalar.kind = ir::TypeKind::F64; break;
    case TypeKind::Bool: scalar.kind = ir::TypeKind::Bool; break;
    case TypeKind::String: scalar.kind = ir::TypeKind::Str; break;
    case TypeKind::NonValue: scalar.kind = base->bytes > 0 ? ir::TypeKind::Str : ir::TypeKind::I64; break;
    case TypeKind::SemiValue:
    case TypeKind::Error: scalar.kind = ir::TypeKind::I64; break;
    case TypeKind::Switch:
    case TypeKind::AnyType: return;
    }
    if (value.kind == Kind::Number) scalar.number = value.number;
    if (value.kind == Kind::Bool) scalar.integer = value.boolean ? 1 : 0;
    if (value.kind == Kind::String) scalar.text = value.text();
    out.push_back(std::move(scalar));
}

uint32_t ProgramLowering::fileIndex(const std::string& path) {
    auto [it, isNew] = files_.try_emplace(path, static_cast<uint32_t>(module_.files.size()));
    if (isNew) module_.files.push_back(path);
    return it->second;
}

namespace {
uint32_t lineOf(const DataSymbol& symbol) {
    const syntax::SyntaxTree& tree = *symbol.module->tree;
    return tree.source->lineColumn(tree.range(symbol.nameToken).begin).line;
}
} // namespace

ir::GlobalAlias ProgramLowering::aliasOf(const DataSymbol& symbol, uint32_t task, uint32_t global) {
    return {
        global,        symbol.name, symbol.module->name, task, fileIndex(symbol.module->tree->source->path()),
        lineOf(symbol)};
}

uint32_t ProgramLowering::addGlobal(const DataSymbol& symbol, uint32_t task, bool shared,
                                    const std::string& name) {
    ir::Global global;
    global.name = name;
    global.displayName = symbol.name;
    global.moduleName = symbol.module ? symbol.module->name : "";
    global.type = irType(symbol.type);
    global.task = shared ? ir::kNone : task;
    if (symbol.isLocal) global.flags |= ir::kDataLocal;
    if (symbol.predefined) global.flags |= ir::kDataPredefined;
    if (symbol.storage == sema::Storage::Signal) {
        global.kind = ir::GlobalKind::Var; // filled when the program is loaded
    } else {
        switch (symbol.dataKind) {
        case syntax::DataKind::Var: global.kind = ir::GlobalKind::Var; break;
        case syntax::DataKind::Pers: global.kind = ir::GlobalKind::Persistent; break;
        case syntax::DataKind::Const: global.kind = ir::GlobalKind::Const; break;
        }
        if (symbol.value().kind != sema::ConstValue::Kind::None)
            flatten(symbol.value(), symbol.type, global.init);
        global.typeDesc = typeDesc(symbol.type);
        if (symbol.module && symbol.decl && !symbol.predefined) {
            global.file = fileIndex(symbol.module->tree->source->path());
            global.line = lineOf(symbol);
        }
    }
    const auto index = static_cast<uint32_t>(module_.globals.size());
    module_.globals.push_back(std::move(global));
    return index;
}

/// Its module is installed once for all tasks, and it is not TASK data (manual 1.2.2).
bool ProgramLowering::inSharedModule(const DataSymbol& symbol) const {
    return symbol.module && symbol.scope != syntax::ScopeWord::Task && !symbol.routine &&
           options_.sharedModules.contains(config::lowerCase(symbol.module->name));
}

uint32_t ProgramLowering::globalFor(const DataSymbol& symbol, uint32_t task) {
    const bool signal = symbol.storage == sema::Storage::Signal;
    const bool systemGlobalPers =
        !signal && symbol.dataKind == syntax::DataKind::Pers && symbol.scope == syntax::ScopeWord::None;
    const bool constant = !signal && symbol.dataKind == syntax::DataKind::Const;
    // TASK PERS and VAR have a value per task, unless their module is installed shared; constants can be shared.
    const bool sharedModule = !signal && !constant && !systemGlobalPers && inSharedModule(symbol);
    const bool shared = systemGlobalPers || sharedModule || (constant && symbol.predefined);
    const auto key = std::make_pair(shared ? ir::kNone : task, &symbol);
    if (auto found = globals_.find(key); found != globals_.end()) return found->second;
    if (!signal && isImported(symbol)) return globals_[key] = importGlobal(symbol, task);
    uint32_t index = 0;
    if (systemGlobalPers) {
        // One object for every task that declares it; sema has compared types and dimensions.
        auto [it, isNew] = sharedPersistents_.try_emplace(config::lowerCase(symbol.name), 0);
        if (isNew)
            it->second = addGlobal(symbol, task, true, "pers/" + it->first);
        else if (symbol.module && symbol.decl && !symbol.predefined)
            module_.aliases.push_back(aliasOf(symbol, task, it->second));
        index = it->second;
        ir::Global& global = module_.globals[index];
        if (global.init.empty() && symbol.value().kind != sema::ConstValue::Kind::None)
            flatten(symbol.value(), symbol.type, global.init);
    } else if (sharedModule) {
        // Every task has read the module for itself, so its data are found by their names.
        const std::string name = fmt::format("shared/{}/{}", config::lowerCase(symbol.module->name),
                                             config::lowerCase(symbol.name));
        auto [it, isNew] = sharedPersistents_.try_emplace(name, 0);
        if (isNew) it->second = addGlobal(symbol, task, true, name);
        index = it->second;
        if (module_.globals[index].type != irType(symbol.type)) {
            const auto& tree = *symbol.module->tree;
            sink_.report(diag::say::SharedDataConflict.code, tree.source, tree.range(symbol.nameToken),
                         {symbol.name, symbol.module->name});
        }
    } else if (signal) {
        index = addGlobal(symbol, task, false,
                          fmt::format("{}/signal/{}", this->task(task).name, config::lowerCase(symbol.name)));
        ir::ExternalRef ref;
        ref.name = symbol.name;
        ref.kind = symbol.type.type->base()->name;
        ref.global = index;
        if (symbol.module && symbol.nameToken != syntax::kNoToken) {
            const auto& tree = *symbol.module->tree;
            const LineColumn at = tree.source->lineColumn(tree.range(symbol.nameToken).begin);
            ref.file = fileIndex(tree.source->path());
            ref.line = at.line;
            ref.column = at.column;
        }
        module_.externals.push_back(std::move(ref));
    } else {
        const std::string moduleName = symbol.module ? symbol.module->name : "";
        index = addGlobal(symbol, task, shared,
                          shared ? fmt::format("{}/{}", moduleName, symbol.name)
                                 : fmt::format("{}/{}/{}", this->task(task).name, moduleName, symbol.name));
    }
    globals_[key] = index;
    return index;
}

uint32_t ProgramLowering::constGlobal(ir::TypeId type, ir::ConstData data) {
    std::string key = fmt::format("{}:", type);
    for (const ir::ConstScalar& s : data) {
        key += fmt::format("{}|{:a}|{}|{}:", static_cast<int>(s.kind), s.number, s.integer, s.text.size());
        key += s.text;
    }
    auto [it, isNew] = constants_.try_emplace(std::move(key), static_cast<uint32_t>(module_.globals.size()));
    if (isNew) {
        ir::Global global;
        global.name = fmt::format("const/{}", module_.globals.size());
        global.type = type;
        global.kind = ir::GlobalKind::Const;
        global.init = std::move(data);
        module_.globals.push_back(std::move(global));
    }
    return it->second;
}

uint32_t ProgramLowering::stringGlobal(std::string_view text) {
    ir::ConstScalar scalar;
    scalar.kind = ir::TypeKind::Str;
    scalar.text = std::string(text.substr(0, rt::kStringCapacity));
    return constGlobal(stringType(), {scalar});
}

int32_t ProgramLowering::errorNumber(LanguageError error) const {
    return errorNumbers_.at(error);
}

bool ProgramLowering::implemented(const RoutineSymbol& symbol) const {
    return !options_.nativeImplemented || options_.nativeImplemented("rt_" + symbol.name);
}

ir::TypeId irTypeOf(ir::Module& module, rt::AbiType type) {
    switch (type) {
    case rt::AbiType::Void: return ir::kVoid;
    case rt::AbiType::Bool: return ir::kBool;
    case rt::AbiType::I32: return ir::kI32;
    case rt::AbiType::I64: return ir::kI64;
    case rt::AbiType::F32: return ir::kF32;
    case rt::AbiType::F64: return ir::kF64;
    case rt::AbiType::String: return module.stringOf(rt::kStringCapacity);
    case rt::AbiType::Pointer: return ir::kPtr;
    }
    return ir::kVoid;
}

uint32_t ProgramLowering::addNative(ir::Native native) {
    auto [it, isNew] = natives_.try_emplace(native.symbol, static_cast<uint32_t>(module_.natives.size()));
    if (isNew) module_.natives.push_back(std::move(native));
    return it->second;
}

uint32_t ProgramLowering::support(Support which) {
    const rt::NativeSignature& signature = rt::support::signatureOf(which);
    if (auto found = natives_.find(signature.symbol); found != natives_.end()) return found->second;
    ir::Native native;
    native.symbol = signature.symbol;
    native.nativeClass = signature.returnsValue ? ir::NativeClass::Const : ir::NativeClass::Plain;
    native.result = irTypeOf(module_, signature.result);
    for (const rt::AbiType type : signature.params)
        native.params.push_back(irTypeOf(module_, type));
    return addNative(std::move(native));
}

ir::TypeId ProgramLowering::slotType(rt::Slot slot, const DataSymbol& param) {
    switch (slot) {
    case rt::Slot::Value: return irType(param.type);
    case rt::Slot::Switch: return ir::kBool;
    case rt::Slot::Address:
    case rt::Slot::Type: return ir::kPtr;
    case rt::Slot::Dimension: return ir::kI32;
    }
    return ir::kVoid;
}

uint32_t ProgramLowering::nativeFor(const RoutineSymbol& symbol) {
    const std::string name = "rt_" + symbol.name;
    if (auto found = natives_.find(name); found != natives_.end()) return found->second;
    ir::Native native;
    native.symbol = name;
    bool allValues = true;
    for (const DataSymbol* param : symbol.params)
        rt::forEachSlot(shapeOf(*param), [&](rt::Slot slot) {
            native.params.push_back(slotType(slot, *param));
            allValues = allValues && slot == rt::Slot::Value;
        });
    const bool isFunction = symbol.routineKind == syntax::RoutineKind::Func;
    native.result = isFunction ? irType(symbol.returnType) : ir::kVoid;
    const bool scalarResult = isFunction && module_.isScalar(native.result) && native.result != ir::kI64;
    const bool isConst = symbol.effects == sema::Effects::Const;
    native.nativeClass = rt::returnsItsValue(isConst, scalarResult, allValues) ? ir::NativeClass::Const
                                                                               : ir::NativeClass::Plain;
    native.watches = symbol.effects == sema::Effects::Watches ||
                     (symbol.traits.has(sema::Trait::WatchesData) &&
                      (isGiven(symbol, "persbool") || isGiven(symbol, "persboolbreak")));
    native.finite = symbol.traits.has(sema::Trait::Finite);
    native.bounded = symbol.traits.has(sema::Trait::Bounded);
    native.whole = symbol.traits.has(sema::Trait::Whole);
    return addNative(std::move(native));
}

uint32_t ProgramLowering::routineFor(const RoutineSymbol& symbol, uint32_t task) {
    const auto key = std::make_pair(task, &symbol);
    if (auto found = routines_.find(key); found != routines_.end()) return found->second;
    const auto index = static_cast<uint32_t>(module_.routines.size());
    routines_[key] = index;
    module_.routines.push_back(declareRoutine(*this, symbol, task));
    pending_.push_back({&symbol, task, index});
    return index;
}

uint32_t ProgramLowering::lowerDetachedHandler(const Pending& routine, const RoutineLowering& body) {
    const auto index = static_cast<uint32_t>(module_.routines.size());
    ir::Routine declared = declareRoutine(*this, *routine.symbol, routine.task);
    declared.name += "$error";
    declared.params = {{"data", ir::kPtr}};
    declared.result = ir::kVoid;
    declared.callable = declared.hasBackward = false;
    declared.isDetachedHandler = true;
    module_.routines.push_back(declared);
    RoutineLowering lowering(*this, *routine.symbol, routine.task, declared);
    ir::Routine done = lowering.runDetached(body);
    module_.routines[index] = std::move(done);
    return index;
}

void ProgramLowering::drainPending() {
    while (!pending_.empty()) {
        const Pending next = pending_.back();
        pending_.pop_back();
        RoutineLowering lowering(*this, *next.symbol, next.task, module_.routines[next.index]);
        ir::Routine done = lowering.run();
        if (lowering.needsDetachedHandler()) done.detachedHandler = lowerDetachedHandler(next, lowering);
        done.exported =
            done.exported || module_.routines[next.index].exported; // a CONNECT names it meanwhile
        // Breakpoints and the program pointer reach every routine of the program.
        done.exported =
            done.exported || (options_.stepping && !next.symbol->predefined) ||
            (done.callable && options_.eventRoutines.contains(config::lowerCase(next.symbol->name)));
        module_.routines[next.index] = std::move(done);
    }
}

uint32_t ProgramLowering::makeReset(uint32_t taskIndex) {
    ir::Routine routine;
    routine.name = task(taskIndex).name + "/$reset";
    routine.displayName = "$reset";
    routine.exported = true;
    ir::Builder b(module_, routine);
    b.setBlock(b.addBlock("entry"));
    b.charge(1); // in every profile alike
    const size_t count = module_.globals.size();
    for (size_t i = 0; i < count; ++i) {
        if (module_.globals[i].kind != ir::GlobalKind::Var || module_.globals[i].task != taskIndex) continue;
        if (module_.globals[i].typeDesc == ir::kNone) continue; // the slot of a signal keeps its connection
        const ir::TypeId type = module_.globals[i].type;
        const ir::ValueId target = b.globalAddr(static_cast<uint32_t>(i));
        if (module_.globals[i].init.empty())
            b.zero(type, target);
        else
            b.copy(type, target, b.globalAddr(constGlobal(type, module_.globals[i].init)));
    }
    for (const auto& [key, flag] : valueFlags_)
        if (key.first == taskIndex) b.zero(ir::kI32, b.globalAddr(flag));
    b.ret();
    module_.routines.push_back(std::move(routine));
    return static_cast<uint32_t>(module_.routines.size() - 1);
}

/// The entry of a task without main, of which only routines that are called from outside are executed.
uint32_t ProgramLowering::makeEmptyEntry(uint32_t taskIndex) {
    ir::Routine routine;
    routine.name = task(taskIndex).name + "/$entry";
    routine.displayName = "$entry";
    ir::Builder b(module_, routine);
    b.setBlock(b.addBlock("entry"));
    b.charge(1);
    b.ret();
    module_.routines.push_back(std::move(routine));
    return static_cast<uint32_t>(module_.routines.size() - 1);
}

uint32_t ProgramLowering::valueFlag(const DataSymbol& symbol, uint32_t task) {
    auto [found, isNew] = valueFlags_.try_emplace({task, &symbol}, 0);
    if (isNew)
        found->second = addFlag(
            fmt::format("assigned/{}/{}/{}", this->task(task).name, symbol.module->name, symbol.name));
    return found->second;
}

void ProgramLowering::lowerTask(uint32_t index) {
    const sema::Task& current = task(index);
    for (const sema::Module* m : current.modules) {
        for (const DataSymbol* data : m->data)
            if (!isWithoutForm(*data)) globalFor(*data, index);
        for (const RoutineSymbol* routine : m->routines)
            routineFor(*routine, index);
    }
    drainPending();
    if (searchesData() || options_.keepsPredefined) addPredefinedData(index);
    ir::TaskEntry entry;
    entry.name = current.name;
    entry.kind = current.type;
    entry.motionTask = index == 0;
    entry.entry = current.entryRoutine ? routineFor(*current.entryRoutine, index) : ir::kNone;
    if (entry.entry == ir::kNone) entry.entry = makeEmptyEntry(index);
    entry.reset = makeReset(index);
    if (entry.entry != ir::kNone) module_.routines[entry.entry].exported = true;
    module_.tasks.push_back(std::move(entry));
}

/// Modules that come later may have trap routines, event routines and error handlers of callers are executed in between.
void ProgramLowering::findCopies() {
    copies_.emplace(program_, unit_ || erases_ || !options_.eventRoutines.empty(), continuesAtUserLevel_);
}

bool ProgramLowering::run() {
    module_.name = options_.programName;
    module_.configNames = options_.configNames;
    module_.configTexts = options_.configTexts;
    module_.folder = options_.folder;
    const size_t errorsBefore = sink_.errorCount();
    findNamedParameters();
    // A module that is loaded may call EraseModule, too.
    erases_ = program_.uses(sema::Trait::Erases) || program_.uses(sema::Trait::Loads);
    continuesAtUserLevel_ = usesContinue();
    findCopies();
    for (const auto& task : program_.tasks)
        for (const sema::Module* module : task->modules)
            findOpenInitialValues(*module);
    for (uint32_t i = 0; i < program_.tasks.size(); ++i)
        lowerTask(i);
    addTables();
    drainPending();
    return sink_.errorCount() == errorsBefore;
}

bool ProgramLowering::runUnit(uint32_t task, const sema::Module& module, const UnitOptions& options) {
    unit_ = &module;
    unitOptions_ = &options;
    module_.name = options_.programName;
    module_.unitTask = static_cast<int32_t>(task);
    const size_t errorsBefore = sink_.errorCount();
    findNamedParameters();
    continuesAtUserLevel_ = usesContinue();
    findCopies();
    findOpenInitialValues(module);
    for (const DataSymbol* data : module.data)
        if (!isWithoutForm(*data)) globalFor(*data, task);
    for (const RoutineSymbol* routine : module.routines)
        routineFor(*routine, task);
    drainPending();
    if (searchesData()) addPredefinedData(task);
    module_.unitReset = makeReset(task);
    addTablesOf(task, module, true);
    addSearchTypes();
    drainPending();
    return sink_.errorCount() == errorsBefore;
}

bool lowerUnit(const sema::CheckedProgram& program, uint32_t task, const sema::Module& module,
               const UnitOptions& options, diag::Sink& sink, ir::Module& out) {
    return ProgramLowering(program, options.program, sink, out).runUnit(task, module, options);
}

bool lowerProgram(const sema::CheckedProgram& program, const Options& options, diag::Sink& sink,
                  ir::Module& out) {
    return ProgramLowering(program, options, sink, out).run();
}

} // namespace rapid::lower
