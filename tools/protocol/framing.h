#pragma once
// Messages over a pipe as the language server protocol and the debug adapter protocol send them: header lines, of which
// Content-Length counts, an empty line, and so many bytes.

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace protocol {

/// Takes messages out of a stream of bytes that comes in pieces.
class FrameReader {
  public:
    static constexpr std::size_t kLongestHeader = 16u << 10;
    static constexpr std::size_t kLongestMessage = 256u << 20;

    /// The treatment of lines before an empty one that are not a header.
    enum class Stray {
        Refused, ///< they end the conversation
        Skipped  ///< the conversation continues after them
    };

    enum class Result {
        Message,
        More,  ///< the bytes so far end inside a message
        Broken ///< they are not a message; see problem(). The rest cannot be read any more
    };

    explicit FrameReader(Stray stray = Stray::Refused) : stray_(stray) {}

    void add(std::string_view bytes) { buffer_.append(bytes); }
    /// The next message, without its header.
    Result next(std::string& message);
    const std::string& problem() const { return problem_; }
    /// Bytes of a message that is not complete.
    bool isInside() const { return inBody_ || begin_ < buffer_.size(); }

  private:
    Result broken(std::string problem);
    Result readHeader();
    std::string lengthIn(std::string_view header);

    Stray stray_;
    std::string buffer_;
    std::size_t begin_ = 0;  ///< of what has not been taken
    std::size_t length_ = 0; ///< of the message whose header was read
    bool inBody_ = false;
    std::string problem_;
};

/// "Content-Length: ..." and the message.
std::string frame(std::string_view message);

/// Reads and writes messages. One thread reads; any thread writes.
class Channel {
  public:
    Channel(int input, int output) : input_(input), output_(output) {}

    /// Blocks until a message has come. False at the end of the input, and when it is broken: then `problem` says how.
    bool read(std::string& message, std::string& problem);
    /// False when the other side has gone.
    bool write(std::string_view message);

  private:
    int input_, output_;
    FrameReader reader_;
    std::mutex writing_;
};

} // namespace protocol
