#pragma once
// OpenFile: a file or device that a program has opened (manual 1.10). Bytes only; knows nothing of tasks and errors of RAPID.

#include "runtime/base/descriptor.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace rt::lib {

class OpenFile {
  public:
    struct Mode {
        bool reads = false, writes = false;
        bool appends = false; ///< whatever is written goes to the end (the descriptor has O_APPEND)
    };
    /// Reads from `input` and writes to `output`, or reads and writes `input` when `output` is not open. `name`: as people
    /// know it. `isDevice`: more may come although the end was reached, and what is written leaves at once.
    OpenFile(std::string name, Mode mode, Descriptor input, Descriptor output, bool isDevice);

    const std::string& name() const { return name_; }
    const Mode& mode() const { return mode_; }
    bool isDevice() const { return isDevice_; }
    /// A descriptor for poll(): it is ready when there is something to read. False for what never waits (files).
    bool canPoll() const;
    int input() const { return input_.number(); }

    // ---- Writing: "", or why it is not possible. Nothing of `bytes` was taken then, and what was written earlier is kept.
    std::string write(std::string_view bytes);
    /// Hands over what was written to the host. `calendar`: time of the change, in seconds since 1970.
    std::string flush(int64_t calendar);
    bool hasPending() const { return !pending_.empty(); }
    bool wasWritten() const { return written_; }
    /// The file was made or emptied when it was opened: flush() notes the time of that, too.
    void noteChange() { written_ = true; }

    // ---- Reading
    /// Bytes that have been read from the host and not consumed.
    std::string_view buffered() const { return std::string_view(buffer_).substr(next_); }
    void consume(std::size_t bytes) { next_ += bytes; }
    enum class Fill : uint8_t { More, End, Later, Failed };
    /// Reads more bytes into the buffer. Later: none now, but some may come. Failed: `problem` says why.
    Fill fill(std::string& problem);
    /// Forgets what has been received by a device.
    void discardInput();
    /// To the first byte. "" or why it is not possible.
    std::string rewind();

  private:
    std::string send();
    bool backToPosition();
    const Descriptor& out() const { return output_.isOpen() ? output_ : input_; }

    std::string name_;
    Mode mode_;
    Descriptor input_, output_;
    bool isDevice_ = false;
    bool written_ = false; ///< since the last flush, or ever
    std::string pending_;  ///< written, not handed over yet
    std::string buffer_;   ///< read; the first `next_` bytes are consumed
    std::size_t next_ = 0;
};

} // namespace rt::lib
