#include "tools/lsp/frames.h"

#include "config/text_util.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace lsp {

namespace {

/// The number of "Content-Length: 12", if the line is one.
std::optional<size_t> lengthIn(std::string_view line) {
    constexpr std::string_view kName = "Content-Length";
    const size_t colon = line.find(':');
    if (colon == std::string_view::npos ||
        !rapid::config::sameName(rapid::config::trimmed(line.substr(0, colon)), kName))
        return {};
    const std::string_view value = rapid::config::trimmed(line.substr(colon + 1));
    size_t length = 0;
    const auto [end, problem] = std::from_chars(value.data(), value.data() + value.size(), length);
    if (problem == std::errc::result_out_of_range) return SIZE_MAX;
    if (problem != std::errc() || end != value.data() + value.size()) return {};
    return length;
}

} // namespace

void FrameReader::dropRead() {
    if (read_ < (size_t{1} << 16) && read_ < bytes_.size()) return;
    bytes_.erase(0, read_);
    read_ = 0;
}

// Reads lines up to an empty one. False: it is not complete yet.
bool FrameReader::readHeader() {
    const std::string_view rest = std::string_view(bytes_).substr(read_);
    std::optional<size_t> length;
    for (size_t from = 0;;) {
        const size_t end = rest.find('\n', from);
        if (end == std::string_view::npos) {
            broken_ = rest.size() > kLongestHeader;
            return false;
        }
        std::string_view line = rest.substr(from, end - from);
        if (line.ends_with('\r')) line.remove_suffix(1);
        from = end + 1;
        if (const auto found = lengthIn(line)) length = found;
        if (!line.empty()) continue;
        read_ += from;
        length_ = length; // none: these lines were no header
        broken_ = length && *length > kLongestBody;
        return true;
    }
}

std::optional<std::string> FrameReader::next() {
    while (!broken_) {
        if (!length_) {
            if (!readHeader()) break;
            continue;
        }
        if (bytes_.size() - read_ < *length_) break;
        std::string body = bytes_.substr(read_, *length_);
        read_ += *length_;
        length_.reset();
        dropRead();
        return body;
    }
    return {};
}

std::string frame(std::string_view body) {
    return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

} // namespace lsp
