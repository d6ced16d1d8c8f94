#pragma once
// Diagnostics: typed messages, a sink that collects, renderers for people and programs.

#include "frontend/source/source_file.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rapid::diag {

enum class Severity : uint8_t { Error, Warning, Note };

/// Every diagnostic of rapidc: RAP and four digits. 1xxx lexing and parsing, 2xxx names and types, 3xxx expressions
/// and constants, 4xxx calls and built-ins, 5xxx flow and use of data, 6xxx projects, tasks, configuration,
/// 7xxx lowering and linking, 8xxx lint, 9xxx internal.
enum class Code : uint16_t {};

/// A diagnostic and the number of its arguments: a report with a different number does not compile.
template <size_t N> struct Message {
    Code code;
};

/// The messages: say::MissingArgument. A header of frontend/diag/messages declares those of a thousand.
namespace say {}

/// The arguments of a message with N of them, N > 0: `{a, b}`.
template <size_t N> using MessageArgs = const std::string (&)[N];

/// Identifies the report of a mistake within one check. Reports of one mistake are merged by it.
enum class CauseId : uint32_t { None = 0 };
/// Of a line that lacks its semicolon. Unlike those of a check they differ between all files of the process.
CauseId newLineCause();

struct Diagnostic {
    struct Note {
        std::shared_ptr<const SourceFile> file;
        SourceRange range;
        std::string message;
    };
    /// A way to correct it: all edits together, in the file of the diagnostic.
    struct Fix {
        std::string message; ///< "write ':='"; lower-case start, no full stop
        std::vector<TextEdit> edits;
        bool certain = true; ///< nothing else can be meant: `rapidc check --fix` applies it
    };
    Code code{};
    Severity severity = Severity::Error;
    CauseId cause = CauseId::None; ///< of a check: for the last pass over the diagnostics
    /// Cause of the report that its line lacks the semicolon: perhaps one mistake.
    CauseId line = CauseId::None;
    /// May be null: a message about the command line or a missing file.
    std::shared_ptr<const SourceFile> file;
    SourceRange range;
    std::string message;           ///< lower-case start, one sentence, no full stop
    std::vector<std::string> args; ///< {0}, {1}, ... of the message
    std::vector<Note> notes;
    std::vector<Fix> fixes;

    /// Adds a fix, with its text: replaces `place` (empty: inserts) with `replacement` (empty: removes it).
    Diagnostic& fix(SourceRange place, std::string replacement, bool certain = true);
};

/// Collects the diagnostics of one run; keeps the order of reporting until sorted.
class Sink {
  public:
    /// That many errors, and that many warnings and notes, are kept of one file; a note says that there were more.
    static constexpr uint32_t kMaxPerFile = 1000;

    /// `args` replace {0}, {1}, ... in the catalogue text. The reference is valid until the next report.
    template <size_t N>
    Diagnostic& report(Message<N> message, const std::shared_ptr<const SourceFile>& file, SourceRange range,
                       MessageArgs<N> args) {
        return report(message.code, file, range, std::span<const std::string>(args));
    }
    Diagnostic& report(Message<0> message, const std::shared_ptr<const SourceFile>& file, SourceRange range) {
        return report(message.code, file, range, std::span<const std::string>());
    }
    /// For a code that is known at run time only; the number of `args` must match the catalogue.
    Diagnostic& report(Code code, const std::shared_ptr<const SourceFile>& file, SourceRange range,
                       std::span<const std::string> args);
    Diagnostic& report(Code code, const std::shared_ptr<const SourceFile>& file, SourceRange range,
                       std::initializer_list<std::string> args = {}) {
        return report(code, file, range, std::span<const std::string>(args.begin(), args.size()));
    }
    /// Calls `keep` for each diagnostic, which may change its severity; removes those for which it returns false.
    void revise(const std::function<bool(Diagnostic&)>& keep);
    /// Takes back those of the errors for which `wrong` says so.
    void retract(const std::function<bool(const Diagnostic&)>& wrong);
    bool hasErrors() const { return errorCount_ > 0; }
    size_t errorCount() const { return errorCount_; }
    /// Sorted by file, position, code.
    std::vector<Diagnostic> sorted() const;
    const std::vector<Diagnostic>& all() const { return all_; }
    /// Everything reported so far; the sink is empty then.
    std::vector<Diagnostic> take();
    void add(std::span<const Diagnostic> diagnostics);
    /// Takes what another one has collected, as if it were reported here.
    void absorb(Sink& other);

  private:
    struct Kept {
        uint32_t errors = 0;
        uint32_t warnings = 0;
    };
    bool isOneTooMany(const std::shared_ptr<const SourceFile>& file, SourceRange range, Severity severity);

    std::vector<Diagnostic> all_;
    Diagnostic dropped_; ///< what callers add notes and fixes to when there are too many
    std::unordered_map<const SourceFile*, Kept> kept_;
    size_t errorCount_ = 0;
};

/// "RAP2104"
std::string codeName(Code code);
std::string_view severityName(Severity severity);

/// For people: `file:line:column: error[RAP2104]: text` (warnings: and their names), the source line, a caret line, help,
/// notes. ANSI colours if asked.
std::string renderText(const Diagnostic& diagnostic, bool colour);
/// One JSON array of {file,line,column,endLine,endColumn,severity,code,name,message}.
std::string renderJson(std::span<const Diagnostic> diagnostics);
/// SARIF 2.1.0, as code scanning services read it. `root`: absolute folder to which paths are relative.
std::string renderSarif(std::span<const Diagnostic> diagnostics, std::string_view root = {});

} // namespace rapid::diag
