#include "codegen/abi_types.h"

#include <llvm/ADT/SmallVector.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/raw_ostream.h>

namespace codegen::abi::detail {

std::string structName(llvm::StringRef cppName) {
    std::string name;
    for (; !cppName.empty(); cppName = cppName.drop_front())
        if (!cppName.consume_front("::"))
            name += cppName.front();
        else
            name += '.', name += cppName.front();
    return name;
}

llvm::StructType* structNamed(llvm::LLVMContext& context, const std::string& name, const Field* fields,
                              size_t count) {
    if (llvm::StructType* known = llvm::StructType::getTypeByName(context, name)) return known;
    llvm::SmallVector<llvm::Type*, 32> types;
    for (size_t i = 0; i < count; ++i)
        types.push_back(fields[i].type(context));
    return llvm::StructType::create(context, types, name);
}

void wrongType(llvm::StringRef place, const llvm::Type& wanted, const llvm::Type& given) {
    std::string text;
    llvm::raw_string_ostream out(text);
    out << "internal error: a field of " << place << " has the type " << wanted << ", not " << given;
    llvm::report_fatal_error(llvm::StringRef(text));
}

} // namespace codegen::abi::detail
