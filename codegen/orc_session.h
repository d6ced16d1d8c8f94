#pragma once
// In-memory linking: objects in, addresses out. Nothing is lazy here and there is no platform support, because start-up time
// is what counts.

#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/Support/MemoryBuffer.h>

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/codegen.h"

namespace codegen {

/// Moves the text of a failure to `error`. True when there is none.
bool take(llvm::Error failure, std::string& error);

class OrcSession {
  public:
    OrcSession() = default;
    OrcSession(const OrcSession&) = delete;
    OrcSession& operator=(const OrcSession&) = delete;
    ~OrcSession();

    /// Functions that LLVM's code generator calls by itself (memcpy, fmodf and the like) are looked up in the process.
    bool open(const llvm::DataLayout& layout, bool debugInfo, std::string& error);
    /// Makes symbols of the process known to all objects.
    bool define(const std::vector<NativeSymbol>& symbols, std::string& error);
    /// Links an object whose symbols all later objects see.
    bool addShared(std::unique_ptr<llvm::MemoryBuffer> object, std::string& error);
    /// The address of a symbol of the shared objects. Null and `error` when it cannot be linked.
    const void* find(const std::string& symbol, std::string& error);
    /// Links an object of its own, which sees the shared ones, and returns the address of its `symbol`.
    const void* addPrivate(std::unique_ptr<llvm::MemoryBuffer> object, const std::string& symbol,
                           std::string& error);

  private:
    void addDebugger();

    // The layer refers to the session and has to go first, yet the session ends before: see the destructor.
    std::unique_ptr<llvm::orc::ExecutionSession> session_;
    std::unique_ptr<llvm::orc::ObjectLinkingLayer> layer_;
    llvm::orc::JITDylib* shared_ = nullptr;
    unsigned parts_ = 0;
};

/// Addresses by name.
using SymbolTable = std::unordered_map<std::string_view, const void*>;
SymbolTable tableOf(const std::vector<NativeSymbol>& symbols);

/// "the program uses what this runtime does not implement: ...".
std::string notImplemented(const std::vector<std::string>& names);

/// Compiles the parts of a large program when they are called first. `module` must outlive the program.
std::unique_ptr<JitProgram> lazyJit(const ir::Module& module, const CodegenOptions& options,
                                    const std::vector<NativeSymbol>& symbols, std::string& error);

} // namespace codegen
