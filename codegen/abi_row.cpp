#include "codegen/abi_row.h"

#include <llvm/ADT/SmallVector.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/MathExtras.h>

namespace codegen::abi::detail {

llvm::Constant* integer(llvm::Type* type, int64_t value, bool isSigned) {
    const unsigned bits = type->getIntegerBitWidth();
    if (bits < 64 &&
        !(isSigned ? llvm::isIntN(bits, value) : llvm::isUIntN(bits, static_cast<uint64_t>(value))))
        llvm::report_fatal_error(llvm::Twine("internal error: a field of ") + llvm::Twine(bits) +
                                 " bits cannot hold " + llvm::Twine(value));
    return llvm::ConstantInt::get(type, static_cast<uint64_t>(value), isSigned);
}

llvm::Constant* integers(llvm::Type* arrayType, llvm::ArrayRef<int64_t> values, bool isSigned) {
    llvm::SmallVector<llvm::Constant*, 4> elements;
    for (int64_t value : values)
        elements.push_back(integer(arrayType->getArrayElementType(), value, isSigned));
    return llvm::ConstantArray::get(llvm::cast<llvm::ArrayType>(arrayType), elements);
}

llvm::Constant* functionOf(llvm::Function* function, llvm::FunctionType* wanted, llvm::StringRef place) {
    if (function == nullptr)
        return llvm::ConstantPointerNull::get(llvm::PointerType::getUnqual(wanted->getContext()));
    if (function->getFunctionType() != wanted) wrongType(place, *wanted, *function->getFunctionType());
    return function;
}

} // namespace codegen::abi::detail
