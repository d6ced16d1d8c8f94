#include "frontend/syntax/lexer.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/lexer_impl.h"
#include "frontend/syntax/limits.h"
#include "frontend/syntax/plain_pieces.h"

namespace rapid::syntax {

namespace {

constexpr size_t kMaxPieces = 128; ///< of aggregates whose shape is noted

constexpr std::array<TokenKind, 128> kSingles = [] {
    std::array<TokenKind, 128> table{};
    table[';'] = TokenKind::Semicolon;
    table[','] = TokenKind::Comma;
    table[':'] = TokenKind::Colon;
    table['('] = TokenKind::LeftParen;
    table[')'] = TokenKind::RightParen;
    table['{'] = TokenKind::LeftBrace;
    table['}'] = TokenKind::RightBrace;
    table['['] = TokenKind::LeftBracket;
    table[']'] = TokenKind::RightBracket;
    table['\\'] = TokenKind::Backslash;
    table['?'] = TokenKind::Question;
    table['|'] = TokenKind::Bar;
    table['%'] = TokenKind::Percent;
    table['+'] = TokenKind::Plus;
    table['-'] = TokenKind::Minus;
    table['*'] = TokenKind::Star;
    table['/'] = TokenKind::Slash;
    table['='] = TokenKind::Equal;
    table['>'] = TokenKind::Greater;
    return table;
}();

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isHexDigit(char c) {
    return isDigit(c) || ((c | 32) >= 'a' && (c | 32) <= 'f');
}

} // namespace

LexResult Lexer::run() {
    result_.tokens.reserve(static_cast<size_t>(end_ - begin_) / 3 + 16);
    readFileHeader();
    while (skipGap())
        readToken();
    push(TokenKind::EndOfFile, end_);
    return std::move(result_);
}

LexResult Lexer::runPart(size_t from, size_t to, TokenKind before) {
    before_ = before;
    p_ = begin_ + from;
    while (skipGap() && p_ < begin_ + to)
        readToken();
    if (p_ == end_) push(TokenKind::EndOfFile, end_);
    return std::move(result_);
}

bool Lexer::skipGap() {
    const char* p = p_; // a local one stays in a register, here and in other loops over characters
    for (;;) {
        const CharClass c = classAt(p);
        if (c == CharClass::Space) {
            ++p;
        } else if (c == CharClass::Comment) {
            p_ = p;
            if (p[1] == '=' && isNotEqual()) break;
            do
                ++p;
            while (p < end_ && !isLineEnd(*p));
        } else {
            break;
        }
    }
    p_ = p < padding_ ? p : end_;
    return p < padding_;
}

const char* Lexer::findPadding(const char* begin, const char* end) {
    while (end > begin && (end[-1] == 0x1A || end[-1] == 0 || classAt(end - 1) == CharClass::Space))
        --end;
    return end;
}

void Lexer::readToken() {
    switch (classAt(p_)) {
    case CharClass::Letter: return readWord();
    case CharClass::Digit: return readNumber();
    case CharClass::Quote: return readString();
    case CharClass::Punctuation:
        if (*p_ == '%' && slice(p_, end_).starts_with("%%%") && lastKind() == TokenKind::KwEndmodule)
            return readFileHeader(); // files of several modules, put together from others
        return readPunctuation();
    case CharClass::Dot:
        if (isDigit(p_[1])) return readNumber();
        return readSingle(TokenKind::Dot);
    case CharClass::Less: return readLess();
    case CharClass::NonAscii:
        if (isLatin1Letter(p_)) return readWord();
        return readJunk();
    case CharClass::Comment: return readNotEqual();
    case CharClass::Junk:
    case CharClass::Space: return readJunk();
    }
}

void Lexer::readSingle(TokenKind kind) {
    const char* start = p_++;
    push(kind, start);
}

void Lexer::readWord() {
    const char* start = p_;
    skipWordChars();
    const TokenKind kind = keywordKind(slice(start, p_));
    result_.hasModule |= kind == TokenKind::KwModule;
    push(kind, start);
}

void Lexer::skipDigits() {
    const char* p = p_;
    while (isDigit(*p))
        ++p;
    p_ = p;
}

void Lexer::readNumber() {
    const char* start = p_;
    const char prefix = static_cast<char>(p_[1] | 32);
    bool valid = true;
    if (*p_ == '0' && (prefix == 'x' || prefix == 'o' || prefix == 'b')) {
        const char* digits = p_ += 2;
        if (prefix == 'x')
            while (isHexDigit(*p_))
                ++p_;
        if (prefix == 'o')
            while (*p_ >= '0' && *p_ <= '7')
                ++p_;
        if (prefix == 'b')
            while (*p_ == '0' || *p_ == '1')
                ++p_;
        valid = p_ > digits;
    } else {
        skipDigits();
        if (*p_ == '.') {
            ++p_;
            skipDigits();
        }
        if ((*p_ | 32) == 'e') {
            const char* digits = p_ + 1;
            if (*digits == '+' || *digits == '-') ++digits;
            if (isDigit(*digits)) {
                p_ = digits;
                skipDigits();
            }
        }
    }
    if (kWordChars[byteAt(p_)] || isLatin1Letter(p_) || *p_ == '.') { // glued to what follows
        valid = false;
        while (*p_ == '.' || kWordChars[byteAt(p_)] || isLatin1Letter(p_))
            ++p_, skipContinuation();
    }
    if (!valid)
        addError(diag::say::BadNumber.code, start, p_, {},
                 {}); // the parser reports it where it reads the number
    push(TokenKind::NumLiteral, start);
}

void Lexer::readString() {
    const char* start = p_++;
    size_t saved = 0; // bytes that codes and doubled characters take beyond their value
    bool badEscape = false;
    for (;;) {
        const char c = *p_;
        if (c == '"') {
            if (p_[1] != '"') break;
            p_ += 2;
            ++saved;
        } else if (c == '\\') {
            if (p_[1] == '\\') {
                p_ += 2;
                ++saved;
            } else if (isHexDigit(p_[1]) && isHexDigit(p_[2])) {
                p_ += 3;
                saved += 2;
            } else {
                if (!badEscape) reportEscape();
                badEscape = true;
                ++p_;
            }
        } else if (isLineEnd(c) || p_ >= end_) {
            error(say::UnterminatedString, start, p_);
            return push(TokenKind::Error, start);
        } else {
            ++p_;
        }
    }
    ++p_;
    const size_t bytes = static_cast<size_t>(p_ - start) - 2 - saved;
    if (bytes > kStringCapacity) error(say::StringTooLong, start, p_, {std::to_string(bytes)});
    push(TokenKind::StringLiteral, start);
}

void Lexer::reportEscape() {
    const char* to = p_ + 1;
    if (to < end_ && !isLineEnd(*to) && *to != '"') {
        ++to;
        while ((byteAt(to) & 0xC0) == 0x80)
            ++to;
    }
    error(say::BadStringEscape, p_, to, {std::string(slice(p_, to))});
}

bool Lexer::readPlainAggregate() {
    if (lastKind() != TokenKind::Assign) return false;
    const char* start = p_;
    PlainText<false> pieces(start);
    std::array<PlainPiece, kMaxPieces> shape; // not initialised: this is done for each taught point
    size_t count = 0;
    const auto note = [&](PlainPiece piece) {
        if (count < kMaxPieces) shape[count] = piece;
        ++count;
    };
    if (!skipPlainAggregate(pieces, note)) return false;
    const char* end = pieces.end();
    if (end - start > static_cast<std::ptrdiff_t>(kMaxTokenLength)) return false;
    const char* after = end;
    while (classAt(after) == CharClass::Space)
        ++after;
    if (*after != ';') return false;
    p_ = end;
    push(TokenKind::PlainAggregate, start);
    if (count <= kMaxPieces) noteShape(std::span(shape.data(), count));
    return true;
}

void Lexer::noteShape(std::span<const PlainPiece> pieces) {
    const auto is = [&](const std::vector<PlainPiece>& shape) {
        return std::equal(pieces.begin(), pieces.end(), shape.begin(), shape.end());
    };
    std::vector<WholeAggregate>& noted = result_.aggregates;
    auto& shapes = result_.shapes;
    const size_t last = noted.empty() ? 0 : noted.back().shape;
    size_t at = last;
    if (shapes.empty() || !is(shapes[last]))
        at = static_cast<size_t>(std::find_if(shapes.begin(), shapes.end(), is) - shapes.begin());
    if (at == AggregateExpr::kNoShape) return;
    if (at == shapes.size()) shapes.emplace_back(pieces.begin(), pieces.end());
    noted.push_back({static_cast<TokenIndex>(result_.tokens.size() - 1), static_cast<uint8_t>(at)});
}

void Lexer::readPunctuation() {
    const char* start = p_;
    if (*p_ == '[' && wholeAggregates_ && readPlainAggregate()) return;
    const char c = *p_++;
    TokenKind kind = kSingles[static_cast<size_t>(c)];
    if (*p_ == '=' && (c == ':' || c == '>')) {
        ++p_;
        kind = c == ':' ? TokenKind::Assign : TokenKind::GreaterEqual;
    } else if (kForeignSeconds[byteAt(p_)] && readForeign(start)) {
        return;
    }
    push(kind, start);
}

void Lexer::readLess() {
    const char* start = p_++;
    if (*p_ == '=') return ++p_, push(TokenKind::LessEqual, start);
    if (*p_ == '>') return ++p_, push(TokenKind::NotEqual, start);
    // "<id>" cannot be two relations, because relations do not chain.
    const char* close = p_;
    while (close < p_ + 4 && classAt(close) == CharClass::Letter)
        ++close;
    if (*close == '>' && close - p_ >= 2) {
        const std::string_view text = slice(start, close + 1);
        for (auto k = static_cast<int>(TokenKind::PlaceTdn); k <= static_cast<int>(TokenKind::PlaceId); ++k) {
            if (!equalsNoCase(text, tokenText(static_cast<TokenKind>(k)))) continue;
            p_ = close + 1;
            return push(static_cast<TokenKind>(k), start);
        }
    }
    push(TokenKind::Less, start);
}

void Lexer::readFileHeader() {
    if (!skipGap() || !slice(p_, end_).starts_with("%%%")) return;
    const char* start = p_;
    const std::string_view rest = slice(start, end_);
    const size_t close = rest.find("%%%", 3);
    if (close != std::string_view::npos) {
        p_ = start + close + 3;
    } else {
        p_ = start + 3;
        error(say::UnclosedFileHeader, start, p_);
        while (p_ < end_ && !equalsNoCase(slice(p_, end_).substr(0, 6), "MODULE"))
            ++p_;
    }
    push(TokenKind::FileHeader, start);
}

LexResult lex(std::string_view text, bool wholeAggregates) {
    return Lexer(text, wholeAggregates).run();
}

LexResult lexPart(std::string_view text, size_t from, size_t to, TokenKind before) {
    return Lexer(text).runPart(from, to, before);
}

} // namespace rapid::syntax
