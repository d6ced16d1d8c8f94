#include "tools/program/native_library.h"

#include "stdlib/native_bodies.h"
#include "stdlib/native_table.h"

#include <cstdlib>

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

void runPassesInParts(codegen::CodegenOptions& options, ir::Module& module, const ir::PassOptions& passes) {
    if (module.instructionCount() <= options.partsAbove) return;
    options.prepare = [&module, passes](uint32_t routine, std::string& problem) {
        const std::vector<std::string> findings = ir::runPasses(module, routine, passes);
        problem = findings.empty() ? "" : findings.front();
        return findings.empty();
    };
    options.release = [&module](uint32_t routine) {
        module.routines[routine].insts = {};
        module.routines[routine].blocks = {};
    };
}

std::string cacheFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const char* wanted = std::getenv("RAPIDC_CACHE")) return wanted;
    if (const std::string caches = variable("XDG_CACHE_HOME"); !caches.empty()) return caches + "/rapidc";
    const std::string home = variable("HOME");
    return home.empty() ? "" : home + "/.cache/rapidc";
}

} // namespace rapidc
