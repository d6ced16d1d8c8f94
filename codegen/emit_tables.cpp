// The structures of rt_abi.h: type descriptions, statement tables, routine descriptions, the program description.

#include <cstddef>
#include <set>

#include "codegen/module_emitter.h"
#include "runtime/abi/rt_abi.h"

namespace codegen {

// Natural alignment makes LLVM's layout that of the C structures; these are the ones with gaps.
static_assert(offsetof(rt::TypeDesc, size) == 20 && offsetof(rt::TypeDesc, fields) == 40 &&
              sizeof(rt::TypeDesc) == 64);
static_assert(sizeof(rt::StmtDesc) == 24 && offsetof(rt::RoutineDesc, errorFilter) == 40 &&
              offsetof(rt::RoutineDesc, errorVariables) == 56);
static_assert(offsetof(rt::RoutineDesc, detachedHandler) == 96);
static_assert(sizeof(rt::LocalDesc) == 24 && offsetof(rt::RoutineDesc, locals) == 72);
static_assert(offsetof(rt::GlobalDesc, task) == 36 && offsetof(rt::RoutineEntry, address) == 24);
static_assert(offsetof(rt::RoutineEntry, late) == 40 && sizeof(rt::RoutineEntry) == 64);
static_assert(sizeof(rt::ParamDesc) == 24 && sizeof(rt::RoutineDataDesc) == 40 &&
              sizeof(rt::ModuleDesc) == 32);
static_assert(int{rt::kDataLocal} == ir::kDataLocal && int{rt::kDataPredefined} == ir::kDataPredefined);
static_assert(sizeof(rt::RoutineDesc) == 104 && sizeof(rt::TaskDesc) == 40 && sizeof(rt::GlobalDesc) == 56);
static_assert(sizeof(rt::ExternalDesc) == 40 && sizeof(rt::ProgramDesc) == 176);

static_assert(int{rt::kStmtCallsRoutine} == ir::kStmtCallsRoutine &&
              int{rt::kStmtCallsBackward} == ir::kStmtCallsBackward &&
              int{rt::kStmtForwardOnly} == ir::kStmtForwardOnly &&
              int{rt::kStmtInBackward} == ir::kStmtInBackward &&
              int{rt::kStmtMovement} == ir::kStmtMovement && int{rt::kStmtInHandler} == ir::kStmtInHandler);

namespace {

constexpr const char* kProgramSymbol = "rapidc_program";

llvm::GlobalVariable* placeholder(llvm::Module& module, llvm::Type* type, const std::string& name) {
    return new llvm::GlobalVariable(module, type, true, llvm::GlobalValue::PrivateLinkage, nullptr, name);
}

} // namespace

llvm::Constant* ModuleEmitter::i32(int64_t value) {
    return llvm::ConstantInt::getSigned(i32_, value);
}
llvm::Constant* ModuleEmitter::i8(int64_t value) {
    return llvm::ConstantInt::get(i8_, static_cast<uint64_t>(value) & 0xff);
}

llvm::Constant* ModuleEmitter::constant(llvm::Constant* value, const std::string& name) {
    auto* variable = new llvm::GlobalVariable(*target_, value->getType(), true,
                                              llvm::GlobalValue::PrivateLinkage, value, name);
    return variable;
}

llvm::Constant* ModuleEmitter::text(const std::string& value) {
    llvm::Constant*& known = texts_[value];
    if (!known) {
        known = constant(llvm::ConstantDataArray::getString(context_, value), "text");
        llvm::cast<llvm::GlobalVariable>(known)->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
        llvm::cast<llvm::GlobalVariable>(known)->setAlignment(llvm::Align(1));
    }
    return known;
}

llvm::Constant* ModuleEmitter::array(llvm::Type* element, const std::vector<llvm::Constant*>& values,
                                     const std::string& name) {
    if (values.empty()) return llvm::ConstantPointerNull::get(ptr_);
    return constant(llvm::ConstantArray::get(llvm::ArrayType::get(element, values.size()), values), name);
}

llvm::Constant* ModuleEmitter::fileName(uint32_t file) {
    if (file >= module_.files.size()) return llvm::ConstantPointerNull::get(ptr_);
    return text(module_.files[file]);
}

void ModuleEmitter::declareTables() {
    auto make = [&](const char* name, std::vector<llvm::Type*> fields) {
        return llvm::StructType::create(context_, fields, name);
    };
    llvm::Type* dims = llvm::ArrayType::get(i32_, 3);
    typeDescType_ = make("rt.TypeDesc", {ptr_, ptr_, i8_, i32_, i32_, dims, ptr_, ptr_, ptr_});
    stmtDescType_ = make("rt.StmtDesc", {i32_, i32_, i32_, i32_, i8_, i8_, i8_, i8_, i32_});
    localDescType_ = make("rt.LocalDesc", {ptr_, ptr_, i8_, i8_, i8_, i8_});
    routineDescType_ = make("rt.RoutineDesc", {ptr_, ptr_, ptr_, ptr_, i32_, i8_, i8_, i8_, i8_, ptr_, i32_,
                                               ptr_, i32_, i32_, ptr_, i32_, i8_, i8_, i8_, i8_, i32_, ptr_});
    taskDescType_ = make("rt.TaskDesc", {ptr_, ptr_, ptr_, ptr_, i8_});
    globalDescType_ = make("rt.GlobalDesc", {ptr_, ptr_, ptr_, ptr_, i8_, i8_, i32_, ptr_, i32_});
    externalDescType_ = make("rt.ExternalDesc", {ptr_, ptr_, ptr_, ptr_, i32_, i32_});
    routineEntryType_ = make("rt.RoutineEntry", {ptr_, ptr_, i32_, i8_, i8_, ptr_, ptr_, ptr_, ptr_, i32_});
    paramDescType_ = make("rt.ParamDesc", {ptr_, ptr_, i8_, i8_, i8_, i8_});
    routineDataType_ = make("rt.RoutineDataDesc", {ptr_, ptr_, ptr_, ptr_, i32_, i8_});
    moduleDescType_ = make("rt.ModuleDesc", {ptr_, ptr_, i32_, ptr_});
    programDescType_ =
        make("rt.ProgramDesc", {ptr_, ptr_, i32_, ptr_, i32_, ptr_, i32_, ptr_, i32_, ptr_, ptr_, i32_,
                                i32_, ptr_, ptr_, ptr_, i32_, i32_, ptr_, ptr_, ptr_, i32_, ptr_, i64_});
    for (const ir::TypeDesc& desc : module_.typeDescs)
        typeDescs_.push_back(placeholder(*target_, typeDescType_, "type." + desc.name));
    for (const ir::Routine& routine : module_.routines)
        routineDescs_.push_back(placeholder(*target_, routineDescType_, "routine." + routine.name));
}

llvm::Constant* ModuleEmitter::typeDescValue(const ir::TypeDesc& desc) {
    const ir::Type& type = module_.type(desc.type);
    std::vector<llvm::Constant*> fields, names, offsets;
    for (uint32_t part : desc.fieldDescs)
        fields.push_back(typeDescs_[part]);
    for (const std::string& name : desc.fieldNames)
        names.push_back(text(name));
    int64_t count = 0, dims[3] = {0, 0, 0};
    if (desc.kind == ir::DescKind::Record) {
        count = static_cast<int64_t>(type.fields.size());
        for (uint32_t f = 0; f < type.fields.size(); ++f)
            offsets.push_back(i32(module_.fieldOffset(desc.type, f)));
    } else if (desc.kind == ir::DescKind::Array) {
        count = 1;
        for (size_t i = 0; i < type.dims.size(); ++i)
            count *= dims[i] = type.dims[i];
    }
    llvm::Constant* dimValues =
        llvm::ConstantArray::get(llvm::ArrayType::get(i32_, 3), {i32(dims[0]), i32(dims[1]), i32(dims[2])});
    return llvm::ConstantStruct::get(
        typeDescType_, {text(desc.name), text(desc.baseName), i8(static_cast<int64_t>(desc.kind)),
                        i32(module_.size(desc.type)), i32(count), dimValues, array(ptr_, fields, "fields"),
                        array(ptr_, names, "fieldNames"), array(i32_, offsets, "offsets")});
}

namespace {

/// rt::StmtDesc::canStart. `starts`: of the statements before it.
int64_t startMark(const ir::Routine& routine, const ir::Statement& statement, std::set<ir::BlockId>& starts) {
    if (!routine.stepping || statement.start == ir::kNone) return rt::kCannotStart;
    return starts.insert(statement.start).second ? rt::kCanStart : rt::kStartsEarlier;
}

} // namespace

llvm::Constant* ModuleEmitter::routineDescValue(const ir::Routine& routine) {
    std::vector<llvm::Constant*> statements, filter, variables;
    std::set<ir::BlockId> starts;
    for (const ir::Statement& s : routine.statements)
        statements.push_back(llvm::ConstantStruct::get(
            stmtDescType_,
            {i32(s.line), i32(s.column), i32(s.endLine), i32(s.endColumn), i8(static_cast<int64_t>(s.kind)),
             i8(s.handled), i8(s.flags), i8(startMark(routine, s, starts)),
             i32(s.previous == ir::kNone ? -1 : int64_t{s.previous})}));
    std::vector<llvm::Constant*> locals;
    for (uint32_t local : describedLocals(routine)) {
        const ir::Local& l = routine.locals[local];
        llvm::Constant* type = l.typeDesc == ir::kNone
                                   ? static_cast<llvm::Constant*>(llvm::ConstantPointerNull::get(ptr_))
                                   : typeDescs_[l.typeDesc];
        locals.push_back(llvm::ConstantStruct::get(
            localDescType_,
            {text(l.name), type, i8(l.reference ? rt::LocalDesc::Reference : rt::LocalDesc::Value),
             i8(l.isParam), i8(l.rank), i8(0)}));
    }
    for (int32_t number : routine.errorFilter)
        filter.push_back(i32(number));
    for (uint32_t global : routine.errorFilterGlobals)
        variables.push_back(globals_[global]);
    llvm::Constant* detached =
        routine.detachedHandler == ir::kNone ? null() : cEntries_[routine.detachedHandler];
    return llvm::ConstantStruct::get(routineDescType_, {text(routine.displayName),
                                                        text(routine.moduleName),
                                                        fileName(routine.file),
                                                        array(stmtDescType_, statements, "statements"),
                                                        i32(static_cast<int64_t>(statements.size())),
                                                        i8(routine.errorHandler != ir::kNone),
                                                        i8(routine.undoHandler != ir::kNone),
                                                        i8(routine.noStepIn),
                                                        i8(routine.hasBackward),
                                                        array(i32_, filter, "filter"),
                                                        i32(static_cast<int64_t>(filter.size())),
                                                        array(ptr_, variables, "filterVariables"),
                                                        i32(static_cast<int64_t>(variables.size())),
                                                        i32(static_cast<int64_t>(locals.size())),
                                                        array(localDescType_, locals, "locals"),
                                                        i32(routine.line),
                                                        i8(routine.stepping),
                                                        i8(routine.callable),
                                                        i8(routine.isDetachedHandler),
                                                        i8(routine.isBuiltin),
                                                        i32(int64_t{routine.textHash}),
                                                        detached});
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
    std::vector<llvm::Constant*> rows;
    for (const ir::TaskEntry& task : module_.tasks) {
        llvm::Constant* reset = llvm::ConstantPointerNull::get(ptr_);
        if (task.reset != ir::kNone) reset = cEntries_[task.reset];
        rows.push_back(
            llvm::ConstantStruct::get(taskDescType_, {text(task.name), text(task.type), emitStart(task.entry),
                                                      reset, i8(task.motionTask)}));
    }
    return array(taskDescType_, rows, "tasks");
}

llvm::Constant* ModuleEmitter::globalTable(uint32_t& count) {
    std::vector<llvm::Constant*> rows;
    for (uint32_t i = 0; i < module_.globals.size(); ++i) {
        const ir::Global& global = module_.globals[i];
        // Constants that the compiler made for itself have no name that anybody could ask for.
        if (global.displayName.empty() || global.typeDesc == ir::kNone) continue;
        const int64_t task = taskNumber(global.task);
        // A unit has rows for persistents that lie in another one.
        const bool elsewhere = global.kind == ir::GlobalKind::External;
        const ir::GlobalKind kind = elsewhere ? ir::GlobalKind::Persistent : global.kind;
        rows.push_back(llvm::ConstantStruct::get(
            globalDescType_, {text(global.displayName), text(global.moduleName), globals_[i],
                              typeDescs_[global.typeDesc], i8(static_cast<int64_t>(kind)), i8(global.flags),
                              i32(task), fileName(global.file), i32(global.line)}));
    }
    count = static_cast<uint32_t>(rows.size());
    return array(globalDescType_, rows, "globals");
}

llvm::Constant* ModuleEmitter::aliasTable(uint32_t& count) {
    std::vector<llvm::Constant*> rows;
    for (const ir::GlobalAlias& alias : module_.aliases) {
        const ir::Global& global = module_.globals[alias.global];
        if (global.typeDesc == ir::kNone) continue; // as in globalTable
        rows.push_back(llvm::ConstantStruct::get(
            globalDescType_,
            {text(alias.displayName), text(alias.moduleName), globals_[alias.global],
             typeDescs_[global.typeDesc], i8(static_cast<int64_t>(global.kind)), i8(global.flags),
             i32(int64_t{alias.task}), fileName(alias.file), i32(alias.line)}));
    }
    count = static_cast<uint32_t>(rows.size());
    return array(globalDescType_, rows, "aliases");
}

llvm::Constant* ModuleEmitter::externals() {
    std::vector<llvm::Constant*> rows;
    for (const ir::ExternalRef& external : module_.externals)
        rows.push_back(llvm::ConstantStruct::get(
            externalDescType_, {text(external.name), text(external.kind), globals_[external.global],
                                fileName(external.file), i32(external.line), i32(external.column)}));
    return array(externalDescType_, rows, "externals");
}

llvm::Constant* ModuleEmitter::null() {
    return llvm::ConstantPointerNull::get(ptr_);
}

int64_t ModuleEmitter::taskNumber(uint32_t task) const {
    return task == ir::kNone ? -1 : int64_t{task};
}

/// The task a routine belongs to is the first part of its linkage name ("T_ROB1/MainModule/main"); -1 = any.
int64_t ModuleEmitter::taskOf(const ir::Routine& routine) {
    const std::string prefix = routine.name.substr(0, routine.name.find('/'));
    for (size_t t = 0; t < module_.tasks.size(); ++t)
        if (module_.tasks[t].name == prefix) return static_cast<int64_t>(t);
    return module_.unitTask;
}

llvm::Constant* ModuleEmitter::routineRow(uint32_t index, const ir::NamedRoutine& named) {
    const ir::Routine& routine = module_.routines[index];
    std::vector<llvm::Constant*> params;
    for (const ir::ParamEntry& param : named.params)
        params.push_back(llvm::ConstantStruct::get(
            paramDescType_,
            {text(param.name), param.typeDesc == ir::kNone ? null() : typeDescs_[param.typeDesc],
             i8(param.mode), i8(param.optional), i8(param.rank), i8(param.group)}));
    return llvm::ConstantStruct::get(
        routineEntryType_,
        {text(routine.displayName), text(routine.moduleName), i32(taskOf(routine)),
         i8(static_cast<int64_t>(named.kind)), i8(named.isLocal), cEntries_[index], routineDescs_[index],
         named.late ? emitLateEntry(named) : null(), array(paramDescType_, params, "params"),
         i32(static_cast<int64_t>(params.size()))});
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
    return array(routineEntryType_, rows, "routines");
}

llvm::Constant* ModuleEmitter::moduleTable() {
    std::vector<llvm::Constant*> rows;
    for (const ir::ModuleEntry& entry : module_.modules)
        rows.push_back(llvm::ConstantStruct::get(
            moduleDescType_, {text(entry.name), fileName(entry.file), i32(taskNumber(entry.task)),
                              entry.gone == ir::kNone ? null() : globals_[entry.gone]}));
    return array(moduleDescType_, rows, "modules");
}

llvm::Constant* ModuleEmitter::routineDataTable() {
    std::vector<llvm::Constant*> rows;
    for (const ir::RoutineData& data : module_.routineData)
        rows.push_back(llvm::ConstantStruct::get(routineDataType_,
                                                 {text(data.name), text(data.moduleName), text(data.routine),
                                                  typeDescs_[data.typeDesc], i32(taskNumber(data.task)),
                                                  i8(static_cast<int64_t>(data.kind))}));
    return array(routineDataType_, rows, "routineData");
}

void ModuleEmitter::emitTables() {
    for (uint32_t i = 0; i < module_.typeDescs.size(); ++i)
        typeDescs_[i]->setInitializer(typeDescValue(module_.typeDescs[i]));
    for (uint32_t i = 0; i < module_.routines.size(); ++i)
        routineDescs_[i]->setInitializer(routineDescValue(module_.routines[i]));
    emitProgram();
}

void ModuleEmitter::emitProgram() {
    uint32_t globalCount = 0, routineCount = 0, aliasCount = 0;
    llvm::Constant* aliasRows = aliasTable(aliasCount);
    llvm::Constant* globalRows = globalTable(globalCount);
    llvm::Constant* routineRows = routineTable(routineCount);
    std::vector<llvm::Constant*> names, texts, types;
    for (uint32_t desc : module_.searchTypes)
        types.push_back(typeDescs_[desc]);
    for (const std::string& name : module_.configNames)
        names.push_back(text(name));
    for (const std::string& config : module_.configTexts)
        texts.push_back(text(config));
    llvm::Constant* value = llvm::ConstantStruct::get(
        programDescType_, {text(module_.name),
                           tasks(),
                           i32(static_cast<int64_t>(module_.tasks.size())),
                           globalRows,
                           i32(globalCount),
                           externals(),
                           i32(static_cast<int64_t>(module_.externals.size())),
                           routineRows,
                           i32(routineCount),
                           array(ptr_, names, "configNames"),
                           array(ptr_, texts, "configTexts"),
                           i32(static_cast<int64_t>(texts.size())),
                           i32(static_cast<int64_t>(module_.modules.size())),
                           moduleTable(),
                           array(ptr_, types, "searchTypes"),
                           routineDataTable(),
                           i32(static_cast<int64_t>(types.size())),
                           i32(static_cast<int64_t>(module_.routineData.size())),
                           module_.unitReset == ir::kNone ? null() : cEntries_[module_.unitReset],
                           text(module_.folder),
                           aliasRows,
                           i32(int64_t{aliasCount}),
                           module_.sources.empty() ? null() : text(module_.sources),
                           llvm::ConstantInt::get(i64_, module_.sources.size())});
    auto* program =
        llvm::cast<llvm::GlobalVariable>(target_->getOrInsertGlobal(kProgramSymbol, programDescType_));
    program->setConstant(true);
    program->setInitializer(value);
    program->setDSOLocal(true);
}

} // namespace codegen
