#include "codegen/compile.h"

#include <llvm/Analysis/LazyCallGraph.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Verifier.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/CommandLine.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/Transforms/Scalar/LoopUnrollPass.h>

#include "codegen/budget_loops.h"
#include "codegen/cold_constants.h"
#include "codegen/constant_calls.h"
#include "codegen/finite_sums.h"
#include "codegen/huge_routines.h"
#include "codegen/integral_numbers.h"
#include "codegen/integral_values.h"
#include "codegen/module_emitter.h"
#include "codegen/native_bodies.h"
#include "codegen/paced_routines.h"
#include "codegen/peepholes.h"
#include "codegen/selected_sums.h"
#include "codegen/short_loops.h"
#include "codegen/slow_ways.h"
#include "codegen/small_copies.h"
#include "codegen/unchecked_rounds.h"
#include "codegen/whole_divisions.h"
#include "codegen/whole_starts.h"

namespace codegen {

std::unique_ptr<llvm::TargetMachine> makeTargetMachine(const CodegenOptions& options, std::string& error) {
    [[maybe_unused]] static const bool kReady = [] {
        llvm::InitializeNativeTarget();
        llvm::InitializeNativeTargetAsmPrinter();
        // Debug information has lines only. Tracking the places of variables would cost a tenth of code generation.
        const char* const arguments[] = {"rapidc", "-experimental-debug-variable-locations=false"};
        llvm::cl::ParseCommandLineOptions(2, arguments);
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

void runO2(llvm::Module& module, llvm::PassBuilder& builder) {
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

namespace {

const llvm::Function* functionOf(const llvm::Any& unit) {
    if (const auto* function = llvm::any_cast<const llvm::Function*>(&unit)) return *function;
    if (const auto* loop = llvm::any_cast<const llvm::Loop*>(&unit)) return (*loop)->getHeader()->getParent();
    if (const auto* scc = llvm::any_cast<const llvm::LazyCallGraph::SCC*>(&unit);
        scc != nullptr && (*scc)->size() == 1)
        return &(*scc)->begin()->getFunction();
    return nullptr;
}

/// The passes that routines paced by natives get, once each: variables into registers, each instruction only once.
class FewPasses {
  public:
    bool wants(llvm::StringRef pass, const llvm::Function& function) {
        const auto* found = std::find(std::begin(kFew), std::end(kFew), pass);
        if (found == std::end(kFew)) return false;
        unsigned& done = done_[&function];
        const unsigned bit = 1U << (found - std::begin(kFew));
        if ((done & bit) != 0) return false;
        done |= bit;
        return true;
    }

  private:
    static constexpr llvm::StringLiteral kFew[] = {"SROAPass", "EarlyCSEPass", "InstCombinePass",
                                                   "SimplifyCFGPass"};
    llvm::DenseMap<const llvm::Function*, unsigned> done_;
};

/// A routine, or a native with its body, to which all calls pass the same constant as an argument.
bool hasConstantArgument(const llvm::Function& function) {
    if (!function.hasFnAttribute(kTakesTask) && !function.hasFnAttribute(llvm::Attribute::InlineHint))
        return false;
    if (!function.hasLocalLinkage() || function.isDeclaration() || function.hasAddressTaken()) return false;
    for (unsigned i = 0; i < function.arg_size(); ++i) {
        const llvm::Value* passed = nullptr;
        const bool same = llvm::all_of(function.users(), [&](const llvm::User* user) {
            const llvm::Value* argument = llvm::cast<llvm::CallBase>(user)->getArgOperand(i);
            return llvm::isa<llvm::Constant>(argument) && argument == (passed ? passed : passed = argument);
        });
        if (same && passed) return true;
    }
    return false;
}

/// Module passes that would find nothing but take a tenth of the whole time: CalledValuePropagation follows pointers to functions, which
/// programs have in tables only; inside functions IPSCCP finds only what later passes find as well.
bool isUseless(llvm::StringRef pass, const llvm::Any& unit) {
    if (pass == "CalledValuePropagationPass") return true;
    const auto* module = llvm::any_cast<const llvm::Module*>(&unit);
    if (pass != "IPSCCPPass" || module == nullptr) return false;
    return llvm::none_of(**module, hasConstantArgument);
}

/// Makes calls after a failure, or when the budget is used up, and the instructions that prepare them count little when LLVM decides
/// which routines to inline: they are most of a short routine's body once its natives are inlined.
void discountColdCalls(llvm::Module& module) {
    constexpr const char* kPreparation = "30"; // six instructions, in LLVM's unit
    for (llvm::Function& function : module) {
        if (!function.hasFnAttribute(llvm::Attribute::Cold)) continue;
        function.addFnAttr("call-inline-cost", "0");
        function.addFnAttr("call-threshold-bonus", kPreparation);
    }
}

void optimise(llvm::Module& module, llvm::TargetMachine& machine) {
    llvm::PipelineTuningOptions tuning;
    tuning.LoopVectorization = true;
    tuning.LoopInterleaving = true;
    tuning.SLPVectorization = true;
    llvm::PassInstrumentationCallbacks callbacks;
    FewPasses few;
    callbacks.registerShouldRunOptionalPassCallback([&few](llvm::StringRef pass, const llvm::Any& unit) {
        const llvm::Function* function = functionOf(unit);
        if (function == nullptr) return !isUseless(pass, unit);
        if (function->hasOptNone()) return false;
        return !function->hasFnAttribute(kPaced) || few.wants(pass, *function);
    });
    llvm::PassBuilder builder(&machine, tuning, std::nullopt, &callbacks);
    builder.registerPeepholeEPCallback([](llvm::FunctionPassManager& passes, llvm::OptimizationLevel) {
        passes.addPass(SplitResults());
        passes.addPass(FiniteChecks());
        passes.addPass(ConstantCalls());
        passes.addPass(SmallCopies());
    });
    builder.registerScalarOptimizerLateEPCallback(
        [](llvm::FunctionPassManager& passes, llvm::OptimizationLevel) {
            passes.addPass(WholeChecks());
            passes.addPass(IntegralValues());
            passes.addPass(ShortLoops());
            passes.addPass(llvm::createFunctionToLoopPassAdaptor(llvm::LoopFullUnrollPass(2)));
        });
    builder.registerVectorizerStartEPCallback([](llvm::FunctionPassManager& passes, llvm::OptimizationLevel) {
        passes.addPass(WholeStarts());
        passes.addPass(WholeDivisions());
        passes.addPass(BudgetLoops());
        passes.addPass(UncheckedRounds());
    });
    builder.registerOptimizerLastEPCallback([](llvm::ModulePassManager& passes, llvm::OptimizationLevel) {
        llvm::FunctionPassManager last;
        last.addPass(SlowWays());
        last.addPass(FiniteSums());
        last.addPass(SelectedSums());
        last.addPass(ColdConstants());
        passes.addPass(llvm::createModuleToFunctionPassAdaptor(std::move(last)));
    });
    runO2(module, builder);
}

} // namespace

std::unique_ptr<llvm::Module> emit(const ir::Module& module, const CodegenOptions& options,
                                   llvm::TargetMachine& machine, llvm::LLVMContext& context,
                                   std::string& error, const Part* part) {
    context.setDiscardValueNames(!options.namesValues);
    std::unique_ptr<llvm::Module> result =
        ModuleEmitter(module, options, context, part)
            .run(machine.createDataLayout(), machine.getTargetTriple().str());
    std::string findings;
    llvm::raw_string_ostream stream(findings);
    if (llvm::verifyModule(*result, &stream)) {
        constexpr size_t kShown = 2000; // there may be a finding for each instruction
        error = "internal error: LLVM rejects the module '" + module.name +
                "': " + stream.str().substr(0, kShown);
        return nullptr;
    }
    return result;
}

bool finish(llvm::Module& module, const CodegenOptions& options, llvm::TargetMachine& machine,
            std::string& error) {
    const bool huge = spareHugeRoutines(module);
    if (!options.optimise) {
        replaceWholeDivisions(module);
        return true;
    }
    saveWorkOnLargeRoutines(module);
    if (!linkNativeBodies(module, options.bodies, error)) return false;
    discountColdCalls(module);
    optimise(module, machine);
    replaceWholeDivisions(module);
    for (llvm::Function& function : module) {
        if (!function.hasFnAttribute(kPaced)) continue;
        function.addFnAttr(llvm::Attribute::OptimizeNone);
        function.addFnAttr(llvm::Attribute::NoInline);
    }
    // One register allocator serves the whole module.
    if (huge) machine.setOptLevel(llvm::CodeGenOptLevel::None);
    return true;
}

std::unique_ptr<llvm::Module> compile(const ir::Module& module, const CodegenOptions& options,
                                      llvm::TargetMachine& machine, llvm::LLVMContext& context,
                                      std::string& error, const Part* part) {
    auto result = emit(module, options, machine, context, error, part);
    return result && finish(*result, options, machine, error) ? std::move(result) : nullptr;
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
