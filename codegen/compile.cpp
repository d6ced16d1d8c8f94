#include "codegen/compile.h"

#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Verifier.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/Triple.h>

#include "codegen/module_emitter.h"

namespace codegen {

std::unique_ptr<llvm::TargetMachine> makeTargetMachine(const CodegenOptions& options, std::string& error) {
    [[maybe_unused]] static const bool kReady = [] {
        llvm::InitializeNativeTarget();
        llvm::InitializeNativeTargetAsmPrinter();
        return true;
    }();
    llvm::Triple triple(llvm::sys::getProcessTriple());
    const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple.str(), error);
    if (!target) return nullptr;
    llvm::TargetOptions targetOptions;
    targetOptions.AllowFPOpFusion = llvm::FPOpFusion::Strict;
    const char* cpu = triple.getArch() == llvm::Triple::x86_64 ? "x86-64-v2" : "generic";
    auto level = options.optimise ? llvm::CodeGenOptLevel::Default : llvm::CodeGenOptLevel::None;
    std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
        triple.str(), cpu, "", targetOptions, llvm::Reloc::PIC_, llvm::CodeModel::Small, level));
    if (!machine) error = "LLVM has no code generator for " + triple.str();
    return machine;
}

namespace {

void optimise(llvm::Module& module, llvm::TargetMachine& machine) {
    llvm::PipelineTuningOptions tuning;
    tuning.LoopVectorization = true;
    tuning.LoopInterleaving = true;
    tuning.SLPVectorization = true;
    llvm::PassBuilder builder(&machine, tuning);
    llvm::LoopAnalysisManager loops;
    llvm::FunctionAnalysisManager functions;
    llvm::CGSCCAnalysisManager sccs;
    llvm::ModuleAnalysisManager modules;
    builder.registerModuleAnalyses(modules);
    builder.registerCGSCCAnalyses(sccs);
    builder.registerFunctionAnalyses(functions);
    builder.registerLoopAnalyses(loops);
    builder.crossRegisterProxies(loops, functions, sccs, modules);
    builder.buildPerModuleDefaultPipeline(llvm::OptimizationLevel::O2).run(module, modules);
}

} // namespace

std::unique_ptr<llvm::Module> compile(const ir::Module& module, const CodegenOptions& options,
                                      llvm::TargetMachine& machine, llvm::LLVMContext& context,
                                      std::string& error) {
    std::unique_ptr<llvm::Module> result =
        ModuleEmitter(module, options, context)
            .run(machine.createDataLayout(), machine.getTargetTriple().str());
    std::string findings;
    llvm::raw_string_ostream stream(findings);
    if (llvm::verifyModule(*result, &stream)) {
        error = "internal error: LLVM rejects the module '" + module.name + "': " + stream.str();
        return nullptr;
    }
    if (options.optimise) optimise(*result, machine);
    return result;
}

bool generate(llvm::Module& module, llvm::TargetMachine& machine, llvm::CodeGenFileType type,
              llvm::SmallVectorImpl<char>& out, std::string& error) {
    llvm::raw_svector_ostream stream(out);
    llvm::legacy::PassManager passes;
    if (machine.addPassesToEmitFile(passes, stream, nullptr, type)) {
        error = "LLVM cannot write this kind of file for " + machine.getTargetTriple().str();
        return false;
    }
    passes.run(module);
    return true;
}

} // namespace codegen
