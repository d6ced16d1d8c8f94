#pragma once
// UnitLoader: maps modules that come while a program runs, and binds them to what is in memory.

#include "runtime/host/mapped_image.h"
#include "runtime/host/unit_compiler.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {

class UnitLoader final : public ModuleLoader {
  public:
    /// Address of a native or support entry point by its symbol; null if there is none.
    using FindNative = void* (*)(std::string_view symbol);

    /// `compiler` must outlive the loader.
    UnitLoader(UnitCompiler& compiler, FindNative findNative)
        : compiler_(compiler), findNative_(findNative) {}

    LoadResult make(const LoadRequest& request, const ProgramTables& present) override;
    OpenReferences unresolved(const std::string& task, int32_t taskIndex,
                              const ProgramTables& present) override;
    void memoryChanged(const ProgramTables& present) override;

  private:
    /// Data of another module, which may come and go.
    struct Binding {
        std::size_t import;
        std::string name, module;
        const GlobalDesc* bound; ///< as it was first: the type that the code expects
        const void* address;     ///< now; null: absent
    };
    /// What has been compiled, by file and by all modules it was compiled beside: programs load the same parts again and
    /// again. Code and data are kept, because data may be referred to.
    struct Unit {
        std::string module;
        int32_t task = 0;
        LoadedFile file;
        std::unique_ptr<MappedImage> image;
        std::vector<std::pair<void*, std::string>> initial; ///< bytes of its data
        std::vector<Binding> bindings;
    };

    LoadResult compile(const std::string& key, const LoadRequest& request, const ProgramTables& present);
    LoadResult reuse(Unit& unit, const LoadRequest& request, const ProgramTables& present);
    bool map(const CompiledUnit& compiled, const ProgramTables& present, Unit& unit, std::string& problem);
    void remember(const LoadedFile& file);
    static void bind(Unit& unit, const ProgramTables& present);

    const void* nativeAddress(const std::string& symbol) const;

    UnitCompiler& compiler_;
    FindNative findNative_;
    std::deque<LoadedFile> files_;
    std::map<std::string, Unit> units_;
};

} // namespace rt
