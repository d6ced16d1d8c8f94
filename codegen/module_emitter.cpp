#include "codegen/module_emitter.h"

#include <algorithm>
#include <llvm/IR/Verifier.h>

#include "codegen/budget_loops.h"
#include "codegen/data_image.h"
#include "codegen/interpreted_routine.h"
#include "codegen/routine_emitter.h"
#include "codegen/task_frame.h"

namespace codegen {
namespace {

/// Instructions of the IR. LLVM inlines whatever is called only once, which makes one huge function of a typical program;
/// a call costs next to nothing beside a body of this size.
constexpr size_t kLargestInlined = 400;

constexpr unsigned kErrorsAreCold = 2000; // usual : error, in branch weights

} // namespace

ModuleEmitter::ModuleEmitter(const ir::Module& module, const CodegenOptions& options,
                             llvm::LLVMContext& context, const Part* part)
    : module_(module), options_(options), context_(context), part_(part),
      defined_(module.routines.size(), part == nullptr), copied_(module.routines.size(), false),
      routines_(module.routines.size()), natives_(module.natives.size()), cEntries_(module.routines.size()),
      globals_(module.globals.size()), typeDescs_(module.typeDescs.size()),
      routineDescs_(module.routines.size()) {
    if (part != nullptr) settingTaskFrame_ = part->settingTaskFrame;
    if (!settingTaskFrame_)
        settingTaskFrame_ = std::make_shared<const std::vector<bool>>(
            routinesSettingTaskFrame(module, options.optimise ? options.bodies : NativeBodies()));
    if (part == nullptr) return;
    for (const uint32_t index : part->routines)
        defined_[index] = true;
    for (const uint32_t index : part->copies)
        copied_[index] = !defined_[index];
}

std::unique_ptr<llvm::Module> ModuleEmitter::run(const llvm::DataLayout& layout, const std::string& triple) {
    target_ = std::make_unique<llvm::Module>(module_.name, context_);
    target_->setDataLayout(layout);
    target_->setTargetTriple(triple);
    target_->setPICLevel(llvm::PICLevel::BigPIC);
    target_->setPIELevel(llvm::PIELevel::Large);
    if (options_.debugInfo) debug_ = std::make_unique<DebugInfo>(module_, *target_, options_.optimise);
    declareTypes();
    declareRuntime();
    exported_ = module_.calledFromOutside();
    emitSafepointSlow();
    if (hasTables() && !dataInMemory())
        for (uint32_t i = 0; i < module_.globals.size(); ++i)
            if (isShared(module_.globals[i])) global(i);
    emitBodies();
    if (hasTables()) {
        for (uint32_t i = 0; i < module_.routines.size(); ++i)
            if (exported_[i]) emitCEntry(i);
        emitTables();
    }
    if (debug_) debug_->finish();
    return std::move(target_);
}

llvm::Type* ModuleEmitter::valueType(ir::TypeId type) {
    return type == ir::kBool ? llvm::Type::getInt1Ty(context_) : memoryType(type);
}

llvm::Type* ModuleEmitter::memoryType(ir::TypeId type) {
    switch (type) {
    case ir::kVoid: return llvm::Type::getVoidTy(context_);
    case ir::kBool:
    case ir::kI8: return i8_;
    case ir::kI16: return llvm::Type::getInt16Ty(context_);
    case ir::kI32: return i32_;
    case ir::kI64: return i64_;
    case ir::kF32: return llvm::Type::getFloatTy(context_);
    case ir::kF64: return llvm::Type::getDoubleTy(context_);
    case ir::kPtr: return ptr_;
    default: return llvm::ArrayType::get(i8_, module_.size(type));
    }
}

void ModuleEmitter::declareTypes() {
    ptr_ = llvm::PointerType::getUnqual(context_);
    i8_ = llvm::Type::getInt8Ty(context_);
    i32_ = llvm::Type::getInt32Ty(context_);
    i64_ = llvm::Type::getInt64Ty(context_);
    llvm::MDBuilder md(context_);
    unlikely_ = md.createBranchWeights(kErrorsAreCold, 1);
    tags_.root = md.createTBAARoot("rapidc");
    auto tag = [&](const std::string& name) {
        llvm::MDNode* node = md.createTBAAScalarTypeNode(name, tags_.root);
        return md.createTBAAStructTagNode(node, node, 0);
    };
    for (ir::TypeId t = ir::kBool; t < ir::kScalarTypes; ++t)
        tags_.data[t] = tag(ir::typeName(t));
    tags_.task = tag("task");
    tags_.frame = tag("frame");
}

void ModuleEmitter::declareRuntime() {
    const auto cold = [](auto callee) {
        callee.function()->setDoesNotThrow();
        callee.function()->addFnAttr(llvm::Attribute::Cold);
        return callee;
    };
    runtime_.raise = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_raise));
    runtime_.safepoint = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_safepoint));
    runtime_.nativeFailed = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_nativeFailed));
    runtime_.land = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_land));
    runtime_.takesError = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_takesError));
    runtime_.propagate = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_propagate));
    runtime_.handlerEnd = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_handlerEnd));
    runtime_.retry = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_retry));
    runtime_.stackOverflow = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_stackOverflow));
    runtime_.step = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_step));
    runtime_.chargeLater = cold(RAPIDC_DECLARE_RUNTIME(*target_, rt_chargeLater));
}

llvm::Constant* ModuleEmitter::initialValue(const ir::Global& global) {
    llvm::Type* type = memoryType(global.type);
    if (global.init.empty()) return llvm::Constant::getNullValue(type);
    const std::string image = initialBytes(module_, global);
    if (image.find_first_not_of('\0') == std::string::npos) return llvm::Constant::getNullValue(type);
    return llvm::ConstantDataArray::getRaw(image, image.size(), i8_);
}

llvm::GlobalVariable* ModuleEmitter::global(uint32_t index) {
    constexpr uint32_t kLargestKnown = 4096;
    llvm::GlobalVariable*& variable = globals_[index];
    if (variable) return variable;
    const ir::Global& global = module_.globals[index];
    const bool external = global.kind == ir::GlobalKind::External;
    // The value of a constant of another part is known, too.
    const bool isConstant = global.kind == ir::GlobalKind::Const;
    const bool isKnown = isConstant && (!isShared(global) || module_.size(global.type) <= kLargestKnown);
    const bool isHere = hasTables() && !(dataInMemory() && isShared(global));
    llvm::Constant* value = !external && (isHere || isKnown) ? initialValue(global) : nullptr;
    // Data of another unit may be absent: its address is null then.
    auto linkage = external ? llvm::GlobalValue::ExternalWeakLinkage : llvm::GlobalValue::InternalLinkage;
    const std::string name = external ? global.name : isShared(global) ? symbolOf(global) : "";
    variable = new llvm::GlobalVariable(*target_, value ? value->getType() : memoryType(global.type),
                                        isConstant, linkage, value, name);
    variable->setAlignment(llvm::Align(external ? module_.align(global.type) : alignmentOf(module_, global)));
    if (external) return variable;
    if (isShared(global)) share(*variable);
    if (!isHere && isShared(global) && value)
        variable->setLinkage(llvm::GlobalValue::AvailableExternallyLinkage);
    if (!part_) variable->setDSOLocal(true);
    return variable;
}

void ModuleEmitter::share(llvm::GlobalValue& value) const {
    if (!part_) return;
    value.setLinkage(llvm::GlobalValue::ExternalLinkage);
    // In memory a part is a library of its own.
    if (!part_->callsBySlot) value.setVisibility(llvm::GlobalValue::HiddenVisibility);
}

bool ModuleEmitter::isShared(const ir::Global& global) const {
    return !part_ || isNamedData(global);
}

bool ModuleEmitter::isSelfContained(const ir::Native& native) const {
    return options_.bodies.contains(native.symbol);
}

llvm::Function* ModuleEmitter::nativeFunction(uint32_t index) {
    llvm::Function*& function = natives_[index];
    if (function) return function;
    const ir::Native& native = module_.natives[index];
    bool constant = native.nativeClass == ir::NativeClass::Const;
    std::vector<llvm::Type*> params;
    if (!constant) params.push_back(ptr_);
    if (!constant && native.result != ir::kVoid) params.push_back(ptr_);
    size_t first = params.size();
    for (ir::TypeId param : native.params)
        params.push_back(memoryType(param));
    llvm::Type* result = constant ? memoryType(native.result) : i32_;
    auto* type = llvm::FunctionType::get(result, params, false);
    function = llvm::cast<llvm::Function>(target_->getOrInsertFunction(native.symbol, type).getCallee());
    function->setDoesNotThrow();
    // LLVM must not fold calls by the host's mathematical library: results are those of the run-time library.
    function->addFnAttr(llvm::Attribute::NoBuiltin);
    if (constant) {
        // Strings and records to be compared lie in memory: two calls with one address may differ.
        if (std::find(native.params.begin(), native.params.end(), ir::kPtr) != native.params.end())
            function->setOnlyReadsMemory();
        else
            function->setDoesNotAccessMemory();
        function->setWillReturn();
        if (native.result == ir::kBool) function->addRetAttr(llvm::Attribute::ZExt);
    }
    for (size_t i = 0; i < native.params.size(); ++i)
        if (native.params[i] == ir::kBool)
            function->addParamAttr(static_cast<unsigned>(first + i), llvm::Attribute::ZExt);
    return function;
}

llvm::Function* ModuleEmitter::routine(uint32_t index) {
    llvm::Function*& function = routines_[index];
    if (function) return function;
    const ir::Routine& routine = module_.routines[index];
    bool inMemory = !module_.isScalar(routine.result);
    std::vector<llvm::Type*> params{ptr_, ptr_};
    if (inMemory) params.push_back(ptr_);
    for (const ir::Param& param : routine.params)
        params.push_back(valueType(param.type));
    llvm::Type* result = i32_;
    if (!inMemory && routine.result != ir::kVoid)
        result = llvm::StructType::get(context_, {i32_, valueType(routine.result)});
    function = llvm::Function::Create(llvm::FunctionType::get(result, params, false),
                                      llvm::Function::InternalLinkage, symbolOf(routine), *target_);
    if (!copied_[index]) share(*function);
    function->setCallingConv(llvm::CallingConv::Fast);
    function->setDoesNotThrow();
    function->addFnAttr(llvm::Attribute::MustProgress);
    function->addFnAttr(kTakesTask);
    if (routine.insts.size() > kLargestInlined) function->addFnAttr(llvm::Attribute::NoInline);
    function->addParamAttr(0, llvm::Attribute::NoAlias);
    function->addParamAttr(0, llvm::Attribute::NonNull);
    function->addDereferenceableParamAttr(0, sizeof(rt::TaskCore));
    function->getArg(0)->setName("task");
    function->getArg(1)->setName("caller");
    if (inMemory) {
        function->addParamAttr(2, llvm::Attribute::NonNull);
        function->getArg(2)->setName("result");
    }
    return function;
}

llvm::FunctionCallee ModuleEmitter::callee(llvm::IRBuilderBase& b, uint32_t index) {
    llvm::Function* function = routine(index);
    if (!part_ || !part_->callsBySlot || defined_[index] || copied_[index]) return function;
    llvm::Constant* slots = target_->getOrInsertGlobal(kRoutineSlots, ptr_);
    return {function->getFunctionType(),
            b.CreateLoad(ptr_, b.CreateConstInBoundsGEP1_64(ptr_, slots, index), "routine")};
}

bool ModuleEmitter::countsCalls(uint32_t index) const {
    return part_ && part_->countsCalls && defined_[index];
}

llvm::Function* ModuleEmitter::cEntry(uint32_t index) {
    llvm::Function*& function = cEntries_[index];
    if (function || !exported_[index]) return function;
    const ir::Routine& routine = module_.routines[index];
    std::vector<llvm::Type*> params{ptr_, ptr_};
    if (routine.result != ir::kVoid) params.push_back(ptr_);
    for (const ir::Param& param : routine.params)
        params.push_back(memoryType(param.type));
    function = llvm::Function::Create(llvm::FunctionType::get(i32_, params, false),
                                      llvm::Function::InternalLinkage, routine.name + "$entry", *target_);
    share(*function);
    function->setDoesNotThrow();
    return function;
}

void ModuleEmitter::emitBodies() {
    for (uint32_t i = 0; i < module_.routines.size(); ++i)
        if (!defined_[i] && !copied_[i])
            continue;
        else if (isInterpreted(module_, module_.routines[i], options_))
            emitInterpreted(*this, i);
        else
            RoutineEmitter(*this, i).run();
}

/// C entry: Bool travels as a byte, a scalar result through a pointer.
void ModuleEmitter::emitCEntry(uint32_t index) {
    const ir::Routine& routine = module_.routines[index];
    llvm::Function* entry = cEntry(index);
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(context_, "", entry));
    bool inMemory = !module_.isScalar(routine.result);
    bool byValue = !inMemory && routine.result != ir::kVoid;
    std::vector<llvm::Value*> args{entry->getArg(0), entry->getArg(1)};
    unsigned next = 2;
    llvm::Value* slot = routine.result != ir::kVoid ? entry->getArg(next++) : nullptr;
    if (inMemory) args.push_back(slot);
    for (const ir::Param& param : routine.params) {
        llvm::Value* value = entry->getArg(next++);
        if (param.type == ir::kBool) value = b.CreateICmpNE(value, llvm::ConstantInt::get(i8_, 0));
        args.push_back(value);
    }
    llvm::CallInst* call = b.CreateCall(callee(b, index), args);
    call->setCallingConv(llvm::CallingConv::Fast);
    // The entry has no line table of its own: a body inlined here would lose its lines.
    call->setIsNoInline();
    if (!byValue) {
        call->setTailCall();
        b.CreateRet(call);
        return;
    }
    llvm::Value* value = b.CreateFreeze(b.CreateExtractValue(call, 1));
    if (routine.result == ir::kBool) value = b.CreateZExt(value, i8_);
    b.CreateStore(value, slot);
    b.CreateRet(b.CreateExtractValue(call, 0));
}

/// How the system starts a task: all parameters of the entry routine are optional and absent.
llvm::Function* ModuleEmitter::emitStart(uint32_t index) {
    const ir::Routine& routine = module_.routines[index];
    if (routine.params.empty()) return cEntry(index);
    llvm::Function* start = abi::makeFunction<rt::EntryFunction>(*target_, llvm::Function::InternalLinkage,
                                                                 routine.name + "$start")
                                .function();
    start->setDoesNotThrow();
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(context_, "", start));
    std::vector<llvm::Value*> args{start->getArg(0), start->getArg(1)};
    for (const ir::Param& param : routine.params)
        args.push_back(llvm::Constant::getNullValue(memoryType(param.type)));
    b.CreateRet(b.CreateCall(cEntry(index), args));
    return start;
}

llvm::Function* ModuleEmitter::emitLateEntry(const ir::NamedRoutine& named) {
    const ir::Routine& routine = module_.routines[named.routine];
    llvm::Function* late =
        abi::makeFunction<rt::LateEntry>(*target_, llvm::Function::InternalLinkage, routine.name + "$late")
            .function();
    late->setDoesNotThrow();
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(context_, "", late));
    std::vector<llvm::Value*> args{late->getArg(0), late->getArg(1)};
    if (routine.result != ir::kVoid) args.push_back(late->getArg(3));
    uint32_t next = 0;
    for (uint32_t i = 0; i < named.params.size(); ++i) {
        const ir::ParamEntry& param = named.params[i];
        const auto row = [&] {
            return b.CreateConstInBoundsGEP1_32(abi::structType<rt::LateArg>(context_), late->getArg(2), i);
        };
        llvm::Value* data = abi::loadField<&rt::LateArg::data>(b, row());
        const ir::TypeId wanted = routine.params[next++].type;
        if (param.typeDesc == ir::kNone)
            args.push_back(b.CreateZExt(b.CreateIsNotNull(data), i8_));
        else
            args.push_back(wanted == ir::kPtr ? data : b.CreateLoad(memoryType(wanted), data));
        for (unsigned k = 0; k < param.rank; ++k, ++next) {
            llvm::Value* type = abi::loadField<&rt::LateArg::type>(b, row());
            args.push_back(b.CreateLoad(i32_, abi::elementAddress<&rt::TypeDesc::dims>(b, type, k)));
        }
        if (param.passesName) {
            args.push_back(abi::loadField<&rt::LateArg::name>(b, row()));
            ++next;
        }
    }
    llvm::CallInst* call = b.CreateCall(cEntry(named.routine), args);
    call->setIsNoInline();
    b.CreateRet(call);
    return late;
}

/// Keeps every register, so that the loop around pays nothing for the path that is hardly ever taken.
void ModuleEmitter::emitSafepointSlow() {
    runtime_.safepointSlow =
        abi::makeFunction<SafepointSlow>(*target_, llvm::Function::InternalLinkage, "rapidc.safepoint");
    llvm::Function* function = runtime_.safepointSlow.function();
    function->setCallingConv(llvm::CallingConv::PreserveAll);
    function->setDoesNotThrow();
    function->addFnAttr(llvm::Attribute::NoInline);
    function->addFnAttr(llvm::Attribute::Cold);
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(context_, "", function));
    llvm::Value *task = function->getArg(0), *frame = function->getArg(1);
    abi::storeField<&rt::Frame::caller>(b, frame, function->getArg(2));
    abi::storeField<&rt::Frame::routine>(b, frame, function->getArg(3));
    abi::storeField<&rt::Frame::statement>(b, frame, function->getArg(4));
    // Routines that do not call natives leave the record of their caller in the task.
    llvm::Value* taskFrame = b.CreateConstInBoundsGEP1_64(i8_, task, abi::kOffsetOf<&rt::TaskCore::frame>);
    llvm::Value* before = b.CreateLoad(ptr_, taskFrame);
    llvm::CallInst* call = runtime_.safepoint.call(b, task, frame);
    b.CreateStore(before, taskFrame);
    b.CreateRet(call);
}

} // namespace codegen
