#pragma once
// RapidcProcess: the ModuleStore of built executables: the installed rapidc as a child process.

#include "runtime/host/module_store.h"

namespace rt {

class RapidcProcess final : public ModuleStore {
  public:
    /// Names the program to call; unset or empty: `rapidc` in PATH.
    static constexpr const char* kVariable = "RAPIDC";

    StoreResult store(const ModuleText& text) override;
};

} // namespace rt
