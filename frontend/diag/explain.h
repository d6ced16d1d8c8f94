#pragma once
// What diagnostics mean, with a wrong and a right example: `rapidc explain`, and the help of editors.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::diag {

/// Where the examples of an explanation stand.
enum class ExampleKind : uint8_t {
    File,   ///< a whole file
    Module, ///< between MODULE and ENDMODULE
    Body    ///< in a procedure
};

struct Explanation {
    uint16_t number = 0;
    ExampleKind kind = ExampleKind::Body;
    std::string_view meaning; ///< sentences: what is wrong, what to do, where the manual says so
    std::string_view wrong;   ///< causes this diagnostic and no other; empty if it cannot be shown as text
    std::string_view right;   ///< causes none
};

/// Explanations of the 1xxx codes, ascending; those of the parser, and so on as in diagnostics.def.
std::span<const Explanation> explanations1xxx();
std::span<const Explanation> explanations2xxx();
std::span<const Explanation> explanations3xxx();
std::span<const Explanation> explanations4xxx();
std::span<const Explanation> explanations5xxx();
std::span<const Explanation> explanations6xxx();
std::span<const Explanation> explanations7xxx(); ///< and 9xxx
std::span<const Explanation> explanations8xxx();

/// Null when there is none for the code.
const Explanation* findExplanation(uint16_t number);

/// What a range of numbers is about: "names and types".
std::string_view areaOf(uint16_t number);

/// A page of docs/diagnostics, Markdown: one a code, and `README.md`, which lists them.
struct DiagnosticPage {
    std::string fileName;
    std::string text;
};
/// All pages. `rapidc explain --pages=FOLDER` writes them; a test holds docs/diagnostics against them.
std::vector<DiagnosticPage> diagnosticPages();

} // namespace rapid::diag
