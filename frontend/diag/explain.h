#pragma once
// What diagnostics mean, with a wrong and a right example: `rapidc explain`, and the help of editors.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::diag {

struct CatalogueEntry;

/// Where the examples of an explanation stand.
enum class ExampleKind : uint8_t {
    File,   ///< a whole file
    Module, ///< between MODULE and ENDMODULE
    Body,   ///< in a procedure
    /// Several files and a command, for what no single file can show:
    ///
    ///     $ rapidc check cell
    ///     cell/main.mod:
    ///       MODULE main
    ///       ENDMODULE
    ///     cell/secret.mod (bytes FC 86 41):
    ///
    /// What stands in a file is indented by two spaces. `(ISO 8859-1)` names the encoding of a file. A line that ends with
    /// `(N = 1 to 600)` stands for so many; in it, `<N>` and `<N+1>` are their numbers.
    Files
};

struct Explanation {
    uint16_t number = 0;
    ExampleKind kind = ExampleKind::Body;
    std::string_view meaning; ///< sentences: what is wrong, what to do, where the manual says so
    std::string_view wrong; ///< causes this diagnostic and no other but notes; empty if it would be too long
    std::string_view right; ///< causes none but notes
};

/// The language of an example in Markdown: "rapid", or "text" where it is more than a module.
std::string_view exampleLanguage(ExampleKind kind);

/// An example as a user would try it.
struct ExampleProject {
    struct File {
        std::string name; ///< with its folders
        std::string bytes;
    };
    std::string command; ///< "rapidc check main.modx"
    std::vector<File> files;
};
ExampleProject exampleProject(ExampleKind kind, std::string_view example);

/// Explanations of the 1xxx codes, ascending; those of the parser, and so on as in diagnostics.def.
std::span<const Explanation> explanations1xxx();
std::span<const Explanation> explanations2xxx();
std::span<const Explanation> explanations3xxx();
std::span<const Explanation> explanations4xxx();
std::span<const Explanation> explanations5xxx();
std::span<const Explanation> explanations6xxx(); ///< but for backups
std::span<const Explanation> explanationsOfBackups();
std::span<const Explanation> explanations7xxx(); ///< and 9xxx
std::span<const Explanation> explanations8xxx();

/// Null when there is none for the code.
const Explanation* findExplanation(uint16_t number);

/// The text of a message with something readable in the place of its arguments.
std::string messageOf(const CatalogueEntry& entry);

/// The name of a warning and how it is switched off; empty for what cannot be.
std::string switchingOf(const CatalogueEntry& entry);

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
