// Formatting: what `rapidc fmt` does, as edits of the document. While typing: the line that was left, and the end of a block
// that was begun.

#include "config/json_text.h"
#include "frontend/format/canonical_names.h"
#include "frontend/format/formatter.h"
#include "frontend/format/read_settings.h"
#include "frontend/project/files.h"
#include "frontend/syntax/parser.h"
#include "tools/lsp/block_ends.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <fmt/format.h>

namespace lsp {

namespace format = rapid::format;
using rapid::TextEdit;

namespace {

const format::NameTable& predefinedNames(const State& state) {
    static const format::NameTable names = [&state] {
        format::NameTable table;
        for (const rapid::sema::LibraryText& text : state.environment.library(false)) {
            rapid::diag::Sink ignored;
            rapid::syntax::ParseOptions options;
            options.declarations = true;
            const auto file =
                std::make_shared<const rapid::SourceFile>(std::string(text.name), std::string(text.text));
            format::addDeclaredNames(*rapid::syntax::parse(file, ignored, options), table);
        }
        return table;
    }();
    return names;
}

format::FormatSettings settingsFor(const State& state, const std::string& path) {
    rapid::diag::Sink sink;
    const auto settings =
        format::readFormatSettings(rapid::project::loadSettings(path, sink, &state.workspace.texts()), sink);
    if (sink.hasErrors())
        throw RequestError{error::kRequestFailed,
                           "the project file rapidc.json has mistakes: correct them first"};
    return settings;
}

/// Edits that touch become one: clients do not agree on the order of an insertion and a change at the same place.
std::vector<TextEdit> joined(const std::vector<TextEdit>& edits) {
    std::vector<TextEdit> out;
    for (const TextEdit& edit : edits) {
        if (out.empty() || out.back().range.end != edit.range.begin) {
            out.push_back(edit);
            continue;
        }
        out.back().range.end = edit.range.end;
        out.back().replacement += edit.replacement;
    }
    return out;
}

/// Declarations with mistakes stay as they are.
std::vector<TextEdit> editsFor(State& state, const Target& target, uint32_t firstLine, uint32_t lastLine) {
    if (!rapid::project::isModule(target.path))
        throw RequestError{error::kRequestFailed, "only modules can be formatted"};
    rapid::diag::Sink sink;
    const auto tree = rapid::syntax::parse(target.positions->source(), sink);
    format::FormatRequest request;
    request.settings = settingsFor(state, target.path);
    if (request.settings.names == format::NameCase::Canonical) request.names = &predefinedNames(state);
    request.keepErrors = true;
    request.firstLine = firstLine;
    request.lastLine = lastLine;
    format::FormatResult result = format::format(*tree, format::errorRanges(sink), request);
    if (!result.ok()) throw RequestError{error::kRequestFailed, result.problem};
    return joined(result.edits);
}

/// First letter of the line (from 1), or its end.
uint32_t beginOf(const rapid::SourceFile& file, uint32_t line) {
    const std::string_view text = file.lineText(line);
    return file.lineStart(line) + static_cast<uint32_t>(std::min(text.find_first_not_of(" \t"), text.size()));
}

/// A line (from 1) that has just been typed. Its indentation changes only when the line before it is as `rapidc fmt` indents it: most
/// files have an indentation of their own.
std::vector<TextEdit> editsOfTypedLine(State& state, const Target& target, uint32_t line) {
    const rapid::SourceFile& file = target.positions->file();
    uint32_t before = line - 1;
    while (before > 0 && beginOf(file, before) == file.lineStart(before) + file.lineText(before).size())
        --before;
    std::vector<TextEdit> edits = editsFor(state, target, std::max(before, 1u), line);
    const auto indents = [&](const TextEdit& edit, uint32_t of) {
        return edit.range.begin >= file.lineStart(of) && edit.range.end <= beginOf(file, of);
    };
    const bool own = before > 0 && std::any_of(edits.begin(), edits.end(),
                                               [&](const TextEdit& edit) { return indents(edit, before); });
    std::erase_if(edits, [&](const TextEdit& edit) {
        return edit.range.begin < file.lineStart(line) || (own && indents(edit, line));
    });
    return edits;
}

} // namespace

Json formatting(State& state, const Json& params) {
    objectField(params, "options");
    const Target target = state.target(params);
    return state.edits(*target.positions, editsFor(state, target, 1, UINT32_MAX));
}

Json rangeFormatting(State& state, const Json& params) {
    const Target target = state.target(params);
    const Range range = rangeOf(field(params, "range"));
    uint32_t last = range.end.line + 1;
    if (range.end.character == 0 && range.end.line > range.start.line) --last; // nothing of that line
    return state.edits(*target.positions, editsFor(state, target, range.start.line + 1, last));
}

Json onTypeFormatting(State& state, const Json& params) {
    const Target target = state.target(params);
    const Position position = positionOf(field(params, "position"));
    const std::string typed = textField(params, "ch");
    if (!target.tree) return Json::array();
    const rapid::SourceFile& file = target.positions->file();
    if (position.line >= file.lineCount()) return Json::array();
    if (typed == "\n" && position.line > 0) {
        const Json& options = objectField(params, "options");
        const auto columns = std::clamp<int64_t>(integerField(options, "tabSize"), 1, 16);
        const std::string step =
            boolField(options, "insertSpaces", true) ? std::string(static_cast<size_t>(columns), ' ') : "\t";
        if (const auto edits = endOfBlock(file, position.line, step))
            return state.edits(*target.positions, *edits);
        return state.edits(*target.positions, editsOfTypedLine(state, target, position.line));
    }
    if (typed == ";")
        return state.edits(*target.positions, editsOfTypedLine(state, target, position.line + 1));
    return Json::array();
}

} // namespace lsp
