#pragma once
// UnitCompiler: who compiles a module that comes while a program runs: `rapidc run` in its own process, a built executable
// by way of the installed rapidc (RapidcCompiler).

#include "runtime/abi/unit_image.h"
#include "runtime/host/module_loader.h"

#include <deque>
#include <string>
#include <vector>

namespace rt {

/// A file whose module has been loaded; it may have left memory since.
struct LoadedFile {
    int32_t task = 0;
    std::string path;  ///< on the host; with the task it names the file
    std::string shown; ///< as people know it
    std::string bytes;
};

/// The program beside which a module is compiled.
struct ProgramState {
    const ProgramTables& tables;
    const std::deque<LoadedFile>& files;
};

struct CompiledUnit {
    /// Data that lie elsewhere.
    struct Import {
        std::string symbol; ///< among UnitImage::imports
        std::string name;
        std::string module; ///< "": a persistent that modules share
    };
    LoadResult::Verdict verdict = LoadResult::Verdict::Wrong; ///< never Full
    std::string module;
    std::string problems;
    UnitImage image;
    std::vector<Import> data;
};

class UnitCompiler {
  public:
    virtual ~UnitCompiler() = default;
    virtual CompiledUnit compile(const LoadRequest& request, const ProgramState& state) = 0;
    virtual OpenReferences unresolved(const std::string& task, const ProgramState& state) = 0;
};

/// Data of a module that `task` sees; without module, a persistent that modules share. Null when there are none.
const GlobalDesc* findUnitData(const ProgramTables& present, std::string_view name, std::string_view module,
                               int32_t task);

} // namespace rt
