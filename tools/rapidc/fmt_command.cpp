// rapidc fmt: lays out modules in place, or names those that would change.

#include "runtime/host/command_line.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/text_diff.h"
#include "tools/rapidc/usage.h"

#include "config/atomic_file.h"
#include "config/temporary.h"
#include "frontend/edit/apply_edits.h"
#include "frontend/format/canonical_names.h"
#include "frontend/format/formatter.h"
#include "frontend/format/read_settings.h"
#include "frontend/syntax/parser.h"
#include "frontend/workspace/module_files.h"
#include "runtime/host/run_options.h"
#include "stdlib/stdlib_text.h"

#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <unistd.h>

namespace rapidc {

namespace {

namespace diag = rapid::diag;
namespace format = rapid::format;

struct FmtSettings {
    std::vector<std::string> inputs;
    bool check = false;
    bool diff = false;
    bool fromStdin = false;
    bool keepErrors = false;
    std::string stdinName = "stdin.modx";
    std::string range;
};

/// "FIRST:LAST"; false when it has a different form.
bool readRange(const std::string& text, format::FormatRequest& request) {
    unsigned first = 0, last = 0;
    int length = 0;
    const int fields = std::sscanf(text.c_str(), "%9u:%9u%n", &first, &last, &length);
    if (fields != 2 || static_cast<size_t>(length) != text.size() || first == 0 || last < first) return false;
    request.firstLine = first;
    request.lastLine = last;
    return true;
}

/// The names of the standard library, made when a project wants them.
const format::NameTable& predefinedNames() {
    static const format::NameTable names = [] {
        format::NameTable table;
        for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources()) {
            diag::Sink ignored;
            rapid::syntax::ParseOptions options;
            options.declarations = true;
            const auto file =
                std::make_shared<const rapid::SourceFile>(std::string(source.name), std::string(source.text));
            format::addDeclaredNames(*rapid::syntax::parse(file, ignored, options), table);
        }
        return table;
    }();
    return names;
}

class Fmt {
  public:
    explicit Fmt(const FmtSettings& settings) : settings_(settings) {}

    int run() {
        if (!settings_.range.empty() && !readRange(settings_.range, range_))
            return usage(fmt::format("cannot read --range={}: expected FIRST:LAST, two line numbers",
                                     settings_.range));
        if (settings_.fromStdin) return runStdin();
        if (settings_.inputs.empty()) return usage("no input: name modules or folders, or use --stdin");
        const rapid::workspace::ModuleFiles files = rapid::workspace::findModuleFiles(settings_.inputs);
        for (const std::string& problem : files.problems)
            fmt::print(stderr, "rapidc fmt: {}\n", problem);
        if (!files.problems.empty()) return kBadUsage;
        if (!settings_.range.empty() && files.paths.size() != 1)
            return usage("--range needs exactly one module");
        if (!settings_.check && !settings_.diff) rapid::config::removeLeftoversBeside(files.paths);
        for (const std::string& path : files.paths)
            formatFile(path);
        return failed_ || (settings_.check && changed_) ? 1 : 0;
    }

  private:
    static int usage(const std::string& problem) {
        fmt::print(stderr, "rapidc fmt: {}\n", problem);
        return kBadUsage;
    }

    int runStdin() {
        if (!settings_.inputs.empty())
            return usage("--stdin reads the text to format and takes no input beside it");
        std::string bytes((std::istreambuf_iterator<char>(std::cin)), {});
        const auto source = std::make_shared<const rapid::SourceFile>(settings_.stdinName, std::move(bytes));
        const auto edits = formatSource(source);
        if (!edits) return 1;
        if (settings_.diff) {
            fmt::print("{}", unifiedDiff(*source, *edits));
        } else if (!settings_.check) {
            const auto result = rapid::edit::applyEdits(*source, *edits);
            if (!result.ok()) return fail(source->path(), result.problem), 1;
            std::fwrite(result.bytes.data(), 1, result.bytes.size(), stdout);
        }
        return settings_.check && !edits->empty() ? 1 : 0;
    }

    void fail(const std::string& path, const std::string& problem) {
        fmt::print(stderr, "rapidc fmt: {}: {}\n", path, problem);
        failed_ = true;
    }

    void formatFile(const std::string& path) {
        std::string problem;
        const auto source = rapid::workspace::readModuleFile(path, problem);
        if (!source) return fail(path, problem);
        const auto edits = formatSource(source);
        if (!edits || edits->empty()) return;
        changed_ = true;
        if (settings_.diff) fmt::print("{}", unifiedDiff(*source, *edits));
        if (settings_.check && !settings_.diff) fmt::print("{}\n", path);
        if (settings_.check || settings_.diff) return;
        const auto result = rapid::edit::applyEdits(*source, *edits);
        problem = result.ok() ? rapid::config::replaceFile(path, result.bytes) : result.problem;
        if (!problem.empty()) fail(path, problem);
    }

    /// No value: it cannot be formatted, which has been said.
    std::optional<std::vector<rapid::TextEdit>>
    formatSource(const std::shared_ptr<const rapid::SourceFile>& source) {
        diag::Sink sink;
        const auto tree = rapid::syntax::parse(source, sink);
        format::FormatRequest request = range_;
        request.keepErrors = settings_.keepErrors;
        const auto& settings = settingsOf(source->path());
        if (!settings)
            return fail(source->path(), "the project file has mistakes; the module is left as it is"),
                   std::nullopt;
        request.settings = *settings;
        if (request.settings.names == format::NameCase::Canonical) request.names = &predefinedNames();
        auto result = format::format(*tree, format::errorRanges(sink), request);
        if (result.ok()) return std::move(result.edits);
        show(sink);
        fail(source->path(), result.problem + "; it is left as it is");
        return std::nullopt;
    }

    /// The settings that hold for a module; none when its project file has mistakes, which are shown once.
    const std::optional<format::FormatSettings>& settingsOf(const std::string& path) {
        const std::string projectFile = rapid::project::findSettings(path);
        const auto known = projectFiles_.find(projectFile);
        if (known != projectFiles_.end()) return known->second;
        diag::Sink sink;
        std::optional<format::FormatSettings> read =
            format::readFormatSettings(rapid::project::loadSettings(path, sink), sink);
        show(sink);
        if (sink.hasErrors()) read.reset();
        return projectFiles_.emplace(projectFile, read).first->second;
    }

    static void show(const diag::Sink& sink) {
        const bool colour = isatty(STDERR_FILENO) != 0;
        for (const diag::Diagnostic& diagnostic : sink.sorted())
            fmt::print(stderr, "{}", diag::renderText(diagnostic, colour));
    }

    std::map<std::string, std::optional<format::FormatSettings>>
        projectFiles_; ///< by path; "": there is none
    const FmtSettings& settings_;
    format::FormatRequest range_;
    bool changed_ = false;
    bool failed_ = false;
};

} // namespace

void addFmtCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<FmtSettings>();
    const rt::Command command = line.addCommand("fmt", "Format modules without changing their meaning",
                                                [settings] { return Fmt(*settings).run(); });
    command.add("input", settings->inputs, "Modules; folders with all modules below them");
    command.addFlag("--check", settings->check,
                    "Change nothing; name the files that would change, and exit with 1");
    command.addFlag("--diff", settings->diff, "Change nothing; show what would change");
    command.addFlag("--stdin", settings->fromStdin,
                    "Read a module from standard input, write it to standard output");
    command.add("--stdin-name", settings->stdinName,
                "File name of that module: its type gives the encoding, its folder the settings");
    command.add("--range", settings->range, "FIRST:LAST: change only these lines");
    command.addFlag("--keep-errors", settings->keepErrors,
                    "Format around declarations with mistakes instead of refusing the module");
}

} // namespace rapidc
