#include "codegen/native_bodies.h"

#include <llvm/ADT/StringSwitch.h>
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Linker/Linker.h>

#include <algorithm>
#include <vector>

namespace codegen {
namespace {

/// LLVM knows these by name and nature, and emits instructions for short ones.
bool isMemoryFunction(llvm::StringRef name) {
    return llvm::StringSwitch<bool>(name)
        .Cases("memcpy", "memmove", "memset", "memcmp", "bcmp", "memchr", "strlen", true)
        .Default(false);
}

} // namespace

bool isLibraryFunction(llvm::StringRef name) {
    return isMemoryFunction(name) ||
           llvm::StringSwitch<bool>(name)
               .Cases("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "pow", true)
               .Cases("fmod", "fmodf", "remquo", "round", "roundf", "sincos", true)
               .Default(false);
}

bool linkNativeBodies(llvm::Module& program, const NativeBodies& bodies, std::string& error) {
    std::vector<llvm::Function*> wanted;
    for (llvm::Function& function : program) {
        if (function.isDeclaration() && !function.use_empty() && bodies.contains(function.getName()))
            wanted.push_back(&function);
    }
    if (wanted.empty()) return true;
    std::vector<std::string> names;
    for (const llvm::Function* function : wanted)
        names.push_back(function->getName().str());
    auto library = llvm::getLazyBitcodeModule(
        llvm::MemoryBufferRef({bodies.bitcode.data(), bodies.bitcode.size()}, "natives"),
        program.getContext());
    if (!library) {
        error = "internal error: " + llvm::toString(library.takeError());
        return false;
    }
    if (llvm::Linker::linkModules(program, std::move(*library), llvm::Linker::Flags::LinkOnlyNeeded)) {
        error = "internal error: the bodies of natives do not match the program";
        return false;
    }
    for (const std::string& name : names) {
        llvm::Function* function = program.getFunction(name);
        function->setLinkage(llvm::GlobalValue::InternalLinkage);
        function->addFnAttr(llvm::Attribute::InlineHint);
        if (!function->hasFnAttribute(llvm::Attribute::AlwaysInline)) continue;
        // Inlined in any case, but with other routines: the pass that does so beforehand computes frequencies of blocks.
        function->removeFnAttr(llvm::Attribute::AlwaysInline);
        function->addFnAttr("function-inline-cost", "0");
    }
    // It only computes, and so may be done before a loop; LLVM does not say so of instructions of one processor.
    if (llvm::Function* shuffle = program.getFunction("llvm.x86.ssse3.pshuf.b.128"))
        shuffle->addFnAttr(llvm::Attribute::Speculatable);
    for (llvm::Function& function : program) {
        if (!function.isDeclaration() || !isLibraryFunction(function.getName()) ||
            isMemoryFunction(function.getName()))
            continue;
        function.addFnAttr(llvm::Attribute::NoBuiltin);
        function.setDoesNotThrow();
        function.setWillReturn();
        if (function.getReturnType()->isFloatingPointTy() && function.getName() != "remquo")
            function.setDoesNotAccessMemory(); // nothing looks at errno
    }
    return true;
}

} // namespace codegen
