// Metadata of accesses by components of records (LLVM's type-based alias analysis). The language knows no two names of different
// types, or of different components, for one number.

#include <llvm/IR/MDBuilder.h>

#include <utility>

#include "codegen/module_emitter.h"

namespace codegen {

/// The node of a type. Arrays have that of their elements; strings are bytes, which only natives access.
llvm::MDNode* ModuleEmitter::accessNode(ir::TypeId type) {
    while (module_.types[type].kind == ir::TypeKind::Array)
        type = module_.types[type].element;
    if (module_.isScalar(type) && type != ir::kVoid)
        return llvm::cast<llvm::MDNode>(tags_.data[type]->getOperand(1));
    if (const auto known = accessNodes_.find(type); known != accessNodes_.end()) return known->second;
    llvm::MDBuilder md(context_);
    const std::string name = ir::typeName(type);
    llvm::MDNode* node = nullptr;
    if (module_.types[type].kind == ir::TypeKind::Record) {
        std::vector<std::pair<llvm::MDNode*, uint64_t>> members;
        for (uint32_t i = 0; i < module_.types[type].fields.size(); ++i)
            members.emplace_back(accessNode(module_.types[type].fields[i].type),
                                 module_.fieldOffset(type, i));
        node = md.createTBAAStructTypeNode(name, members);
    } else {
        node = md.createTBAAScalarTypeNode(name, tags_.root);
    }
    return accessNodes_[type] = node;
}

llvm::MDNode* ModuleEmitter::componentTag(ir::TypeId record, uint32_t offset, ir::TypeId scalar) {
    ir::TypeId part = record;
    uint32_t inPart = offset;
    while (module_.types[part].kind == ir::TypeKind::Record) {
        const auto count = static_cast<uint32_t>(module_.types[part].fields.size());
        uint32_t member = 0;
        while (member + 1 < count && module_.fieldOffset(part, member + 1) <= inPart)
            ++member;
        inPart -= module_.fieldOffset(part, member);
        part = module_.types[part].fields[member].type;
    }
    if (part != scalar || inPart != 0) return tags_.data[scalar];
    return llvm::MDBuilder(context_).createTBAAStructTagNode(accessNode(record), accessNode(scalar), offset);
}

} // namespace codegen
