#pragma once
// What the runtime needs from a compiler to load a module while a program runs (Load, StartLoad). The host supplies it;
// executables made by `rapidc build` have none.

#include "runtime/abi/rt_abi.h"

#include <string>
#include <vector>

namespace rt {

class ProgramTables;

struct LoadRequest {
    std::string task; ///< name
    int32_t taskIndex = 0;
    std::string path;  ///< of the file, on the host
    std::string shown; ///< as people know it: "HOME:/part.modx"
    std::string bytes; ///< its contents
};

/// A module, ready to run beside those in program memory.
struct LoadResult {
    enum class Verdict : uint8_t {
        Made,
        Loaded, ///< a module of that name is in program memory already
        Full,   ///< there is no memory left for it
        Wrong   ///< it cannot be compiled beside them
    } verdict = Verdict::Wrong;
    std::string module;                ///< its name
    const ProgramDesc* unit = nullptr; ///< lives as long as the loader
    std::string problems;              ///< diagnostics, each with its place
};

class ModuleLoader {
  public:
    virtual ~ModuleLoader() = default;
    /// Compiles a module against what `present` says is in memory; nothing there changes.
    virtual LoadResult make(const LoadRequest& request, const ProgramTables& present) = 0;
    /// References in the modules of a task that nothing in memory declares: "Module:12: 'name'". Empty: all is well.
    virtual std::vector<std::string> unresolved(const std::string& task, int32_t taskIndex,
                                                const ProgramTables& present) = 0;
};

} // namespace rt
