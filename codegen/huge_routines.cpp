#include "codegen/huge_routines.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include "codegen/paced_routines.h"

namespace codegen {
namespace {

/// LLVM instructions of a routine from which on the optimiser and the register allocator cost too much: about 400 movement
/// instructions. Their time grows with the square of the number of basic blocks.
constexpr unsigned kHugeFunction = 10'000;

/// Basic blocks of a routine from which on it gets few passes: the vectorizer of straight code and the register allocator need time
/// in proportion to the square of their number.
constexpr size_t kManyBlocks = 1000;

/// Different constants that the constant pool of a function finds fast enough.
constexpr size_t kFewConstants = 500;

/// Floating-point constants of one type in a function; the code generator searches those of its constant pool one by one.
class NumberTable {
  public:
    NumberTable(llvm::Function& function, llvm::Type* type) : function_(function), type_(type) {
        for (llvm::Instruction& inst : llvm::instructions(function))
            for (llvm::Use& use : inst.operands())
                if (isOurs(use)) uses_[llvm::cast<llvm::ConstantFP>(use)].push_back(&use);
    }

    /// Loads them from an array instead.
    void moveToMemory() {
        if (uses_.size() <= kFewConstants) return;
        std::vector<llvm::Constant*> numbers;
        for (const auto& [number, uses] : uses_)
            numbers.push_back(number);
        auto* const array = llvm::ArrayType::get(type_, numbers.size());
        auto* const table =
            new llvm::GlobalVariable(*function_.getParent(), array, true, llvm::GlobalValue::PrivateLinkage,
                                     llvm::ConstantArray::get(array, numbers));
        uint64_t index = 0;
        for (const auto& [number, uses] : uses_) {
            for (llvm::Use* use : uses) {
                llvm::IRBuilder<> b(llvm::cast<llvm::Instruction>(use->getUser()));
                use->set(b.CreateLoad(type_, b.CreateConstInBoundsGEP2_64(array, table, 0, index)));
            }
            ++index;
        }
    }

  private:
    /// 0 needs no memory.
    bool isOurs(const llvm::Use& use) const {
        const auto* number = llvm::dyn_cast<llvm::ConstantFP>(use.get());
        return number && number->getType() == type_ && !number->isExactlyValue(0.0) &&
               !llvm::isa<llvm::PHINode>(use.getUser());
    }

    llvm::Function& function_;
    llvm::Type* type_;
    llvm::MapVector<llvm::ConstantFP*, std::vector<llvm::Use*>> uses_;
};

} // namespace

bool spareHugeRoutines(llvm::Module& module) {
    bool found = false;
    for (llvm::Function& function : module) {
        if (function.getInstructionCount() <= kHugeFunction) continue;
        function.addFnAttr(llvm::Attribute::OptimizeNone);
        function.addFnAttr(llvm::Attribute::NoInline);
        NumberTable(function, llvm::Type::getFloatTy(module.getContext())).moveToMemory();
        NumberTable(function, llvm::Type::getDoubleTy(module.getContext())).moveToMemory();
        found = true;
    }
    return found;
}

void saveWorkOnLargeRoutines(llvm::Module& module) {
    for (llvm::Function& function : module)
        if (function.size() > kManyBlocks && !function.hasOptNone()) function.addFnAttr(kPaced);
}

} // namespace codegen
