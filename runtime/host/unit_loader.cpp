#include "runtime/host/unit_loader.h"

#include "runtime/program/program_tables.h"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <set>
#include <thread>
#include <unordered_map>

namespace rt {
namespace {

/// Code and data of a unit are never given back, because data may be referred to: that bounds their number.
constexpr std::size_t kMostUnits = 1000;

/// A task of the program has a small stack, too small for a compiler.
template <class Work> void onOwnStack(Work&& work) {
    std::thread(std::forward<Work>(work)).join();
}

/// Identifies the inputs of compiling a module: the file and every module in memory.
std::string keyOf(const LoadRequest& request, const ProgramTables& present) {
    std::string key =
        fmt::format("{}|{}|{}|{}", request.taskIndex, request.shown, request.bytes.size(), request.bytes);
    for (const LoadedModule& module : present.modules())
        key += fmt::format("|{}:{}:{}", module.task, module.name, static_cast<const void*>(module.unit));
    return key;
}

/// Variables and persistents that lie in the unit itself.
std::vector<std::pair<void*, std::string>> initialData(const ProgramDesc& unit,
                                                       const ProgramTables& present) {
    std::set<const void*> elsewhere;
    for (const GlobalDesc* data : present.globals())
        elsewhere.insert(data->address);
    std::vector<std::pair<void*, std::string>> result;
    for (uint32_t i = 0; i < unit.globalCount; ++i) {
        const GlobalDesc& data = unit.globals[i];
        if ((data.flags & kDataPredefined) == 0 && data.kind != kGlobalConstant &&
            !elsewhere.contains(data.address))
            result.emplace_back(data.address,
                                std::string(static_cast<const char*>(data.address), data.type->size));
    }
    return result;
}

std::string_view elementName(const TypeDesc& type) {
    return type.kind == DescKind::Array ? type.fields[0]->baseName : type.baseName;
}

/// May code that was compiled for one object use another?
bool isLike(const GlobalDesc& a, const GlobalDesc& b) {
    return a.kind == b.kind && a.type->size == b.type->size && elementName(*a.type) == elementName(*b.type) &&
           std::equal(std::begin(a.type->dims), std::end(a.type->dims), std::begin(b.type->dims));
}

} // namespace

const GlobalDesc* findUnitData(const ProgramTables& present, std::string_view name, std::string_view module,
                               int32_t task) {
    const GlobalDesc* data = present.findGlobal(name, module, task, !module.empty());
    return data != nullptr && module.empty() && data->kind != kGlobalPersistent ? nullptr : data;
}

LoadResult UnitLoader::make(const LoadRequest& request, const ProgramTables& present) {
    const std::string key = keyOf(request, present);
    if (const auto known = units_.find(key); known != units_.end())
        return reuse(known->second, request, present);
    if (units_.size() < kMostUnits) return compile(key, request, present);
    LoadResult result;
    result.verdict = LoadResult::Verdict::Full;
    return result;
}

LoadResult UnitLoader::compile(const std::string& key, const LoadRequest& request,
                               const ProgramTables& present) {
    CompiledUnit compiled;
    onOwnStack([&] { compiled = compiler_.compile(request, {present, files_}); });
    LoadResult result;
    result.verdict = compiled.verdict;
    result.module = compiled.module;
    result.problems = std::move(compiled.problems);
    if (compiled.verdict != LoadResult::Verdict::Made) return result;
    Unit unit;
    unit.module = compiled.module;
    unit.task = request.taskIndex;
    unit.file = {request.taskIndex, request.path, request.shown, request.bytes};
    if (!map(compiled, present, unit, result.problems)) {
        result.verdict = LoadResult::Verdict::Wrong;
        return result;
    }
    result.unit = unit.image->program();
    unit.initial = initialData(*result.unit, present);
    remember(unit.file);
    units_.emplace(key, std::move(unit));
    return result;
}

/// The same module beside the same others: its data begin again.
LoadResult UnitLoader::reuse(Unit& unit, const LoadRequest& request, const ProgramTables& present) {
    LoadResult result;
    result.module = unit.module;
    result.unit = unit.image->program();
    if (present.findModule(request.taskIndex, unit.module) != nullptr) {
        result.verdict = LoadResult::Verdict::Loaded;
        return result;
    }
    result.verdict = LoadResult::Verdict::Made;
    unit.file.path = request.path;
    remember(unit.file);
    for (const auto& [address, bytes] : unit.initial)
        std::memcpy(address, bytes.data(), bytes.size());
    return result;
}

/// A native, or what LLVM's code generator calls by itself: memcpy, fmodf and the like.
const void* UnitLoader::nativeAddress(const std::string& symbol) const {
    const void* address = findNative_(symbol);
    return address != nullptr ? address : ::dlsym(RTLD_DEFAULT, symbol.c_str());
}

bool UnitLoader::map(const CompiledUnit& compiled, const ProgramTables& present, Unit& unit,
                     std::string& problem) {
    std::unordered_map<std::string_view, const CompiledUnit::Import*> data;
    for (const CompiledUnit::Import& import : compiled.data)
        data.emplace(import.symbol, &import);
    std::vector<const void*> addresses;
    std::string missing;
    for (const std::string& symbol : compiled.image.imports) {
        const auto found = data.find(symbol);
        if (found == data.end()) {
            addresses.push_back(nativeAddress(symbol));
            if (addresses.back() == nullptr) missing += ' ' + symbol;
            continue;
        }
        const CompiledUnit::Import& import = *found->second;
        const GlobalDesc* object = findUnitData(present, import.name, import.module, unit.task);
        const bool shared = object == nullptr || import.module.empty();
        if (object == nullptr) object = findUnitData(present, import.name, "", unit.task);
        if (!shared && (object->flags & kDataPredefined) == 0)
            unit.bindings.push_back({addresses.size(), import.name, import.module, object, object->address});
        addresses.push_back(object != nullptr ? object->address : nullptr);
    }
    if (!missing.empty()) {
        problem = "the module uses what this runtime does not implement:" + missing;
        return false;
    }
    unit.image = MappedImage::map(compiled.image, addresses, problem);
    return unit.image != nullptr;
}

void UnitLoader::remember(const LoadedFile& file) {
    std::erase_if(
        files_, [&](const LoadedFile& known) { return known.task == file.task && known.path == file.path; });
    files_.push_back(file);
}

OpenReferences UnitLoader::unresolved(const std::string& task, int32_t, const ProgramTables& present) {
    OpenReferences result;
    onOwnStack([&] { result = compiler_.unresolved(task, {present, files_}); });
    return result;
}

void UnitLoader::memoryChanged(const ProgramTables& present) {
    for (auto& entry : units_)
        bind(entry.second, present);
}

/// The object of that name and type in memory now.
void UnitLoader::bind(Unit& unit, const ProgramTables& present) {
    for (Binding& binding : unit.bindings) {
        const GlobalDesc* object = present.findGlobal(binding.name, binding.module, unit.task, true);
        if (object == nullptr &&
            binding.bound->kind == kGlobalPersistent) // another module may declare it, too
            object = findUnitData(present, binding.name, "", unit.task);
        if (object != nullptr && ((object->flags & kDataLocal) != 0 || !isLike(*object, *binding.bound)))
            object = nullptr;
        const void* address = object != nullptr ? object->address : nullptr;
        if (std::exchange(binding.address, address) != address) unit.image->rebind(binding.import, address);
    }
}

} // namespace rt
