// Object files and text.

#include <llvm/ADT/SmallVector.h>
#include <llvm/Support/FileSystem.h>
#include <llvm/Support/raw_ostream.h>

#include "codegen/compile.h"

namespace codegen {

bool compileTo(const ir::Module& module, const CodegenOptions& options, llvm::CodeGenFileType type,
               llvm::SmallVectorImpl<char>& out, std::string& error) {
    auto machine = makeTargetMachine(options, error);
    if (!machine) return false;
    llvm::LLVMContext context;
    auto compiled = compile(module, options, *machine, context, error);
    return compiled && generate(*compiled, *machine, type, out, error);
}

bool emitObject(const ir::Module& module, const std::string& path, const CodegenOptions& options,
                std::string& error) {
    llvm::SmallVector<char, 0> bytes;
    if (!compileTo(module, options, llvm::CodeGenFileType::ObjectFile, bytes, error)) return false;
    std::error_code failure;
    llvm::raw_fd_ostream file(path, failure);
    if (!failure) {
        file.write(bytes.data(), bytes.size());
        file.close();
        failure = file.error();
        file.clear_error();
    }
    if (failure) error = "cannot write " + path + ": " + failure.message();
    return !failure;
}

std::string emitLlvm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    auto machine = makeTargetMachine(options, error);
    if (!machine) return {};
    llvm::LLVMContext context;
    auto compiled = compile(module, options, *machine, context, error);
    if (!compiled) return {};
    std::string text;
    llvm::raw_string_ostream stream(text);
    compiled->print(stream, nullptr);
    return stream.str();
}

std::string emitAsm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    llvm::SmallVector<char, 0> text;
    if (!compileTo(module, options, llvm::CodeGenFileType::AssemblyFile, text, error)) return {};
    return {text.data(), text.size()};
}

} // namespace codegen
