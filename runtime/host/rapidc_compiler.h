#pragma once
// RapidcCompiler: the UnitCompiler of built executables: the installed rapidc (`rapidc compile-unit`).

#include "runtime/host/unit_compiler.h"

#include <string_view>

namespace rt {

class IoSystem;

class RapidcCompiler final : public UnitCompiler {
  public:
    /// `sources`: ProgramDesc::sources; `io`: which signals there are. Both must outlive the compiler.
    RapidcCompiler(std::string_view sources, const IoSystem& io) : sources_(sources), io_(io) {}

    CompiledUnit compile(const LoadRequest& request, const ProgramState& state) override;
    OpenReferences unresolved(const std::string& task, const ProgramState& state) override;

  private:
    std::string_view sources_;
    const IoSystem& io_;
};

} // namespace rt
