#pragma once
// UnitLoader: compiles a module into a program that is running (Load, StartLoad), for `rapidc run`.

#include "codegen/codegen.h"
#include "runtime/host/module_loader.h"
#include "tools/rapidc/pipeline.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rapidc {

class UnitLoader final : public rt::ModuleLoader {
  public:
    /// `compilation` is what the program was made of; both must outlive the loader.
    UnitLoader(const Compilation& compilation, bool stepping, codegen::CodegenOptions options,
               const std::vector<codegen::NativeSymbol>& natives);
    ~UnitLoader() override;

    rt::LoadResult make(const rt::LoadRequest& request, const rt::ProgramTables& present) override;
    std::vector<std::string> unresolved(const std::string& task, int32_t taskIndex,
                                        const rt::ProgramTables& present) override;

  private:
    using File = std::shared_ptr<const rapid::SourceFile>;
    rt::LoadResult compile(const rt::LoadRequest& request, const rt::ProgramTables& present);
    std::vector<std::string> openReferences(const std::string& task, const rt::ProgramTables& present) const;
    std::vector<rapid::sema::TaskInput> inputs(const rt::ProgramTables& present) const;
    rt::LoadResult reuse(const std::string& key, const rt::LoadRequest& request,
                         const rt::ProgramTables& present);
    bool generate(ir::Module& module, const rt::ProgramTables& present, int32_t taskIndex,
                  rt::LoadResult& result);

    const Compilation& compilation_;
    bool stepping_;
    codegen::CodegenOptions options_;
    const std::vector<codegen::NativeSymbol>& natives_;
    std::map<std::pair<int32_t, std::string>, File> loaded_; ///< by task and path
    /// What has been compiled, by file and by all modules it was compiled beside: programs load the same parts again and
    /// again.
    struct Compiled {
        std::string module;
        const rt::ProgramDesc* unit = nullptr;
        File file;
        std::vector<std::pair<void*, std::string>> initial; ///< bytes of its data
    };
    std::map<std::string, Compiled> compiled_;
    std::vector<std::unique_ptr<codegen::JitProgram>>
        units_; ///< kept: data and code may be referred to for ever
};

} // namespace rapidc
