#include "codegen/orc_session.h"

#include <llvm/ExecutionEngine/Orc/DebugObjectManagerPlugin.h>
#include <llvm/ExecutionEngine/Orc/EPCDebugObjectRegistrar.h>
#include <llvm/ExecutionEngine/Orc/ExecutionUtils.h>
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#include <llvm/ExecutionEngine/Orc/TaskDispatch.h>

extern "C" llvm::orc::shared::CWrapperFunctionResult
llvm_orc_registerJITLoaderGDBAllocAction(const char* data, size_t size);

namespace codegen {

namespace orc = llvm::orc;

bool take(llvm::Error failure, std::string& error) {
    if (!failure) return true;
    error = llvm::toString(std::move(failure));
    return false;
}

SymbolTable tableOf(const std::vector<NativeSymbol>& symbols) {
    SymbolTable table;
    table.reserve(symbols.size());
    for (const NativeSymbol& symbol : symbols)
        table.emplace(symbol.name, symbol.address);
    return table;
}

std::string notImplemented(const std::vector<std::string>& names) {
    std::string text = "the program uses what this runtime does not implement:";
    for (const std::string& name : names)
        text += ' ' + name;
    return text;
}

OrcSession::~OrcSession() {
    if (session_) llvm::consumeError(session_->endSession());
}

bool OrcSession::open(const llvm::DataLayout& layout, bool debugInfo, std::string& error) {
    auto control =
        orc::SelfExecutorProcessControl::Create(nullptr, std::make_unique<orc::InPlaceTaskDispatcher>());
    if (!control) return take(control.takeError(), error);
    session_ = std::make_unique<orc::ExecutionSession>(std::move(*control));
    session_->setErrorReporter([](llvm::Error failure) { llvm::consumeError(std::move(failure)); });
    shared_ = &session_->createBareJITDylib("rapid");
    layer_ = std::make_unique<orc::ObjectLinkingLayer>(*session_);
    if (debugInfo) addDebugger();
    auto process = orc::DynamicLibrarySearchGenerator::GetForCurrentProcess(layout.getGlobalPrefix());
    if (!process) return take(process.takeError(), error);
    shared_->addGenerator(std::move(*process));
    return true;
}

bool OrcSession::define(const std::vector<NativeSymbol>& symbols, std::string& error) {
    if (symbols.empty()) return true;
    orc::SymbolMap map;
    for (const NativeSymbol& symbol : symbols)
        map[session_->intern(llvm::StringRef(symbol.name.data(), symbol.name.size()))] = {
            orc::ExecutorAddr::fromPtr(symbol.address),
            llvm::JITSymbolFlags::Exported | llvm::JITSymbolFlags::Callable};
    return take(shared_->define(orc::absoluteSymbols(std::move(map))), error);
}

bool OrcSession::addShared(std::unique_ptr<llvm::MemoryBuffer> object, std::string& error) {
    return take(layer_->add(*shared_, std::move(object)), error);
}

const void* OrcSession::find(const std::string& symbol, std::string& error) {
    auto found = session_->lookup({shared_}, symbol);
    if (!found) {
        take(found.takeError(), error);
        return nullptr;
    }
    return found->getAddress().toPtr<const void*>();
}

const void* OrcSession::addPrivate(std::unique_ptr<llvm::MemoryBuffer> object, const std::string& symbol,
                                   std::string& error) {
    orc::JITDylib& own = session_->createBareJITDylib("part" + std::to_string(++parts_));
    own.addToLinkOrder(*shared_);
    if (!take(layer_->add(own, std::move(object)), error)) return nullptr;
    auto found = session_->lookup({&own}, symbol);
    if (!found) {
        take(found.takeError(), error);
        return nullptr;
    }
    return found->getAddress().toPtr<const void*>();
}

/// Makes the debug information known to a debugger that is attached to this process.
void OrcSession::addDebugger() {
    auto registrar = std::make_unique<orc::EPCDebugObjectRegistrar>(
        *session_, orc::ExecutorAddr::fromPtr(&llvm_orc_registerJITLoaderGDBAllocAction));
    layer_->addPlugin(
        std::make_unique<orc::DebugObjectManagerPlugin>(*session_, std::move(registrar), true, true));
}

} // namespace codegen
