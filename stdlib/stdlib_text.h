#pragma once
// The declarations of everything predefined, as text inside the executable: the checker parses them at
// start-up.

#include <span>
#include <string_view>

namespace rapid::stdlib {

struct StdlibSource {
    const char* name;      ///< "decl/math.sysx"
    std::string_view text; ///< UTF-8
    /// The same lines without the documentation, for commands that only check and compile.
    std::string_view declarations;
};

/// All declaration files, decl before data, sorted by name.
std::span<const StdlibSource> sources();

} // namespace rapid::stdlib
