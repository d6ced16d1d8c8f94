// Mistakes of the lexer.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/reports.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rapid::syntax {

/// The second line of a string that was broken in two: its closing '"' looks like the beginning of another string.
bool LexicalMistakes::endsBrokenString(const LexError& error, const LexError* before) const {
    if (error.code != say::UnterminatedString.code || !before || before->code != say::UnterminatedString.code)
        return false;
    const std::string_view text = in_.sourceText();
    const uint32_t line = in_.tree().source->lineColumn(error.range.begin).line;
    if (in_.tree().source->lineColumn(before->range.begin).line + 1 != line) return false;
    const size_t next = text.find_first_not_of(" \t", error.range.begin + 1);
    constexpr std::string_view kAfterString = ";,)]\\+\r\n";
    return next == std::string_view::npos || kAfterString.find(text[next]) != std::string_view::npos;
}

/// A backslash in a string that does not end: the mistake is the missing '"'. Both are near in the list.
bool LexicalMistakes::isInBrokenString(const LexResult& lexed, const LexError& escape) {
    constexpr std::ptrdiff_t kNear = 64;
    const LexError *begin = lexed.errors.data(), *end = begin + lexed.errors.size();
    return std::any_of(std::max(begin, &escape - std::min(kNear, &escape - begin)),
                       &escape + std::min(kNear, end - &escape), [&](const LexError& e) {
                           return e.code == say::UnterminatedString.code &&
                                  e.range.begin <= escape.range.begin && escape.range.end <= e.range.end;
                       });
}

void LexicalMistakes::report(const LexResult& lexed, Reports& reports) {
    const LexError* before = nullptr;
    for (const LexError& error : lexed.errors) {
        badNumbers_ |= error.code == say::BadNumber.code;
        if (error.code == say::BadNumber.code) continue; // reported where the number is read
        if (error.code == say::ForeignSpelling.code && error.args[0] == "==") continue; // so is what it means
        if (error.code == say::BadStringEscape.code && isInBrokenString(lexed, error)) continue;
        const LexError* last = std::exchange(before, &error);
        if (endsBrokenString(error, last)) {
            hideBetween(last->range, error.range);
            before = nullptr;
            continue;
        }
        const size_t errors = reports.countError();
        if (error.code == say::UnterminatedString.code) {
            brokenStrings_.push_back({error.range, {}});
            continue;
        }
        reported_.push_back(error.range.begin);
        if (errors <= kMaxErrorsPerFile) {
            diag::Diagnostic& d = sink_.report(error.code, in_.tree().source, error.range, error.args);
            if (error.code == say::BadStringEscape.code) fixEscapes(d);
            if (error.fix) d.fix(error.range, *error.fix);
        } else if (errors == kMaxErrorsPerFile + 1) {
            sink_.report(say::TooManyErrors, in_.tree().source, error.range, {"errors"});
        }
    }
}

/// The text between the two lines of a broken string is not code.
void LexicalMistakes::hideBetween(SourceRange first, SourceRange second) {
    const Token* begin = &in_.tokenAt(0);
    const Token* end = begin + in_.lastToken();
    const Token* between = std::lower_bound(
        begin, end, first.end, [](const Token& token, uint32_t offset) { return token.offset < offset; });
    for (; between < end && between->offset < second.begin; ++between)
        in_.readAs(static_cast<TokenIndex>(between - begin), TokenKind::Error);
}

bool LexicalMistakes::covers(SourceRange range) {
    if (std::binary_search(reported_.begin(), reported_.end(), range.begin)) return true;
    const auto broken =
        std::lower_bound(brokenStrings_.begin(), brokenStrings_.end(), range.begin,
                         [](const BrokenString& s, uint32_t at) { return s.range.begin < at; });
    if (broken == brokenStrings_.end()) return false;
    const size_t end = in_.sourceText().find_first_of("\r\n", range.begin);
    if (end < broken->range.begin) return false;
    if (broken->doubtful.end == 0) broken->doubtful = range;
    return true;
}

void LexicalMistakes::reportBrokenStrings() {
    for (const BrokenString& string : brokenStrings_) {
        diag::Diagnostic& d = sink_.report(say::UnterminatedString, in_.tree().source, string.range);
        if (string.doubtful.end != 0)
            d.notes.push_back(
                {in_.tree().source, string.doubtful,
                 "this is between two strings: a '\"' may be missing or one too many before it"});
    }
}

/// Doubles each backslash of the string that means itself. Not certain beside character codes: a path may look
/// like one (`"C:\temp\data"`).
void LexicalMistakes::fixEscapes(diag::Diagnostic& diagnostic) const {
    const std::string_view text = in_.sourceText();
    const auto isHex = [&](size_t at) {
        return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at]));
    };
    diag::Diagnostic::Fix all{"write each '\\' twice", {}};
    for (auto at = diagnostic.range.begin; at < text.size() && text[at] != '\n' && text[at] != '\r'; ++at) {
        const bool last = at + 1 == text.size();
        if (text[at] == '"') {
            if (last || text[at + 1] != '"') break;
            ++at;
        } else if (text[at] == '\\') {
            if (!last && text[at + 1] == '\\')
                ++at;
            else if (isHex(at + 1) && isHex(at + 2))
                all.certain = false;
            else
                all.edits.push_back({{at, at}, "\\"});
        }
    }
    diagnostic.fixes.push_back(std::move(all));
}

} // namespace rapid::syntax
