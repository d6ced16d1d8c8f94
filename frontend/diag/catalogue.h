#pragma once
// The catalogue of all messages: severity, number of arguments and text of every code.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag {

/// One line of frontend/diag/messages.
struct CatalogueEntry {
    uint16_t number = 0;
    Severity severity = Severity::Error;
    uint8_t argCount = 0;
    std::string_view name; ///< "UnexpectedCharacter"
    std::string_view text; ///< with {0}, {1}, ...
};

/// All entries, ascending by number.
std::span<const CatalogueEntry> catalogue();

/// The entry of a code; null when there is none.
const CatalogueEntry* findEntry(uint16_t number);

/// The name as words: "Missing semicolon".
std::string title(const CatalogueEntry& entry);

/// The name in words, as comments, project files and the command line use it: "unused-variable".
std::string kebabName(const CatalogueEntry& entry);

/// Warnings can be switched off or made errors by their names; errors and notes cannot.
inline bool isSwitchable(const CatalogueEntry& entry) {
    return entry.severity == Severity::Warning;
}

/// The catalogue text with {0}, {1}, ... replaced. A missing argument leaves its placeholder.
std::string formatText(std::string_view text, std::span<const std::string> args);

} // namespace rapid::diag
