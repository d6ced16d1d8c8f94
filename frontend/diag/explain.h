#pragma once
// Explanations of diagnostics, each with a wrong and a right example: `rapidc explain`, and the help of editors. The words are in
// docs/diagnostics, one page for each code; the build embeds them.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::diag {

struct CatalogueEntry;

/// How the examples of an explanation are to be completed. A page names it after the language of the example: "```rapid body".
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
    /// The contents of a file are indented by two spaces. `(ISO 8859-1)` names the encoding of a file. A line that ends with
    /// `(N = 1 to 600)` represents so many; in it, `<N>` and `<N+1>` are their numbers.
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
/// Its name in a page: "module".
std::string_view exampleKindName(ExampleKind kind);

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

/// The explanations of all codes, ascending, as the pages of docs/diagnostics give them.
std::span<const Explanation> explanations();

/// Null when there is none for the code.
const Explanation* findExplanation(uint16_t number);

/// The text of a message with something readable in the place of its arguments.
std::string messageOf(const CatalogueEntry& entry);

/// The name of a warning and how it is switched off; empty for what cannot be.
std::string switchingOf(const CatalogueEntry& entry);

/// The subject of a range of numbers: "names and types".
std::string_view areaOf(uint16_t number);

/// A page of docs/diagnostics, Markdown: one for each code, and `README.md`, which lists them. Title, severity, message and
/// name come from the catalogue; the rest is what the page says already.
struct DiagnosticPage {
    std::string fileName;
    std::string text;
};
/// All pages. `rapidc explain --pages=FOLDER` writes them; a test holds docs/diagnostics against them.
std::vector<DiagnosticPage> diagnosticPages();

} // namespace rapid::diag
