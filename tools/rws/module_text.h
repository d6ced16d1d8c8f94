#pragma once
// Texts of modules: parts of them by rows and columns, attributes, saving with the present values of persistents.

#include "tools/service/symbols.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {
class Controller;
class Task;
struct LoadedModule;
} // namespace rt

namespace rapidc::rws {

/// Rows and columns from 1, both ends included; -1 at the end: the last one. Columns count characters.
struct TextRange {
    int64_t startRow = 1, startColumn = 1, endRow = 1, endColumn = -1;
};
enum class RangeMode : uint8_t { Replace, After, Before };

/// None: the range does not lie in the text.
std::optional<std::string> partOf(std::string_view text, const TextRange& range);
/// The text with another part in place of the range, or after or before it.
std::optional<std::string> withRange(std::string_view text, const TextRange& range, std::string_view part,
                                     RangeMode mode);
/// The text with another initial value of data that the module declares. None: it does not, or they have no initial value.
std::optional<std::string> withInitialValue(const std::string& text, std::string_view module,
                                            std::string_view name, std::string_view value);
/// Rows and columns at which a text begins; at most `most` of them.
std::vector<std::pair<std::size_t, std::size_t>> placesOf(std::string_view text, std::string_view wanted,
                                                          std::size_t most);
/// Rows, and characters of the longest one.
std::pair<std::size_t, std::size_t> sizeOf(std::string_view text);

struct RoutineOfRow {
    std::string name;
    service::SymbolType type = service::SymbolType::Procedure;
    bool isLocal = false;
    std::size_t parameters = 0;
};
/// The routine that a row (from 1) belongs to. None: it lies outside all of them.
std::optional<RoutineOfRow> routineOfRow(const std::string& text, std::string_view module, std::size_t row);

/// Attributes in parentheses after the name of the module: "SYSMODULE,NOSTEPIN"; "" = nothing.
std::string attributesOf(std::string_view text, std::string_view module);
bool isSystemModule(std::string_view text, std::string_view module);

/// Writes the text with the present values of the module's persistents to a file of the host, in one step. "" or why not.
std::string saveModule(rt::Controller& controller, const rt::Task& task, const rt::LoadedModule& module,
                       const std::string& text, const std::string& file);

} // namespace rapidc::rws
