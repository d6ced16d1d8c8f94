// native_bodies: puts the bodies of small natives, compiled to LLVM bitcode, into one module that compiled programs
// inline from (codegen/native_bodies.h), and writes it as a C++ source. Stops at a native that cannot be inlined
// everywhere: remove its file from the list in stdlib/CMakeLists.txt.

#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/Bitcode/BitcodeWriter.h>
#include <llvm/IR/AttributeMask.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Linker/Linker.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/raw_ostream.h>

#include "codegen/compile.h"
#include "codegen/native_bodies.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace llvm::PatternMatch;

bool fail(const std::string& message) {
    std::fprintf(stderr, "native_bodies: %s\n", message.c_str());
    return false;
}

bool isNative(const llvm::Function& function) {
    return function.getName().starts_with("rt_");
}

bool readAll(const std::vector<std::string>& paths, llvm::Module& all) {
    for (const std::string& path : paths) {
        auto buffer = llvm::MemoryBuffer::getFile(path);
        if (!buffer) return fail(path + ": " + buffer.getError().message());
        auto module = llvm::parseBitcodeFile(**buffer, all.getContext());
        if (!module) return fail(path + ": " + llvm::toString(module.takeError()));
        if (all.getDataLayout().isDefault()) {
            all.setDataLayout((*module)->getDataLayout());
            all.setTargetTriple((*module)->getTargetTriple());
        }
        if (llvm::Linker::linkModules(all, std::move(*module)))
            return fail(path + " does not match the other files");
    }
    return true;
}

/// Removes traces of how the files were compiled, which would prevent inlining.
void stripOrigin(llvm::Module& module) {
    llvm::StripDebugInfo(module);
    while (!module.named_metadata_empty())
        module.eraseNamedMetadata(&*module.named_metadata_begin());
    llvm::AttributeMask origin;
    for (const char* name : {"target-cpu", "target-features", "tune-cpu", "frame-pointer",
                             "min-legal-vector-width", "no-trapping-math", "stack-protector-buffer-size"})
        origin.addAttribute(name);
    origin.addAttribute(llvm::Attribute::UWTable);
    for (llvm::Function& function : module)
        function.removeFnAttrs(origin);
}

/// Only natives can be reached from outside; the optimiser removes what they do not use.
void internalize(llvm::Module& module) {
    for (llvm::GlobalObject& object : module.global_objects()) {
        object.setComdat(nullptr);
        const auto* function = llvm::dyn_cast<llvm::Function>(&object);
        if (!object.isDeclaration() && !(function && isNative(*function)))
            object.setLinkage(llvm::GlobalValue::InternalLinkage);
        object.setVisibility(llvm::GlobalValue::DefaultVisibility);
    }
}

/// The square root of IEEE 754 has an instruction; the C library only sets errno besides.
void useSquareRoots(llvm::Module& module) {
    for (const char* name : {"sqrt", "sqrtf"}) {
        llvm::Function* library = module.getFunction(name);
        if (!library) continue;
        for (llvm::User* user : llvm::make_early_inc_range(library->users())) {
            auto* call = llvm::cast<llvm::CallInst>(user);
            llvm::IRBuilder<> b(call);
            call->replaceAllUsesWith(b.CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, call->getArgOperand(0)));
            call->eraseFromParent();
        }
        library->eraseFromParent();
    }
}

/// Notes an assumption about a loaded number at the load: so it stays known wherever the number gets to.
void noteRanges(llvm::Module& module) {
    for (llvm::Function& function : module) {
        for (llvm::Instruction& inst : llvm::make_early_inc_range(llvm::instructions(function))) {
            llvm::ICmpInst::Predicate predicate = llvm::ICmpInst::BAD_ICMP_PREDICATE;
            llvm::Instruction* number = nullptr;
            const llvm::APInt* limit = nullptr;
            if (!match(&inst, m_Intrinsic<llvm::Intrinsic::assume>(
                                  m_ICmp(predicate, m_Instruction(number), m_APInt(limit)))) ||
                predicate != llvm::ICmpInst::ICMP_ULT || !llvm::isa<llvm::LoadInst>(number))
                continue;
            const llvm::APInt none = llvm::APInt::getZero(limit->getBitWidth());
            number->setMetadata(llvm::LLVMContext::MD_range,
                                llvm::MDBuilder(module.getContext()).createRange(none, *limit));
            inst.eraseFromParent();
        }
    }
}

/// LLVM takes an assumption for a write. Functions that do nothing but read lose theirs: programs evaluate them when the
/// arguments are constants (codegen/constant_calls.h).
void dropAssumptionsOfReaders(llvm::Module& module) {
    const auto isAssumption = [](const llvm::Instruction& inst) {
        return match(&inst, m_Intrinsic<llvm::Intrinsic::assume>());
    };
    for (llvm::Function& function : module) {
        const auto all = llvm::instructions(function);
        if (std::any_of(all.begin(), all.end(), [&](const llvm::Instruction& inst) {
                return inst.mayWriteToMemory() && !isAssumption(inst);
            }))
            continue;
        for (llvm::Instruction& inst : llvm::make_early_inc_range(all))
            if (isAssumption(inst)) inst.eraseFromParent();
    }
}

/// A bool travels as a byte in programs (codegen/README.md); clang passes it as i1.
void passBoolsAsBytes(llvm::Module& module, llvm::Function& native) {
    llvm::Type *i1 = llvm::Type::getInt1Ty(module.getContext()),
               *i8 = llvm::Type::getInt8Ty(module.getContext());
    const auto asByte = [&](llvm::Type* type) { return type == i1 ? i8 : type; };
    std::vector<llvm::Type*> types;
    for (llvm::Type* type : native.getFunctionType()->params())
        types.push_back(asByte(type));
    auto* type = llvm::FunctionType::get(asByte(native.getReturnType()), types, false);
    if (type == native.getFunctionType()) return;
    const std::string name = native.getName().str();
    native.setName(name + ".body");
    native.setLinkage(llvm::GlobalValue::InternalLinkage);
    auto* outer = llvm::Function::Create(type, llvm::GlobalValue::ExternalLinkage, name, module);
    if (native.hasFnAttribute(llvm::Attribute::AlwaysInline)) outer->addFnAttr(llvm::Attribute::AlwaysInline);
    llvm::IRBuilder<> b(llvm::BasicBlock::Create(module.getContext(), "", outer));
    std::vector<llvm::Value*> args;
    for (llvm::Argument& arg : outer->args()) {
        const bool isBool = native.getFunctionType()->getParamType(arg.getArgNo()) == i1;
        args.push_back(isBool ? b.CreateICmpNE(&arg, b.getInt8(0)) : static_cast<llvm::Value*>(&arg));
    }
    llvm::Value* result = b.CreateCall(&native, args);
    if (result->getType() == i1) result = b.CreateZExt(result, i8);
    b.CreateRet(result);
}

/// Natives that others may call without being defined here. They take the text of an error and look at no frame record.
bool isErrorText(const llvm::Function& function) {
    return function.getName() == "rt_fail" || function.getName() == "rt_failWith";
}

/// Bodies may use what every program has: each other, texts of errors, the C library's mathematics and memory functions,
/// constants. So they look at no frame record, and programs fill it only when one has failed.
bool isSelfContained(const llvm::Module& module) {
    bool fine = true;
    for (const llvm::Function& function : module)
        if (function.isDeclaration() && !function.isIntrinsic() && !isErrorText(function) &&
            !codegen::isLibraryFunction(function.getName())) {
            const auto* user = llvm::dyn_cast<llvm::Instruction>(*function.user_begin());
            fine =
                fail((user ? user->getFunction()->getName().str() : std::string("data")) + " uses " +
                     function.getName().str() +
                     ", which a native that programs inline may not call: use functions of isLibraryFunction "
                     "(codegen/native_bodies.cpp), or another file than those of STDLIB_INLINED "
                     "(stdlib/CMakeLists.txt)");
        }
    for (const llvm::GlobalVariable& variable : module.globals())
        if (!variable.isConstant()) fine = fail("there would be several of " + variable.getName().str());
    return fine;
}

bool write(const llvm::Module& module, const std::string& path) {
    llvm::SmallVector<char, 0> bitcode;
    llvm::raw_svector_ostream stream(bitcode);
    llvm::WriteBitcodeToFile(module, stream);
    std::vector<std::string> names;
    for (const llvm::Function& function : module)
        if (!function.isDeclaration() && !function.hasLocalLinkage())
            names.push_back(function.getName().str());
    std::sort(names.begin(), names.end());
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out << "// Made by native_bodies.\n#include \"stdlib/native_bodies.h\"\n\nnamespace {\n"
        << "constexpr std::string_view kNames[] = {\n";
    for (const std::string& name : names)
        out << "    \"" << name << "\",\n";
    out << "};\nalignas(16) constexpr unsigned char kBitcode[] = {";
    for (size_t i = 0; i < bitcode.size(); ++i)
        out << (i % 32 == 0 ? "\n" : "") << static_cast<unsigned>(static_cast<unsigned char>(bitcode[i]))
            << ',';
    out << "};\n} // namespace\n\nnamespace rt {\n"
        << "std::string_view nativeBodies() {\n"
        << "    return {reinterpret_cast<const char*>(kBitcode), sizeof kBitcode};\n}\n"
        << "std::span<const std::string_view> nativesWithBody() {\n    return kNames;\n}\n} // namespace "
           "rt\n";
    out.close();
    return out ? true : fail("cannot write " + path);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4 || std::string_view(argv[1]) != "--out") {
        std::fputs("usage: native_bodies --out FILE.cpp FILE.bc...\n", stderr);
        return 3;
    }
    llvm::LLVMContext context;
    llvm::Module all("natives", context);
    if (!readAll({argv + 3, argv + argc}, all)) return 1;
    stripOrigin(all);
    internalize(all);
    useSquareRoots(all);
    noteRanges(all);
    dropAssumptionsOfReaders(all);
    std::vector<llvm::Function*> natives;
    for (llvm::Function& function : all)
        if (isNative(function) && !function.isDeclaration()) natives.push_back(&function);
    for (llvm::Function* native : natives)
        passBoolsAsBytes(all, *native);
    llvm::PassBuilder builder;
    codegen::runO2(all, builder);
    if (llvm::verifyModule(all, &llvm::errs())) return 1;
    return isSelfContained(all) && write(all, argv[2]) ? 0 : 1;
}
