#pragma once
// The installed rapidc as a child process: what built executables cannot do themselves.

#include "runtime/host/module_store.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// A rapidc that has been asked something.
struct RapidcAnswer {
    std::string program; ///< as it was called
    int status = 0;      ///< of its exit; -1: it could not be started
    int error = 0;       ///< errno, then
    std::string out;     ///< on its standard output
    std::string said;    ///< on its error output, without the last line end

    /// Why it could not be started, and what to do; `purpose`: "write modules".
    std::string notStarted(std::string_view purpose) const;
};

/// Names the program to call; unset or empty: `rapidc` in PATH.
inline constexpr const char* kRapidcVariable = "RAPIDC";

/// Starts it, gives it `input` and waits for its end.
RapidcAnswer askRapidc(std::vector<std::string> arguments, std::string_view input);

/// The ModuleStore of built executables.
class RapidcProcess final : public ModuleStore {
  public:
    StoreResult store(const ModuleText& text) override;
};

} // namespace rt
