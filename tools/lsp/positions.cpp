#include "tools/lsp/positions.h"

#include <algorithm>

namespace lsp {

namespace {

constexpr uint32_t kBlock = 4096;

bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// UTF-16 units of a byte: characters count at their first byte.
uint32_t unitsOf(char c) {
    if (isContinuation(c)) return 0;
    return static_cast<unsigned char>(c) >= 0xF0 ? 2 : 1;
}

uint32_t countUnits(std::string_view text) {
    uint32_t units = 0;
    for (const char c : text)
        units += unitsOf(c);
    return units;
}

bool isAscii(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return (c & 0x80) != 0; });
}

/// How many bytes of `line` so many units take. A unit within a character means its beginning.
size_t bytesOf(std::string_view line, uint32_t units, PositionEncoding encoding) {
    size_t at = 0;
    if (encoding == PositionEncoding::Utf8) {
        at = std::min<size_t>(units, line.size());
        while (at > 0 && at < line.size() && isContinuation(line[at]))
            --at;
        return at;
    }
    while (at < line.size() && units > 0) {
        const uint32_t next = unitsOf(line[at]);
        if (next > units) break;
        units -= next;
        ++at;
        while (at < line.size() && isContinuation(line[at]))
            ++at;
    }
    return at;
}

} // namespace

PositionMap::PositionMap(std::shared_ptr<const rapid::SourceFile> file, PositionEncoding encoding)
    : file_(std::move(file)), bytesAreUnits_(encoding == PositionEncoding::Utf8 || isAscii(file_->text())) {
    if (bytesAreUnits_) return;
    const std::string_view text = file_->text();
    blocks_.push_back(0);
    for (size_t begin = 0; begin + kBlock <= text.size(); begin += kBlock)
        blocks_.push_back(blocks_.back() + countUnits(text.substr(begin, kBlock)));
}

uint32_t PositionMap::unitsBefore(uint32_t offset) const {
    if (bytesAreUnits_) return offset;
    const uint32_t block = offset / kBlock;
    return blocks_[block] + countUnits(file_->text().substr(block * kBlock, offset - block * kBlock));
}

Position PositionMap::at(uint32_t offset) const {
    offset = std::min(offset, static_cast<uint32_t>(file_->text().size()));
    uint32_t low = 1, high = file_->lineCount(); // the last line that begins at or before it
    while (low < high) {
        const uint32_t middle = low + (high - low + 1) / 2;
        if (file_->lineStart(middle) <= offset)
            low = middle;
        else
            high = middle - 1;
    }
    return {low - 1, unitsBefore(offset) - unitsBefore(file_->lineStart(low))};
}

uint32_t PositionMap::offset(Position position) const {
    if (position.line >= file_->lineCount()) return static_cast<uint32_t>(file_->text().size());
    const uint32_t start = file_->lineStart(position.line + 1);
    const std::string_view line = file_->lineText(position.line + 1);
    if (bytesAreUnits_)
        return start + static_cast<uint32_t>(bytesOf(line, position.character, PositionEncoding::Utf8));
    // The block in which the place lies, then the rest of the way.
    const uint32_t end = start + static_cast<uint32_t>(line.size());
    const uint32_t wanted = unitsBefore(start) + position.character;
    const auto next = std::upper_bound(blocks_.begin(), blocks_.end(), wanted);
    const auto block = static_cast<uint32_t>(next - blocks_.begin() - 1) * kBlock;
    uint32_t from = std::clamp(block, start, end);
    while (from > start && isContinuation(file_->text()[from]))
        --from;
    const uint32_t before = unitsBefore(from);
    const uint32_t missing = wanted > before ? wanted - before : 0;
    return from + static_cast<uint32_t>(
                      bytesOf(file_->text().substr(from, end - from), missing, PositionEncoding::Utf16));
}

size_t offsetIn(std::string_view text, Position position, PositionEncoding encoding) {
    size_t start = 0;
    for (uint32_t line = 0; line < position.line; ++line) {
        const size_t end = text.find_first_of("\r\n", start);
        if (end == std::string_view::npos) return text.size();
        start = end + (text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n' ? 2 : 1);
    }
    const size_t end = std::min(text.find_first_of("\r\n", start), text.size());
    return start + bytesOf(text.substr(start, end - start), position.character, encoding);
}

} // namespace lsp
