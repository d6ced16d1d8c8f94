#pragma once
// A source text in memory with its encoding and line map. First stage of the front end.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rapid {

/// Encoding of the bytes on disk (manual 1.1.3). Text in memory is always UTF-8.
enum class Encoding : uint8_t { Utf8, Utf8Bom, Latin1 };

/// A position for people: line and column from 1; the column counts code points.
struct LineColumn {
    uint32_t line = 1;
    uint32_t column = 1;
};

/// A half-open byte range [begin, end) in the text of one source file.
struct SourceRange {
    uint32_t begin = 0;
    uint32_t end = 0;
    bool operator==(const SourceRange&) const = default;
};

/// A change of a text: the range is replaced. An empty range inserts, an empty replacement deletes.
struct TextEdit {
    SourceRange range;
    std::string replacement; ///< UTF-8
};

bool isValidUtf8(std::string_view bytes);

/// Text of one file, converted to UTF-8, immutable after construction.
class SourceFile {
  public:
    /// Takes the raw bytes of a file. Valid UTF-8 stays; anything else in a `.mod`, `.sys` or `.prg` file is read as
    /// ISO 8859-1. In other files a byte sequence that is not UTF-8 is kept as Latin-1 too, with `badUtf8Offset()` set.
    SourceFile(std::string path, std::string bytes);

    const std::string& path() const { return path_; }
    std::string_view text() const { return text_; }
    Encoding encoding() const { return encoding_; }
    /// Offset in text() of the first byte that was not UTF-8 although the file type demands it; -1 if none.
    int64_t badUtf8Offset() const { return badUtf8Offset_; }
    /// True for encrypted modules and other binary junk (NUL bytes, unless they only fill up the end).
    bool isBinary() const { return binary_; }
    /// True for a module that a controller encrypted: first byte 0xFC, 0xFD or 0xFE, and no text.
    bool isEncrypted() const { return encrypted_; }

    /// The bytes on disk from which a range of text() was made; the byte order mark is never among them. Empty for a
    /// range that is not in the text or does not begin and end between characters.
    std::string bytes(SourceRange range) const;
    /// All bytes of the file, the byte order mark included.
    std::string bytes() const;

    /// True for `.mod`, `.sys` and `.prg`: file types of RobotWare 6 and older, which were ISO 8859-1 (manual 1.1.3).
    static bool isLegacyFileType(std::string_view path);

    LineColumn lineColumn(uint32_t offset) const;
    /// Text of a line (from 1) without its end-of-line characters.
    std::string_view lineText(uint32_t line) const;
    uint32_t lineCount() const { return static_cast<uint32_t>(lineStarts_.size()); }
    uint32_t lineStart(uint32_t line) const { return lineStarts_[line - 1]; }

  private:
    uint32_t charactersBefore(uint32_t offset) const;

    std::string path_;
    std::string text_;
    std::vector<uint32_t> lineStarts_;
    std::vector<uint32_t> characters_; ///< how many lie before each block of text_; a line may have megabytes
    std::vector<uint32_t>
        repaired_; ///< offsets in text_ of characters that stand for one byte that was not UTF-8
    Encoding encoding_ = Encoding::Utf8;
    int64_t badUtf8Offset_ = -1;
    bool binary_ = false;
    bool encrypted_ = false;
};

} // namespace rapid
