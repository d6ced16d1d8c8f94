#include "tools/rapidc/native_library.h"

#include "stdlib/native_bodies.h"
#include "stdlib/native_table.h"

namespace rapidc {

std::vector<codegen::NativeSymbol> nativeSymbols() {
    std::vector<codegen::NativeSymbol> symbols;
    for (const rt::NativeEntry& entry : rt::nativeTable())
        if (entry.address) symbols.push_back({entry.symbol, entry.address});
    for (const rt::SupportEntry& entry : rt::supportTable())
        if (entry.address) symbols.push_back({entry.symbol, entry.address});
    return symbols;
}

codegen::CodegenOptions codegenOptions(bool optimise) {
    codegen::CodegenOptions options;
    options.optimise = optimise;
    options.bodies = {rt::nativeBodies(), rt::nativesWithBody()};
    return options;
}

} // namespace rapidc
