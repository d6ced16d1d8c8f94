// The structures of rt_abi.h: type descriptions, statement tables, routine descriptions, the program description.

#include <set>

#include "codegen/abi_kinds.h"
#include "codegen/abi_row.h"
#include "codegen/compile.h"
#include "codegen/module_emitter.h"

namespace codegen {

llvm::Constant* ModuleEmitter::i32(int64_t value) {
    return llvm::ConstantInt::getSigned(i32_, value);
}

llvm::Constant* ModuleEmitter::constant(llvm::Constant* value, const std::string& name) {
    auto* variable = new llvm::GlobalVariable(*target_, value->getType(), true,
                                              llvm::GlobalValue::PrivateLinkage, value, name);
    return variable;
}

llvm::Constant* ModuleEmitter::text(const std::string& value) {
    llvm::Constant*& known = texts_[value];
    if (!known) {
        known = constant(llvm::ConstantDataArray::getString(context_, value), ""); // a name would cost time
        llvm::cast<llvm::GlobalVariable>(known)->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
        llvm::cast<llvm::GlobalVariable>(known)->setAlignment(llvm::Align(1));
    }
    return known;
}

llvm::Constant* ModuleEmitter::array(llvm::Type* element, const std::vector<llvm::Constant*>& values,
                                     const std::string& name) {
    if (values.empty()) return null();
    return constant(llvm::ConstantArray::get(llvm::ArrayType::get(element, values.size()), values), name);
}

llvm::Constant* ModuleEmitter::rawArray(llvm::StringRef bytes, size_t align, const std::string& name) {
    if (bytes.empty()) return null();
    llvm::Constant* variable = constant(llvm::ConstantDataArray::getRaw(bytes, bytes.size(), i8_), name);
    llvm::cast<llvm::GlobalVariable>(variable)->setAlignment(llvm::Align(align));
    return variable;
}

llvm::Constant* ModuleEmitter::fileName(uint32_t file) {
    if (file >= module_.files.size()) return null();
    return text(module_.files[file]);
}

llvm::GlobalVariable* ModuleEmitter::tableVariable(std::vector<llvm::GlobalVariable*>& known, uint32_t index,
                                                   llvm::Type* type, const std::string& name) {
    llvm::GlobalVariable*& variable = known[index];
    if (variable) return variable;
    variable =
        new llvm::GlobalVariable(*target_, type, true, llvm::GlobalValue::PrivateLinkage, nullptr, name);
    share(*variable);
    return variable;
}

std::string typeDescSymbol(uint32_t index) {
    return "type." + std::to_string(index);
}

llvm::GlobalVariable* ModuleEmitter::typeDesc(uint32_t index) {
    return tableVariable(typeDescs_, index, abi::structType<rt::TypeDesc>(context_), typeDescSymbol(index));
}

llvm::GlobalVariable* ModuleEmitter::routineDesc(uint32_t index) {
    return tableVariable(routineDescs_, index, abi::structType<rt::RoutineDesc>(context_),
                         "routine." + module_.routines[index].name);
}

llvm::Constant* ModuleEmitter::typeDescValue(const ir::TypeDesc& desc) {
    const ir::Type& type = module_.type(desc.type);
    std::vector<llvm::Constant*> fields, names, offsets;
    for (uint32_t part : desc.fieldDescs)
        fields.push_back(typeDesc(part));
    for (const std::string& name : desc.fieldNames)
        names.push_back(text(name));
    int64_t count = 0;
    std::array<int64_t, std::extent_v<decltype(rt::TypeDesc::dims)>> dims{};
    if (desc.kind == ir::DescKind::Record) {
        count = static_cast<int64_t>(type.fields.size());
        for (uint32_t f = 0; f < type.fields.size(); ++f)
            offsets.push_back(i32(module_.fieldOffset(desc.type, f)));
    } else if (desc.kind == ir::DescKind::Array) {
        count = 1;
        for (size_t i = 0; i < type.dims.size(); ++i)
            count *= dims[i] = type.dims[i];
    }
    using Desc = rt::TypeDesc;
    return abi::Row<Desc>(context_)
        .set<&Desc::name>(text(desc.name))
        .set<&Desc::baseName>(text(desc.baseName))
        .set<&Desc::kind>(abi::kindOf(desc.kind))
        .set<&Desc::size>(module_.size(desc.type))
        .set<&Desc::count>(count)
        .set<&Desc::dims>(dims)
        .set<&Desc::fields>(array(ptr_, fields, "fields"))
        .set<&Desc::fieldNames>(array(ptr_, names, "fieldNames"))
        .set<&Desc::offsets>(array(i32_, offsets, "offsets"))
        .finish();
}

namespace {

/// rt::StmtDesc::canStart. `starts`: of the statements before it.
rt::StartMark startMark(const ir::Routine& routine, const ir::Statement& statement,
                        std::set<ir::BlockId>& starts) {
    if (!routine.stepping || statement.start == ir::kNone) return rt::kCannotStart;
    return starts.insert(statement.start).second ? rt::kCanStart : rt::kStartsEarlier;
}

} // namespace

llvm::Constant* ModuleEmitter::statementTable(const ir::Routine& routine) {
    using Desc = rt::StmtDesc;
    std::vector<Desc> rows;
    std::set<ir::BlockId> starts;
    for (const ir::Statement& s : routine.statements)
        // A field that is added to StmtDesc and has no value here does not compile (missing initializer).
        rows.push_back({s.line, s.column, s.endLine, s.endColumn, abi::kindOf(s.kind), s.handled, s.flags,
                        startMark(routine, s, starts),
                        s.previous == ir::kNone ? -1 : static_cast<int32_t>(s.previous)});
    return rawTable(rows, "statements");
}

std::vector<llvm::Constant*> ModuleEmitter::localRows(const ir::Routine& routine) {
    using Desc = rt::LocalDesc;
    std::vector<llvm::Constant*> rows;
    for (uint32_t local : describedLocals(routine)) {
        const ir::Local& l = routine.locals[local];
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(l.name))
                           .set<&Desc::type>(typeDescOrNull(l.typeDesc))
                           .set<&Desc::kind>(l.reference ? Desc::Reference : Desc::Value)
                           .set<&Desc::isParam>(l.isParam)
                           .set<&Desc::rank>(l.rank)
                           .set<&Desc::pad>(0)
                           .finish());
    }
    return rows;
}

llvm::Constant* ModuleEmitter::routineDescValue(const ir::Routine& routine) {
    std::vector<llvm::Constant*> filter, variables;
    const std::vector<llvm::Constant*> locals = localRows(routine);
    for (int32_t number : routine.errorFilter)
        filter.push_back(i32(number));
    for (uint32_t global : routine.errorFilterGlobals)
        variables.push_back(abi::Row<rt::ErrorVariable>(context_)
                                .set<&rt::ErrorVariable::address>(this->global(global))
                                .set<&rt::ErrorVariable::isFloat>(module_.globals[global].type == ir::kF32)
                                .finish());
    using Desc = rt::RoutineDesc;
    return abi::Row<Desc>(context_)
        .set<&Desc::name>(text(routine.displayName))
        .set<&Desc::module>(text(routine.moduleName))
        .set<&Desc::file>(fileName(routine.file))
        .set<&Desc::statements>(statementTable(routine))
        .set<&Desc::statementCount>(routine.statements.size())
        .set<&Desc::hasErrorHandler>(routine.errorHandler != ir::kNone)
        .set<&Desc::hasUndo>(routine.undoHandler != ir::kNone)
        .set<&Desc::noStepIn>(routine.noStepIn)
        .set<&Desc::hasBackward>(routine.hasBackward)
        .set<&Desc::errorFilter>(array(i32_, filter, "filter"))
        .set<&Desc::errorFilterCount>(filter.size())
        .set<&Desc::errorVariables>(table<rt::ErrorVariable>(variables, "filterVariables"))
        .set<&Desc::errorVariableCount>(variables.size())
        .set<&Desc::localCount>(locals.size())
        .set<&Desc::locals>(table<rt::LocalDesc>(locals, "locals"))
        .set<&Desc::line>(routine.line)
        .set<&Desc::stepping>(routine.stepping)
        .set<&Desc::callable>(routine.callable)
        .set<&Desc::isDetachedHandler>(routine.isDetachedHandler)
        .set<&Desc::isBuiltin>(routine.isBuiltin)
        .set<&Desc::textHash>(routine.textHash)
        .set<&Desc::detachedHandler>(entryOrNull(routine.detachedHandler))
        .finish();
}

std::vector<uint32_t> describedLocals(const ir::Routine& routine) {
    std::vector<uint32_t> result;
    for (uint32_t i = 0; i < routine.locals.size(); ++i) {
        if (routine.locals[i].typeDesc == ir::kNone) continue;
        result.push_back(i);
        for (uint32_t k = 0; k < routine.locals[i].rank; ++k)
            result.push_back(routine.locals[i].dims + k);
    }
    return result;
}

std::vector<uint32_t> addressedLocals(const ir::Routine& routine) {
    std::vector<uint32_t> result = describedLocals(routine);
    result.insert(result.end(), routine.sharedLocals.begin(), routine.sharedLocals.end());
    return result;
}

llvm::Constant* ModuleEmitter::tasks() {
    using Desc = rt::TaskDesc;
    std::vector<llvm::Constant*> rows;
    for (const ir::TaskEntry& task : module_.tasks)
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(task.name))
                           .set<&Desc::type>(text(task.kind))
                           .set<&Desc::entry>(emitStart(task.entry))
                           .set<&Desc::reset>(entryOrNull(task.reset))
                           .set<&Desc::motionTask>(task.motionTask)
                           .finish());
    return table<Desc>(rows, "tasks");
}

llvm::Constant* ModuleEmitter::dataRow(const DataDeclaration& declared) {
    using Desc = rt::GlobalDesc;
    const ir::Global& global = module_.globals[declared.global];
    return abi::Row<Desc>(context_)
        .set<&Desc::name>(text(declared.name))
        .set<&Desc::module>(text(declared.moduleName))
        .set<&Desc::address>(this->global(declared.global))
        .set<&Desc::type>(typeDesc(global.typeDesc))
        .set<&Desc::kind>(abi::kindOf(global.kind))
        .set<&Desc::flags>(global.flags)
        .set<&Desc::task>(taskNumber(declared.task))
        .set<&Desc::file>(fileName(declared.file))
        .set<&Desc::line>(declared.line)
        .finish();
}

llvm::Constant* ModuleEmitter::dataTable(const std::vector<DataDeclaration>& data, const char* symbol) {
    if (dataInMemory()) return target_->getOrInsertGlobal(symbol, i8_);
    std::vector<llvm::Constant*> rows;
    for (const DataDeclaration& declared : data)
        rows.push_back(dataRow(declared));
    return table<rt::GlobalDesc>(rows, symbol);
}

llvm::Constant* ModuleEmitter::externals() {
    using Desc = rt::ExternalDesc;
    std::vector<llvm::Constant*> rows;
    for (const ir::ExternalRef& external : module_.externals)
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(external.name))
                           .set<&Desc::kind>(text(external.kind))
                           .set<&Desc::slot>(global(external.global))
                           .set<&Desc::file>(fileName(external.file))
                           .set<&Desc::line>(external.line)
                           .set<&Desc::column>(external.column)
                           .finish());
    return table<Desc>(rows, "externals");
}

llvm::Constant* ModuleEmitter::null() {
    return llvm::ConstantPointerNull::get(ptr_);
}

llvm::Constant* ModuleEmitter::typeDescOrNull(uint32_t index) {
    return index == ir::kNone ? null() : typeDesc(index);
}

llvm::Function* ModuleEmitter::entryOrNull(uint32_t routine) {
    return routine == ir::kNone ? nullptr : cEntry(routine);
}

std::vector<llvm::Constant*> ModuleEmitter::paramRows(const ir::NamedRoutine& named) {
    using Desc = rt::ParamDesc;
    std::vector<llvm::Constant*> rows;
    for (const ir::ParamEntry& param : named.params)
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(param.name))
                           .set<&Desc::type>(typeDescOrNull(param.typeDesc))
                           .set<&Desc::mode>(abi::modeOf(param.mode))
                           .set<&Desc::optional>(param.optional)
                           .set<&Desc::rank>(param.rank)
                           .set<&Desc::group>(param.group)
                           .finish());
    return rows;
}

llvm::Constant* ModuleEmitter::routineRow(uint32_t index, const ir::NamedRoutine& named) {
    using Desc = rt::RoutineEntry;
    const ir::Routine& routine = module_.routines[index];
    const std::vector<llvm::Constant*> params = paramRows(named);
    return abi::Row<Desc>(context_)
        .set<&Desc::name>(text(routine.displayName))
        .set<&Desc::module>(text(routine.moduleName))
        .set<&Desc::task>(named.task == ir::kNone ? int64_t{-1} : int64_t{named.task})
        .set<&Desc::kind>(abi::kindOf(named.kind))
        .set<&Desc::isLocal>(named.isLocal)
        .set<&Desc::address>(cEntry(index))
        .set<&Desc::desc>(routineDesc(index))
        .set<&Desc::late>(named.late ? emitLateEntry(named) : nullptr)
        .set<&Desc::params>(table<rt::ParamDesc>(params, "params"))
        .set<&Desc::paramCount>(params.size())
        .finish();
}

llvm::Constant* ModuleEmitter::routineTable(uint32_t& count) {
    std::vector<llvm::Constant*> rows;
    std::vector<bool> named(module_.routines.size());
    for (const ir::NamedRoutine& entry : module_.namedRoutines) {
        named[entry.routine] = true;
        rows.push_back(routineRow(entry.routine, entry));
    }
    for (uint32_t i = 0; i < module_.routines.size(); ++i)
        if (module_.routines[i].exported && !named[i]) rows.push_back(routineRow(i, {}));
    count = static_cast<uint32_t>(rows.size());
    return table<rt::RoutineEntry>(rows, "routines");
}

llvm::Constant* ModuleEmitter::moduleTable() {
    using Desc = rt::ModuleDesc;
    std::vector<llvm::Constant*> rows;
    for (const ir::ModuleEntry& entry : module_.modules)
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(entry.name))
                           .set<&Desc::file>(fileName(entry.file))
                           .set<&Desc::task>(taskNumber(entry.task))
                           .set<&Desc::gone>(entry.gone == ir::kNone ? null() : global(entry.gone))
                           .finish());
    return table<Desc>(rows, "modules");
}

llvm::Constant* ModuleEmitter::routineDataTable() {
    using Desc = rt::RoutineDataDesc;
    std::vector<llvm::Constant*> rows;
    for (const ir::RoutineData& data : module_.routineData)
        rows.push_back(abi::Row<Desc>(context_)
                           .set<&Desc::name>(text(data.name))
                           .set<&Desc::module>(text(data.moduleName))
                           .set<&Desc::routine>(text(data.routine))
                           .set<&Desc::type>(typeDesc(data.typeDesc))
                           .set<&Desc::task>(taskNumber(data.task))
                           .set<&Desc::kind>(abi::kindOf(data.kind))
                           .finish());
    return table<Desc>(rows, "routineData");
}

void ModuleEmitter::emitTables() {
    for (uint32_t i = 0; i < module_.typeDescs.size(); ++i)
        typeDesc(i)->setInitializer(typeDescValue(module_.typeDescs[i]));
    for (uint32_t i = 0; i < module_.routines.size(); ++i)
        routineDesc(i)->setInitializer(routineDescValue(module_.routines[i]));
    emitProgram();
}

void ModuleEmitter::emitProgram() {
    uint32_t routineCount = 0;
    const std::vector<DataDeclaration> data = listedData(module_), aliases = listedAliases(module_);
    llvm::Constant* aliasRows = dataTable(aliases, kAliasRows);
    llvm::Constant* globalRows = dataTable(data, kDataRows);
    llvm::Constant* routineRows = routineTable(routineCount);
    std::vector<llvm::Constant*> names, texts, types;
    for (uint32_t desc : module_.searchTypes)
        types.push_back(typeDesc(desc));
    for (const std::string& name : module_.configNames)
        names.push_back(text(name));
    for (const std::string& config : module_.configTexts)
        texts.push_back(text(config));
    using Desc = rt::ProgramDesc;
    llvm::Constant* value = abi::Row<Desc>(context_)
                                .set<&Desc::name>(text(module_.name))
                                .set<&Desc::tasks>(tasks())
                                .set<&Desc::taskCount>(module_.tasks.size())
                                .set<&Desc::globals>(globalRows)
                                .set<&Desc::globalCount>(data.size())
                                .set<&Desc::externals>(externals())
                                .set<&Desc::externalCount>(module_.externals.size())
                                .set<&Desc::routines>(routineRows)
                                .set<&Desc::routineCount>(routineCount)
                                .set<&Desc::configNames>(array(ptr_, names, "configNames"))
                                .set<&Desc::configTexts>(array(ptr_, texts, "configTexts"))
                                .set<&Desc::configCount>(texts.size())
                                .set<&Desc::moduleCount>(module_.modules.size())
                                .set<&Desc::modules>(moduleTable())
                                .set<&Desc::types>(array(ptr_, types, "searchTypes"))
                                .set<&Desc::routineData>(routineDataTable())
                                .set<&Desc::typeCount>(types.size())
                                .set<&Desc::routineDataCount>(module_.routineData.size())
                                .set<&Desc::reset>(entryOrNull(module_.unitReset))
                                .set<&Desc::folder>(text(module_.folder))
                                .set<&Desc::aliases>(aliasRows)
                                .set<&Desc::aliasCount>(aliases.size())
                                .set<&Desc::sources>(module_.sources.empty() ? null() : text(module_.sources))
                                .set<&Desc::sourcesSize>(module_.sources.size())
                                .finish();
    auto* program = llvm::cast<llvm::GlobalVariable>(
        target_->getOrInsertGlobal(kProgramSymbol, abi::structType<rt::ProgramDesc>(context_)));
    program->setConstant(true);
    program->setInitializer(value);
    program->setDSOLocal(true);
}

} // namespace codegen
