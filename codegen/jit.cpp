// In-memory compilation. The object is generated first and handed to ORC's linking layer: nothing lazy, no platform
// support, because start-up time is what counts.

#include <llvm/ADT/SmallVector.h>
#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/DebugObjectManagerPlugin.h>
#include <llvm/ExecutionEngine/Orc/EPCDebugObjectRegistrar.h>
#include <llvm/ExecutionEngine/Orc/ExecutionUtils.h>
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/ExecutionEngine/Orc/TaskDispatch.h>
#include <llvm/Support/MemoryBuffer.h>

#include <unordered_map>

#include "codegen/compile.h"
#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

extern "C" llvm::orc::shared::CWrapperFunctionResult
llvm_orc_registerJITLoaderGDBAllocAction(const char* data, size_t size);

namespace codegen {
namespace {

using SymbolTable = std::unordered_map<std::string_view, const void*>;

bool take(llvm::Error failure, std::string& error) {
    if (!failure) return true;
    error = llvm::toString(std::move(failure));
    return false;
}

class OrcProgram : public JitProgram {
  public:
    ~OrcProgram() override {
        if (session_) llvm::consumeError(session_->endSession());
    }

    const rt::ProgramDesc* program() const override { return program_; }

    bool load(std::unique_ptr<llvm::MemoryBuffer> object, const llvm::DataLayout& layout, bool debugInfo,
              const llvm::orc::SymbolMap& natives, std::string& error) {
        namespace orc = llvm::orc;
        auto& dylib = session_->createBareJITDylib("rapid");
        layer_ = std::make_unique<orc::ObjectLinkingLayer>(*session_);
        if (debugInfo) addDebugger();
        if (!natives.empty() && !take(dylib.define(orc::absoluteSymbols(natives)), error)) return false;
        // What LLVM's code generator calls on its own account: memcpy, fmodf and the like.
        auto process = orc::DynamicLibrarySearchGenerator::GetForCurrentProcess(layout.getGlobalPrefix());
        if (!process) return take(process.takeError(), error);
        dylib.addGenerator(std::move(*process));
        if (!take(layer_->add(dylib, std::move(object)), error)) return false;
        auto found = session_->lookup({&dylib}, kProgramSymbol);
        if (!found) return take(found.takeError(), error);
        program_ = found->getAddress().toPtr<const rt::ProgramDesc*>();
        return true;
    }

    bool open(std::string& error) {
        namespace orc = llvm::orc;
        auto control =
            orc::SelfExecutorProcessControl::Create(nullptr, std::make_unique<orc::InPlaceTaskDispatcher>());
        if (!control) return take(control.takeError(), error);
        session_ = std::make_unique<orc::ExecutionSession>(std::move(*control));
        session_->setErrorReporter([](llvm::Error failure) { llvm::consumeError(std::move(failure)); });
        return true;
    }

    llvm::orc::SymbolStringPtr intern(llvm::StringRef name) { return session_->intern(name); }

  private:
    /// Makes the debug information known to a debugger that is attached to this process.
    void addDebugger() {
        namespace orc = llvm::orc;
        auto registrar = std::make_unique<orc::EPCDebugObjectRegistrar>(
            *session_, orc::ExecutorAddr::fromPtr(&llvm_orc_registerJITLoaderGDBAllocAction));
        layer_->addPlugin(
            std::make_unique<orc::DebugObjectManagerPlugin>(*session_, std::move(registrar), true, true));
    }

    // The layer refers to the session and has to go first, yet the session ends before: see the destructor.
    std::unique_ptr<llvm::orc::ExecutionSession> session_;
    std::unique_ptr<llvm::orc::ObjectLinkingLayer> layer_;
    const rt::ProgramDesc* program_ = nullptr;
};

/// Addresses of everything `compiled` refers to. Names that the table lacks are collected in `missing`; functions that
/// LLVM put in by itself are left to the process.
llvm::orc::SymbolMap resolve(const llvm::Module& compiled, const ir::Module& module, const SymbolTable& table,
                             OrcProgram& program, std::vector<std::string>& missing) {
    llvm::orc::SymbolMap result;
    auto ours = [&](llvm::StringRef name) {
        if (name.starts_with("rt_")) return true;
        for (const ir::Native& native : module.natives)
            if (native.symbol == name) return true;
        return false;
    };
    auto visit = [&](const llvm::GlobalValue& value, llvm::JITSymbolFlags flags) {
        if (!value.isDeclaration() || value.use_empty()) return;
        auto found = table.find(std::string_view(value.getName().data(), value.getName().size()));
        if (found != table.end() && found->second)
            result[program.intern(value.getName())] = {llvm::orc::ExecutorAddr::fromPtr(found->second),
                                                       flags};
        else if (llvm::isa<llvm::GlobalVariable>(value) || ours(value.getName()))
            missing.push_back(value.getName().str());
    };
    auto callable = llvm::JITSymbolFlags::Exported | llvm::JITSymbolFlags::Callable;
    for (const llvm::Function& function : compiled.functions())
        if (!function.isIntrinsic()) visit(function, callable);
    for (const llvm::GlobalVariable& variable : compiled.globals())
        visit(variable, llvm::JITSymbolFlags::Exported);
    return result;
}

} // namespace

std::unique_ptr<JitProgram> jit(const ir::Module& module, const CodegenOptions& options,
                                const std::vector<NativeSymbol>& symbols, std::string& error) {
    auto machine = makeTargetMachine(options, error);
    if (!machine) return nullptr;
    llvm::LLVMContext context;
    auto compiled = compile(module, options, *machine, context, error);
    if (!compiled) return nullptr;

    auto program = std::make_unique<OrcProgram>();
    if (!program->open(error)) return nullptr;
    SymbolTable table;
    table.reserve(symbols.size());
    for (const NativeSymbol& symbol : symbols)
        table.emplace(symbol.name, symbol.address);
    std::vector<std::string> missing;
    llvm::orc::SymbolMap natives = resolve(*compiled, module, table, *program, missing);
    if (!missing.empty()) {
        error = "the program uses what this runtime does not implement:";
        for (const std::string& name : missing)
            error += ' ' + name;
        return nullptr;
    }

    llvm::DataLayout layout = compiled->getDataLayout();
    llvm::SmallVector<char, 0> bytes;
    if (!generate(*compiled, *machine, llvm::CodeGenFileType::ObjectFile, bytes, error)) return nullptr;
    auto object =
        llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(bytes.data(), bytes.size()), module.name);
    if (!program->load(std::move(object), layout, options.debugInfo, natives, error)) return nullptr;
    return program;
}

} // namespace codegen
