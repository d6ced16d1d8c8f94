#pragma once
// RapidcCompiler: the UnitCompiler of built executables: the installed rapidc (`rapidc compile-unit`).

#include "runtime/host/unit_compiler.h"

#include <string_view>

namespace rt {

class RapidcCompiler final : public UnitCompiler {
  public:
    /// `sources`: ProgramDesc::sources; must outlive the compiler.
    explicit RapidcCompiler(std::string_view sources) : sources_(sources) {}

    CompiledUnit compile(const LoadRequest& request, const ProgramState& state) override;
    OpenReferences unresolved(const std::string& task, const ProgramState& state) override;

  private:
    std::string_view sources_;
};

} // namespace rt
