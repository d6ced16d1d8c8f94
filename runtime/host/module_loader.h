#pragma once
// The interface through which the controller loads a module while a program runs (Load, StartLoad); see UnitLoader.

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
        Loaded,    ///< a module of that name is in program memory already
        Full,      ///< there is no memory left for it
        Wrong,     ///< it cannot be compiled beside them
        NoCompiler ///< there is nothing that could compile it; `problems` says what is missing
    } verdict = Verdict::Wrong;
    std::string module;                ///< its name
    const ProgramDesc* unit = nullptr; ///< lives as long as the loader
    std::string problems;              ///< diagnostics, each with its place
};

/// References that nothing in memory declares: "'name' (module.modx:12)".
struct OpenReferences {
    std::vector<std::string> names;
    std::string problem; ///< not empty: they could not be found out, and why
};

class ModuleLoader {
  public:
    virtual ~ModuleLoader() = default;
    /// Compiles a module against what `present` says is in memory; nothing there changes.
    virtual LoadResult make(const LoadRequest& request, const ProgramTables& present) = 0;
    /// References of the modules of a task.
    virtual OpenReferences unresolved(const std::string& task, int32_t taskIndex,
                                      const ProgramTables& present) = 0;
    /// A module has come into memory or left it: what others refer to may lie elsewhere now, or nowhere.
    virtual void memoryChanged(const ProgramTables& present) = 0;
};

} // namespace rt
