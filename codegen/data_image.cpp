#include "codegen/data_image.h"

#include <cstring>

namespace codegen {
namespace {

/// A plain word could be the name of a C function (memcpy) which LLVM calls by itself.
std::string internalName(const std::string& name) {
    return name.find_first_of("/$") == std::string::npos ? name + "$" : name;
}

void putBytes(std::string& image, size_t at, const void* source, size_t count) {
    std::memcpy(image.data() + at, source, count);
}

/// Lays flattened constant data out in memory, type by type.
class DataImage {
  public:
    DataImage(const ir::Module& module, const ir::ConstData& data) : module_(module), data_(data) {}

    std::string build(ir::TypeId type) {
        image_.assign(module_.size(type), '\0');
        place(type, 0);
        return std::move(image_);
    }

  private:
    void place(ir::TypeId type, size_t at) {
        const ir::Type& t = module_.type(type);
        if (t.kind == ir::TypeKind::Record) {
            for (uint32_t f = 0; f < t.fields.size(); ++f)
                place(t.fields[f].type, at + module_.fieldOffset(type, f));
        } else if (t.kind == ir::TypeKind::Array) {
            size_t size = module_.size(t.element), count = size ? module_.size(type) / size : 0;
            for (size_t i = 0; i < count; ++i)
                place(t.element, at + i * size);
        } else {
            scalar(data_[next_++], at);
        }
    }

    void scalar(const ir::ConstScalar& value, size_t at) {
        switch (value.kind) {
        case ir::TypeKind::Bool: image_[at] = value.integer != 0; break;
        case ir::TypeKind::I8: put(static_cast<int8_t>(value.integer), at); break;
        case ir::TypeKind::I16: put(static_cast<int16_t>(value.integer), at); break;
        case ir::TypeKind::I32: put(static_cast<int32_t>(value.integer), at); break;
        case ir::TypeKind::I64: put(value.integer, at); break;
        case ir::TypeKind::F32: put(static_cast<float>(value.number), at); break;
        case ir::TypeKind::F64: put(value.number, at); break;
        case ir::TypeKind::Str:
            put(static_cast<uint32_t>(value.text.size()), at);
            putBytes(image_, at + sizeof(uint32_t), value.text.data(), value.text.size());
            break;
        case ir::TypeKind::Void: // not scalars of constant data
        case ir::TypeKind::Ptr:
        case ir::TypeKind::Record:
        case ir::TypeKind::Array: break;
        }
    }

    template <class T> void put(const T& value, size_t at) { putBytes(image_, at, &value, sizeof value); }

    const ir::Module& module_;
    const ir::ConstData& data_;
    std::string image_;
    size_t next_ = 0;
};

/// Rows without description are not listed.
bool isDescribed(const ir::Global& global) {
    return global.typeDesc != ir::kNone;
}

} // namespace

std::string symbolOf(const ir::Routine& routine) {
    return internalName(routine.name);
}

std::string symbolOf(const ir::Global& global) {
    return internalName(global.name);
}

bool isNamedData(const ir::Global& global) {
    return global.kind != ir::GlobalKind::Const || !global.displayName.empty();
}

std::string initialBytes(const ir::Module& module, const ir::Global& global) {
    if (global.init.empty()) return std::string(module.size(global.type), '\0');
    return DataImage(module, global.init).build(global.type);
}

uint32_t alignmentOf(const ir::Module& module, const ir::Global& global) {
    constexpr uint32_t kVectorAlign = 16;
    return module.size(global.type) >= kVectorAlign ? kVectorAlign : module.align(global.type);
}

std::vector<DataDeclaration> listedData(const ir::Module& module) {
    std::vector<DataDeclaration> result;
    for (uint32_t i = 0; i < module.globals.size(); ++i) {
        const ir::Global& global = module.globals[i];
        // Constants that the compiler made for itself cannot be asked for by name.
        if (!global.displayName.empty() && isDescribed(global))
            result.push_back(
                {i, global.displayName, global.moduleName, global.task, global.file, global.line});
    }
    return result;
}

std::vector<DataDeclaration> listedAliases(const ir::Module& module) {
    std::vector<DataDeclaration> result;
    for (const ir::GlobalAlias& alias : module.aliases)
        if (isDescribed(module.globals[alias.global]))
            result.push_back(
                {alias.global, alias.displayName, alias.moduleName, alias.task, alias.file, alias.line});
    return result;
}

} // namespace codegen
