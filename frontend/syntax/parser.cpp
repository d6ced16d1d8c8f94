// The entry point of the parser.

#include "frontend/diag/messages/projects.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

namespace {

/// Mistakes of the file as a whole. Returns false when there is no text to parse.
bool checkEncoding(const std::shared_ptr<const SourceFile>& source, diag::Sink& sink) {
    const std::string_view text = source->text();
    if (source->isBinary()) {
        // FF FE and FE FF, the marks of UTF-16, were read as Latin-1.
        const bool utf16 = text.starts_with("\xC3\xBF\xC3\xBE") || text.starts_with("\xC3\xBE\xC3\xBF");
        if (source->isEncrypted()) {
            sink.report(say::EncryptedModule, source, {0, 0}, {source->path()});
            return false;
        }
        sink.report(utf16 ? say::Utf16File : say::BinaryFile, source, {0, 0});
        return false;
    }
    if (source->badUtf8Offset() >= 0) {
        const auto at = static_cast<uint32_t>(source->badUtf8Offset());
        // In the text the byte became the two bytes of its Latin-1 character.
        const unsigned byte = (static_cast<unsigned char>(text[at]) & 3u) << 6 |
                              (static_cast<unsigned char>(text[at + 1]) & 0x3Fu);
        sink.report(say::BadUtf8, source, {at, at + 2}, {fmt::format("0x{:02X}", byte)});
    } else if (source->encoding() == Encoding::Utf8Bom) {
        sink.report(say::ByteOrderMark, source, {0, 0});
    }
    return true;
}

/// The tree with its tokens; a binary file has none but the end.
std::unique_ptr<SyntaxTree> makeTree(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                     const ParseOptions& options, LexResult& lexed) {
    auto tree = std::make_unique<SyntaxTree>();
    tree->source = std::move(source);
    const std::string_view text = tree->source->text();
    if (checkEncoding(tree->source, sink)) {
        if (!options.earlier || !relex(*tree, *options.earlier, lexed)) {
            lexed = lex(text, options.wholeAggregates);
            tree->tokens = tree->arena.copy(lexed.tokens);
            tree->shapes = std::move(lexed.shapes);
        }
        tree->retagged = !lexed.errors.empty();
    } else {
        tree->retagged = true;
        tree->tokens = tree->arena.makeArray<Token>(1);
        tree->tokens[0].offset = static_cast<uint32_t>(text.size());
    }
    return tree;
}

/// What is reported here leaves open how the line was meant: there is no certain edit, and the text is not just too long or
/// in the wrong place.
bool leavesOpen(const diag::Diagnostic& d) {
    constexpr Code kClear[] = {say::StringTooLong.code, say::NameTooLong.code, say::NumberTooLarge.code,
                               say::DeclarationAfterInstruction.code};
    const bool certain =
        std::any_of(d.fixes.begin(), d.fixes.end(), [](const auto& fix) { return fix.certain; });
    const std::string_view text = d.file->text();
    if (d.code == say::MissingBlockEnd.code && !equalsNoCase(text.substr(d.range.begin, 3), "END"))
        return false;
    return d.severity == diag::Severity::Error && !certain &&
           std::find(std::begin(kClear), std::end(kClear), d.code) == std::end(kClear);
}

void noteUnclearLines(SyntaxTree& tree, std::span<const diag::Diagnostic> reported) {
    const std::string_view text = tree.source->text();
    for (const diag::Diagnostic& d : reported) {
        if (d.file != tree.source || !leavesOpen(d)) continue;
        uint32_t begin = d.range.begin;
        while (begin > 0 && d.range.begin - begin < SyntaxTree::kUnclearReach && text[begin - 1] != '\n' &&
               text[begin - 1] != '\r')
            --begin;
        tree.unclearLines.push_back(begin);
    }
    std::sort(tree.unclearLines.begin(), tree.unclearLines.end());
}

std::unique_ptr<SyntaxTree> parseOnce(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                      const ParseOptions& options) {
    LexResult lexed;
    const size_t before = sink.all().size();
    auto tree = makeTree(std::move(source), sink, options, lexed);
    if (!tree->source->isBinary()) Parser(*tree, sink, options).modules.parseFile(lexed);
    noteUnclearLines(*tree, std::span(sink.all()).subspan(before));
    return tree;
}

} // namespace

std::unique_ptr<SyntaxTree> parse(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                  const ParseOptions& options) {
    if (options.wholeAggregates) {
        diag::Sink own;
        ParseOptions all = options;
        all.wholeAggregates = false; // what is said of mistakes needs all tokens
        auto tree = parseOnce(source, own, options);
        if (own.hasErrors()) return parseOnce(std::move(source), sink, all);
        sink.add(own.all());
        return tree;
    }
    return parseOnce(std::move(source), sink, options);
}

ParsedExpr parseExpression(std::shared_ptr<const SourceFile> source, diag::Sink& sink) {
    LexResult lexed;
    ParsedExpr result;
    const ParseOptions options;
    result.tree = makeTree(std::move(source), sink, options, lexed);
    result.expr = Parser(*result.tree, sink, options).modules.parseWholeExpression(lexed);
    return result;
}

} // namespace rapid::syntax
