#pragma once
// The frames of the protocol: a header with Content-Length, an empty line, so many bytes of JSON.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lsp {

/// Takes bytes as they come and gives the bodies of whole frames. Headers that are none are passed over up to the next empty
/// line, so that a stray line does not end the conversation.
class FrameReader {
  public:
    void feed(std::string_view bytes) { bytes_.append(bytes); }
    /// The next body; nothing when more bytes are needed.
    std::optional<std::string> next();
    /// No frame can be found any more: the header is endless, or a body is larger than any message.
    bool isBroken() const { return broken_; }

    static constexpr size_t kLongestHeader = size_t{1} << 16;
    static constexpr size_t kLongestBody = size_t{1} << 30;

  private:
    bool readHeader();
    void dropRead();

    std::string bytes_;
    size_t read_ = 0; ///< bytes that were given out already
    std::optional<size_t> length_;
    bool broken_ = false;
};

/// A body with its header.
std::string frame(std::string_view body);

} // namespace lsp
