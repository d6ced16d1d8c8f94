// libFuzzer target: any bytes become a text and tokens. Tokens lie in order, within the text, and the end is the last; line
// and column of any place are within the file.

#include "frontend/source/source_file.h"
#include "frontend/syntax/lexer.h"
#include "fuzz_support.h"

namespace {

using namespace rapid;
using fuzz::require;

void check(const char* name, const std::string& bytes) {
    const SourceFile file(name, bytes);
    const std::string_view text = file.text();
    require(text.size() <= 2 * bytes.size(), "a text of more than twice its bytes");
    const syntax::LexResult lexed = syntax::lex(text);
    require(!lexed.tokens.empty() && lexed.tokens.back().kind == syntax::TokenKind::EndOfFile,
            "no end of file");
    size_t end = 0;
    for (const syntax::Token& token : lexed.tokens) {
        require(token.offset >= end, "tokens overlap");
        end = size_t{token.offset} + token.length;
        require(end <= text.size(), "a token after the end");
        require(token.length > 0 || token.kind == syntax::TokenKind::EndOfFile, "an empty token");
    }
    for (const syntax::LexError& error : lexed.errors) {
        require(error.range.begin <= error.range.end && error.range.end <= text.size(),
                "an error after the end");
        const LineColumn at = file.lineColumn(error.range.begin);
        require(at.line >= 1 && at.line <= file.lineCount() && at.column >= 1, "a line that is not there");
    }
    for (uint32_t line = 0; line <= file.lineCount() + 1; ++line)
        require(file.lineText(line).size() <= text.size(), "a line longer than the text");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string bytes = fuzz::bytesOf(data, size);
    check("fuzz.modx", bytes);
    check("fuzz.mod", bytes);
    return 0;
}
