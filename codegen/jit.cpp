// In-memory compilation of a whole program. Large ones are compiled in parts (lazy_jit.cpp).

#include <llvm/ADT/SmallVector.h>

#include "codegen/compile.h"
#include "codegen/orc_session.h"
#include "ir/core/execution_bound.h"
#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

namespace codegen {
namespace {

/// IR instructions that quick code executes in less than a millisecond.
constexpr double kFewInstructions = 100'000;

class OrcProgram : public JitProgram {
  public:
    const rt::ProgramDesc* program() const override { return program_; }

    bool load(std::unique_ptr<llvm::MemoryBuffer> object, std::string& error) {
        if (!session_.addShared(std::move(object), error)) return false;
        program_ = static_cast<const rt::ProgramDesc*>(session_.find(kProgramSymbol, error));
        return program_ != nullptr;
    }
    OrcSession& session() { return session_; }

  private:
    OrcSession session_;
    const rt::ProgramDesc* program_ = nullptr;
};

/// Addresses of everything `compiled` refers to. Names that the table lacks are collected in `missing`; functions that
/// LLVM put in by itself are left to the process.
std::vector<NativeSymbol> resolve(const llvm::Module& compiled, const ir::Module& module,
                                  const SymbolTable& table, std::vector<std::string>& missing) {
    std::vector<NativeSymbol> result;
    auto ours = [&](llvm::StringRef name) {
        if (name.starts_with("rt_")) return true;
        for (const ir::Native& native : module.natives)
            if (native.symbol == name) return true;
        return false;
    };
    auto visit = [&](const llvm::GlobalValue& value) {
        if (!value.isDeclaration() || value.use_empty()) return;
        auto found = table.find(std::string_view(value.getName().data(), value.getName().size()));
        if (found != table.end() && found->second)
            result.push_back({found->first, found->second});
        else if (llvm::isa<llvm::GlobalVariable>(value) || ours(value.getName()))
            missing.push_back(value.getName().str());
    };
    for (const llvm::Function& function : compiled.functions())
        if (!function.isIntrinsic()) visit(function);
    for (const llvm::GlobalVariable& variable : compiled.globals())
        visit(variable);
    return result;
}

} // namespace

std::unique_ptr<JitProgram> jit(const ir::Module& module, const CodegenOptions& given,
                                const std::vector<NativeSymbol>& symbols, std::string& error) {
    CodegenOptions options = given;
    const size_t size = module.instructionCount();
    if (given.isExecutedOnce && size <= kLargeProgram && ir::mostExecuted(module) <= kFewInstructions)
        options.optimise = false;
    if (size > given.partsAbove) return lazyJit(module, options, symbols, error);
    auto machine = makeTargetMachine(options, error);
    if (!machine) return nullptr;
    llvm::LLVMContext context;
    auto compiled = compile(module, options, *machine, context, error);
    if (!compiled) return nullptr;

    auto program = std::make_unique<OrcProgram>();
    if (!program->session().open(compiled->getDataLayout(), options.debugInfo, error)) return nullptr;
    const SymbolTable table = tableOf(symbols);
    std::vector<std::string> missing;
    const std::vector<NativeSymbol> natives = resolve(*compiled, module, table, missing);
    if (!missing.empty()) {
        error = notImplemented(missing);
        return nullptr;
    }
    if (!program->session().define(natives, error)) return nullptr;
    llvm::SmallVector<char, 0> bytes;
    if (!generate(*compiled, *machine, llvm::CodeGenFileType::ObjectFile, bytes, error)) return nullptr;
    auto object =
        llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(bytes.data(), bytes.size()), module.name);
    if (!program->load(std::move(object), error)) return nullptr;
    return program;
}

} // namespace codegen
