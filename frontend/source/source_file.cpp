#include "frontend/source/source_file.h"

#include <algorithm>
#include <cstring>

namespace rapid {

namespace {

constexpr size_t kMaxBytes = 0x7FFFFFF0;

/// A byte of a UTF-8 sequence that is not its first.
bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

bool endsWithNoCase(std::string_view text, std::string_view suffix) {
    if (text.size() < suffix.size()) return false;
    text.remove_prefix(text.size() - suffix.size());
    return std::equal(text.begin(), text.end(), suffix.begin(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
    });
}

/// Length of the valid UTF-8 sequence at `p`, 0 if there is none (overlong forms and surrogates are none).
size_t utf8SequenceLength(const unsigned char* p, const unsigned char* end) {
    auto continues = [&](size_t i, unsigned char low = 0x80, unsigned char high = 0xBF) {
        return p + i < end && p[i] >= low && p[i] <= high;
    };
    const unsigned char c = *p;
    if (c < 0x80) return 1;
    if (c >= 0xC2 && c <= 0xDF) return continues(1) ? 2 : 0;
    if (c >= 0xE0 && c <= 0xEF) {
        const bool second = c == 0xE0   ? continues(1, 0xA0, 0xBF)
                            : c == 0xED ? continues(1, 0x80, 0x9F)
                                        : continues(1);
        return second && continues(2) ? 3 : 0;
    }
    if (c >= 0xF0 && c <= 0xF4) {
        const bool second = c == 0xF0   ? continues(1, 0x90, 0xBF)
                            : c == 0xF4 ? continues(1, 0x80, 0x8F)
                                        : continues(1);
        return second && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

/// Offset of the first byte that is not UTF-8, or the size.
size_t findBadUtf8(std::string_view bytes, size_t from = 0) {
    const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto* end = begin + bytes.size();
    const auto* p = begin + from;
    while (p < end) {
        uint64_t word;
        while (end - p >= 8 && (std::memcpy(&word, p, 8), (word & 0x8080808080808080ull) == 0))
            p += 8;
        if (p >= end) break;
        const size_t length = utf8SequenceLength(p, end);
        if (length == 0) return static_cast<size_t>(p - begin);
        p += length;
    }
    return bytes.size();
}

void appendLatin1(std::string& out, unsigned char c) {
    if (c < 0x80) {
        out.push_back(static_cast<char>(c));
    } else {
        out.push_back(static_cast<char>(0xC0 | (c >> 6)));
        out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
    }
}

std::string fromLatin1(std::string_view bytes) {
    std::string out;
    out.reserve(bytes.size() + bytes.size() / 16);
    for (const char c : bytes)
        appendLatin1(out, static_cast<unsigned char>(c));
    return out;
}

/// Keeps what is UTF-8 and turns each other byte into its Latin-1 character; `repaired` gets their places.
std::string repairUtf8(std::string_view bytes, std::vector<uint32_t>& repaired) {
    std::string out;
    out.reserve(bytes.size() + 16);
    size_t from = 0;
    while (from < bytes.size()) {
        const size_t bad = findBadUtf8(bytes, from);
        out.append(bytes.substr(from, bad - from));
        if (bad < bytes.size()) {
            repaired.push_back(static_cast<uint32_t>(out.size()));
            appendLatin1(out, static_cast<unsigned char>(bytes[bad]));
        }
        from = bad + 1;
    }
    return out;
}

/// Starts of all lines; a line ends with LF, CR or CRLF.
std::vector<uint32_t> findLines(std::string_view text) {
    std::vector<uint32_t> starts;
    starts.reserve(text.size() / 32 + 1);
    starts.push_back(0);
    const char* begin = text.data();
    const char* end = begin + text.size();
    if (text.find('\r') == std::string_view::npos) {
        for (const char* p = begin; p < end;) {
            const auto* found = static_cast<const char*>(std::memchr(p, '\n', static_cast<size_t>(end - p)));
            if (!found) break;
            p = found + 1;
            starts.push_back(static_cast<uint32_t>(p - begin));
        }
        return starts;
    }
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c != '\n' && c != '\r') continue;
        if (c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') ++i;
        starts.push_back(static_cast<uint32_t>(i + 1));
    }
    return starts;
}

/// Text has hardly any control characters; compressed, encrypted or compiled data are full of them.
bool hasManyControls(std::string_view bytes) {
    const auto count = std::count_if(bytes.begin(), bytes.end(), [](char c) {
        const bool layout = c == '\t' || c == '\n' || c == '\r' || c == '\f';
        return (static_cast<unsigned char>(c) < 0x20 && !layout) || c == 0x7F;
    });
    return count >= 4 && static_cast<size_t>(count) * 50 >= bytes.size();
}

/// Encrypted modules begin with 0xFC, 0xFD or 0xFE and are not text. A Latin-1 text may begin with that letter, and UTF-16
/// with FE FF.
bool looksEncrypted(std::string_view bytes) {
    if (bytes.empty() || bytes.starts_with("\xFE\xFF")) return false;
    const auto first = static_cast<unsigned char>(bytes[0]);
    if (first < 0xFC || first > 0xFE) return false;
    static constexpr std::string_view kWord = "ENDMODULE";
    const auto sameLetter = [](char a, char b) { return (a & ~0x20) == b; };
    return std::search(bytes.begin(), bytes.end(), kWord.begin(), kWord.end(), sameLetter) == bytes.end() ||
           hasManyControls(bytes);
}

constexpr uint32_t kCharacterBlock = 4096;

uint32_t countCharacters(std::string_view text, size_t begin, size_t end) {
    const std::string_view part = text.substr(begin, end - begin);
    return static_cast<uint32_t>(
        std::count_if(part.begin(), part.end(), [](char c) { return !isContinuation(c); }));
}

/// How many characters lie before each block of the text, and before its end.
std::vector<uint32_t> countCharacters(std::string_view text) {
    std::vector<uint32_t> before{0};
    before.reserve(text.size() / kCharacterBlock + 1);
    for (size_t end = kCharacterBlock; end <= text.size(); end += kCharacterBlock)
        before.push_back(before.back() + countCharacters(text, end - kCharacterBlock, end));
    return before;
}

/// Without the NUL bytes and Ctrl-Z that disks and old tools leave at the end of a text.
std::string_view withoutPadding(std::string_view bytes) {
    const size_t last = bytes.find_last_not_of(std::string_view("\0\x1A \t\r\n", 6));
    return bytes.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

} // namespace

bool isValidUtf8(std::string_view bytes) {
    return findBadUtf8(bytes) == bytes.size();
}

bool SourceFile::isLegacyFileType(std::string_view path) {
    return endsWithNoCase(path, ".mod") || endsWithNoCase(path, ".sys") || endsWithNoCase(path, ".prg");
}

SourceFile::SourceFile(std::string path, std::string bytes) : path_(std::move(path)) {
    if (bytes.size() > kMaxBytes) { // offsets have 32 bits, and Latin-1 may double the size
        binary_ = true;
        bytes.clear();
    }
    encrypted_ = looksEncrypted(bytes);
    binary_ |= encrypted_ || withoutPadding(bytes).find('\0') != std::string_view::npos;
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.erase(0, 3);
        encoding_ = Encoding::Utf8Bom;
    }
    const size_t bad = findBadUtf8(bytes);
    if (bad < bytes.size() && hasManyControls(withoutPadding(bytes))) binary_ = true;
    if (bad == bytes.size()) {
        text_ = std::move(bytes);
    } else if (binary_ || (isLegacyFileType(path_) && encoding_ != Encoding::Utf8Bom)) {
        text_ = fromLatin1(bytes);
        encoding_ = Encoding::Latin1;
    } else {
        text_ = repairUtf8(bytes, repaired_);
        badUtf8Offset_ = static_cast<int64_t>(bad);
    }
    lineStarts_ = findLines(text_);
    characters_ = countCharacters(text_);
}

std::string SourceFile::bytes(SourceRange range) const {
    const auto inside = [&](uint32_t at) { return at < text_.size() && isContinuation(text_[at]); };
    if (range.begin > range.end || range.end > text_.size() || inside(range.begin) || inside(range.end))
        return {};
    const std::string_view part = std::string_view(text_).substr(range.begin, range.end - range.begin);
    if (encoding_ != Encoding::Latin1 && repaired_.empty()) return std::string(part);
    std::string out;
    out.reserve(part.size());
    auto repaired = std::lower_bound(repaired_.begin(), repaired_.end(), range.begin);
    for (uint32_t at = range.begin; at < range.end; ++at) {
        const auto c = static_cast<unsigned char>(text_[at]);
        const bool oneByte =
            encoding_ == Encoding::Latin1 ? c >= 0x80 : repaired != repaired_.end() && *repaired == at;
        if (!oneByte) {
            out.push_back(text_[at]);
            continue;
        }
        if (encoding_ != Encoding::Latin1) ++repaired;
        ++at;
        out.push_back(static_cast<char>((c & 0x03) << 6 | (static_cast<unsigned char>(text_[at]) & 0x3F)));
    }
    return out;
}

std::string SourceFile::bytes() const {
    std::string all = bytes({0, static_cast<uint32_t>(text_.size())});
    return encoding_ == Encoding::Utf8Bom ? "\xEF\xBB\xBF" + all : all;
}

LineColumn SourceFile::lineColumn(uint32_t offset) const {
    offset = std::min(offset, static_cast<uint32_t>(text_.size()));
    const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
    const auto line = static_cast<uint32_t>(next - lineStarts_.begin());
    const uint32_t start = lineStarts_[line - 1];
    const bool near = offset - start < kCharacterBlock;
    return {line, (near ? countCharacters(text_, start, offset)
                        : charactersBefore(offset) - charactersBefore(start)) +
                      1};
}

uint32_t SourceFile::charactersBefore(uint32_t offset) const {
    const size_t block = offset / kCharacterBlock;
    return characters_[block] + countCharacters(text_, block * kCharacterBlock, offset);
}

std::string_view SourceFile::lineText(uint32_t line) const {
    if (line == 0 || line > lineStarts_.size()) return {};
    const uint32_t begin = lineStarts_[line - 1];
    const size_t end = line < lineStarts_.size() ? lineStarts_[line] : text_.size();
    std::string_view text = std::string_view(text_).substr(begin, end - begin);
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

} // namespace rapid
