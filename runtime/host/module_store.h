#pragma once
// ModuleStore: who can change the source of a module. The runtime knows no RAPID text; it asks its host: `rapidc run`
// does it itself, a built executable calls the installed rapidc (RapidcProcess).

#include <string>
#include <vector>

namespace rt {

/// A persistent and the value that its declaration is to get, as text of the source.
struct SavedValue {
    std::string module, name, text;
};

struct ModuleText {
    std::string source;      ///< file with the declarations
    std::string destination; ///< where the changed text goes; may be the same
    std::vector<SavedValue> values;
};

struct StoreResult {
    std::string problem;            ///< not empty: nothing has been written
    std::vector<std::string> notes; ///< values that could not be written, a sentence each
};

class ModuleStore {
  public:
    virtual ~ModuleStore() = default;
    /// Writes `source` with these values to `destination`, which holds the old content or the new one at any moment.
    virtual StoreResult store(const ModuleText& text) = 0;
};

} // namespace rt
