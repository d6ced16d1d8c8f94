#pragma once
// rapidc.json, the settings of a project: which warnings are wanted, how source is formatted. One reader for all
// sections; what an entry means is known to those it is for.

#include "frontend/diag/diagnostic.h"
#include "frontend/project/open_texts.h"

#include <string>
#include <variant>
#include <vector>

namespace rapid::project {

/// One entry: `"warnings": {"unused-variable": "off"}`.
struct Setting {
    std::string section; ///< "warnings"
    std::string name;    ///< "unused-variable"
    std::variant<bool, double, std::string> value;
    SourceRange range; ///< of the name, for reports

    /// The value if it is text, else null.
    const std::string* text() const { return std::get_if<std::string>(&value); }
};

struct Settings {
    std::shared_ptr<const SourceFile> file; ///< null: there is no project file
    std::vector<Setting> entries;           ///< sorted by section and name
};

/// Name of the project file.
inline constexpr const char* kSettingsFile = "rapidc.json";

/// Path of the project file in the folder of `input` (a file or a folder) or the nearest folder above it; empty if
/// there is none.
std::string findSettings(const std::string& input);

/// Reads the project file that belongs to `input`. Parts that cannot be read are reported in it, the rest holds. `texts` count
/// before files.
Settings loadSettings(const std::string& input, diag::Sink& sink, const OpenTexts* texts = nullptr);

/// Reads a project file that is in memory already.
Settings readSettings(std::shared_ptr<const SourceFile> file, diag::Sink& sink);

} // namespace rapid::project
