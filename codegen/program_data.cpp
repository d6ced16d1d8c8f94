#include "codegen/program_data.h"

#include <algorithm>
#include <cstring>

#include "codegen/abi_kinds.h"
#include "codegen/module_emitter.h"

namespace codegen {

bool ProgramData::canHold(const ir::Module& module) {
    return std::none_of(module.globals.begin(), module.globals.end(),
                        [](const ir::Global& global) { return global.kind == ir::GlobalKind::External; });
}

ProgramData::ProgramData(const ir::Module& module)
    : module_(module), listed_(listedData(module)), listedAliases_(codegen::listedAliases(module)),
      addresses_(module.globals.size(), nullptr) {}

bool ProgramData::create() {
    if (!placeData()) return false;
    rows_ = rowsOf(listed_);
    aliasRows_ = rowsOf(listedAliases_);
    symbols_.push_back({kDataRows, rows_.data()});
    symbols_.push_back({kAliasRows, aliasRows_.data()});
    return true;
}

/// In pages of their own, as the code: its instructions reach 2 GB.
bool ProgramData::placeData() {
    std::vector<size_t> places(module_.globals.size(), 0);
    size_t end = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const ir::Global& global = module_.globals[i];
        if (!isNamedData(global)) continue;
        const size_t alignment = alignmentOf(module_, global);
        places[i] = (end + alignment - 1) / alignment * alignment;
        end = places[i] + module_.size(global.type);
    }
    std::error_code failure;
    memory_ = llvm::sys::OwningMemoryBlock(llvm::sys::Memory::allocateMappedMemory(
        std::max<size_t>(end, 1), nullptr, llvm::sys::Memory::MF_READ | llvm::sys::Memory::MF_WRITE,
        failure));
    if (failure) return false;
    auto* const begin = static_cast<std::byte*>(memory_.base());
    for (size_t i = 0; i < places.size(); ++i) {
        const ir::Global& global = module_.globals[i];
        if (!isNamedData(global)) continue;
        addresses_[i] = begin + places[i];
        if (!global.init.empty()) {
            const std::string image = initialBytes(module_, global);
            std::memcpy(addresses_[i], image.data(), image.size());
        }
        symbols_.push_back({names_.emplace_back(symbolOf(global)), addresses_[i]});
    }
    return true;
}

std::vector<rt::GlobalDesc> ProgramData::rowsOf(const std::vector<DataDeclaration>& data) const {
    std::vector<rt::GlobalDesc> rows;
    rows.reserve(data.size() + 1); // an address even when there are none
    for (const DataDeclaration& declared : data) {
        const ir::Global& global = module_.globals[declared.global];
        rt::GlobalDesc row{};
        row.name = declared.name.c_str();
        row.module = declared.moduleName.c_str();
        row.address = addresses_[declared.global];
        row.kind = static_cast<uint8_t>(abi::kindOf(global.kind));
        row.flags = global.flags;
        row.task = taskNumber(declared.task);
        row.file = declared.file < module_.files.size() ? module_.files[declared.file].c_str() : nullptr;
        row.line = declared.line;
        rows.push_back(row);
    }
    return rows;
}

void ProgramData::setTypes(const std::function<const rt::TypeDesc*(uint32_t)>& typeOf) {
    std::vector<const rt::TypeDesc*> types(module_.typeDescs.size(), nullptr);
    const auto complete = [&](std::vector<rt::GlobalDesc>& rows, const std::vector<DataDeclaration>& data) {
        for (size_t i = 0; i < rows.size(); ++i) {
            const uint32_t number = module_.globals[data[i].global].typeDesc;
            if (types[number] == nullptr) types[number] = typeOf(number);
            rows[i].type = types[number];
        }
    };
    complete(rows_, listed_);
    complete(aliasRows_, listedAliases_);
}

} // namespace codegen
