#include <algorithm>

#include "ir/core/ir.h"

namespace ir {
namespace {

constexpr uint32_t kStringLength = sizeof(uint32_t); // comes before the bytes

uint32_t alignUp(uint32_t value, uint32_t align) {
    return (value + align - 1) / align * align;
}

} // namespace

std::string typeName(TypeId type) {
    constexpr std::string_view kNames[] = {"void", "bool", "i8", "i16", "i32", "i64", "f32", "f64", "ptr"};
    return type <= kPtr ? std::string(kNames[type]) : "%" + std::to_string(type);
}

Module::Module() {
    for (TypeKind kind : {TypeKind::Void, TypeKind::Bool, TypeKind::I8, TypeKind::I16, TypeKind::I32,
                          TypeKind::I64, TypeKind::F32, TypeKind::F64, TypeKind::Ptr}) {
        Type type;
        type.kind = kind;
        types.push_back(std::move(type));
    }
}

size_t Module::instructionCount() const {
    size_t count = 0;
    for (const Routine& routine : routines)
        count += routine.insts.size();
    return count;
}

std::vector<bool> Module::calledFromOutside() const {
    std::vector<bool> result(routines.size(), false);
    const auto add = [&](uint32_t index) {
        if (index != kNone) result[index] = true;
    };
    for (uint32_t i = 0; i < routines.size(); ++i) {
        if (routines[i].exported) add(i);
        add(routines[i].detachedHandler);
    }
    for (const TaskEntry& task : tasks) {
        add(task.entry);
        add(task.reset);
    }
    add(unitReset);
    return result;
}

TypeId Module::arrayOf(TypeId element, std::vector<int32_t> dims) {
    for (TypeId id = 0; id < types.size(); ++id) {
        const Type& t = types[id];
        if (t.kind == TypeKind::Array && t.element == element && t.dims == dims) return id;
    }
    Type type;
    type.kind = TypeKind::Array;
    type.element = element;
    type.dims = std::move(dims);
    types.push_back(std::move(type));
    return static_cast<TypeId>(types.size() - 1);
}

TypeId Module::stringOf(uint32_t capacity) {
    for (TypeId id = 0; id < types.size(); ++id)
        if (types[id].kind == TypeKind::Str && types[id].capacity == capacity) return id;
    Type type;
    type.kind = TypeKind::Str;
    type.capacity = capacity;
    types.push_back(std::move(type));
    return static_cast<TypeId>(types.size() - 1);
}

TypeId Module::addRecord(std::string recordName, std::vector<Field> fields) {
    Type type;
    type.kind = TypeKind::Record;
    type.name = std::move(recordName);
    type.fields = std::move(fields);
    types.push_back(std::move(type));
    return static_cast<TypeId>(types.size() - 1);
}

uint32_t Module::size(TypeId id) const {
    const Type& t = types[id];
    switch (t.kind) {
    case TypeKind::Void: return 0;
    case TypeKind::Bool:
    case TypeKind::I8: return 1;
    case TypeKind::I16: return 2;
    case TypeKind::I32:
    case TypeKind::F32: return 4;
    case TypeKind::I64:
    case TypeKind::F64:
    case TypeKind::Ptr: return 8;
    case TypeKind::Str: return alignUp(kStringLength + t.capacity, kStringLength);
    case TypeKind::Record: {
        uint32_t offset = 0;
        for (const Field& field : t.fields)
            offset = alignUp(offset, align(field.type)) + size(field.type);
        return alignUp(offset, align(id));
    }
    case TypeKind::Array: {
        uint32_t total = size(t.element);
        for (int32_t dim : t.dims)
            total *= static_cast<uint32_t>(dim);
        return total;
    }
    }
    return 0;
}

uint32_t Module::align(TypeId id) const {
    const Type& t = types[id];
    switch (t.kind) {
    case TypeKind::Void:
    case TypeKind::Bool:
    case TypeKind::I8: return 1;
    case TypeKind::I16: return 2;
    case TypeKind::I32:
    case TypeKind::F32:
    case TypeKind::Str: return 4;
    case TypeKind::I64:
    case TypeKind::F64:
    case TypeKind::Ptr: return 8;
    case TypeKind::Record: {
        uint32_t result = 1;
        for (const Field& field : t.fields)
            result = std::max(result, align(field.type));
        return result;
    }
    case TypeKind::Array: return align(t.element);
    }
    return 1;
}

uint32_t Module::fieldOffset(TypeId record, uint32_t field) const {
    const Type& t = types[record];
    uint32_t offset = 0;
    for (uint32_t i = 0;; ++i) {
        offset = alignUp(offset, align(t.fields[i].type));
        if (i == field) return offset;
        offset += size(t.fields[i].type);
    }
}

uint32_t Module::findRoutine(std::string_view routineName) const {
    for (uint32_t i = 0; i < routines.size(); ++i)
        if (routines[i].name == routineName) return i;
    return kNone;
}

} // namespace ir
