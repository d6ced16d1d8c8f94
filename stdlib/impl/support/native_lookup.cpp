#include "runtime/abi/interpreted.h"
#include "runtime/abi/support_natives.h"
#include "stdlib/native_table.h"

#include <string>
#include <unordered_map>

namespace rt {

std::span<const SupportEntry> supportTable() {
    static const SupportEntry table[] = {
#define SUPPORT_NATIVE(symbol, ...) {#symbol, reinterpret_cast<void*>(&symbol)},
#define SUPPORT_VALUE(symbol, ...) {#symbol, reinterpret_cast<void*>(&symbol)},
#define RUNTIME_FUNCTION(symbol) {#symbol, reinterpret_cast<void*>(&symbol)},
#include "runtime/abi/support_natives.def"
        {"rt_interpret", reinterpret_cast<void*>(&rt_interpret)},
    };
    return table;
}

void* findNativeAddress(std::string_view symbol) {
    static const std::unordered_map<std::string_view, void*> addresses = [] {
        std::unordered_map<std::string_view, void*> map;
        for (const NativeEntry& entry : nativeTable())
            map.emplace(entry.symbol, entry.address);
        for (const SupportEntry& entry : supportTable())
            map.emplace(entry.symbol, entry.address);
        return map;
    }();
    const auto found = addresses.find(symbol);
    return found == addresses.end() ? nullptr : found->second;
}

} // namespace rt
