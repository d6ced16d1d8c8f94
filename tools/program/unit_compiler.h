#pragma once
// SourceCompiler: compiles a module that comes while a program runs (Load, StartLoad), beside the sources of the program.

#include "runtime/host/unit_compiler.h"
#include "tools/program/program_sources.h"

#include <string>
#include <vector>

namespace rapidc {

class SourceCompiler final : public rt::UnitCompiler {
  public:
    /// `sources` must outlive the compiler.
    explicit SourceCompiler(const ProgramSources& sources) : sources_(sources) {}

    rt::CompiledUnit compile(const rt::LoadRequest& request, const rt::ProgramState& state) override;
    rt::OpenReferences unresolved(const std::string& task, const rt::ProgramState& state) override;

  private:
    std::vector<rapid::sema::TaskInput> inputs(const rt::ProgramState& state) const;
    bool generate(const rapid::sema::CheckedProgram& program, const rapid::sema::Module& module,
                  const rt::LoadRequest& request, const rt::ProgramState& state, rt::CompiledUnit& result);

    const ProgramSources& sources_;
};

} // namespace rapidc
