#include "tools/protocol/framing.h"

#include "config/letter_case.h"
#include "config/text_util.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace protocol {

using rapid::config::sameName;
using rapid::config::trimmed;

namespace {

bool readNumber(std::string_view text, std::size_t& number) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && end == text.data() + text.size() && !text.empty();
}

} // namespace

FrameReader::Result FrameReader::broken(std::string problem) {
    problem_ = std::move(problem);
    return Result::Broken;
}

/// Takes the length out of a header; returns what is wrong with it.
std::string FrameReader::lengthIn(std::string_view header) {
    bool known = false;
    while (!header.empty()) {
        const std::size_t stop = std::min(header.find('\n'), header.size());
        const std::string_view line = trimmed(header.substr(0, stop));
        header.remove_prefix(std::min(stop + 1, header.size()));
        if (line.empty()) continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) return "a header line has no colon";
        if (!sameName(trimmed(line.substr(0, colon)), "Content-Length")) continue;
        if (known || !readNumber(trimmed(line.substr(colon + 1)), length_))
            return "Content-Length is not one number";
        known = true;
    }
    return known ? "" : "the header of a message has no Content-Length";
}

FrameReader::Result FrameReader::readHeader() {
    for (;;) {
        const std::string_view rest = std::string_view(buffer_).substr(begin_);
        std::size_t size = 4;
        std::size_t end = rest.find("\r\n\r\n");
        if (const std::size_t plain = rest.find("\n\n");
            plain < end) { // some clients leave out the carriage returns
            end = plain;
            size = 2;
        }
        if (end == std::string_view::npos)
            return rest.size() > kLongestHeader ? broken("the header of a message is too long")
                                                : Result::More;
        std::string problem = lengthIn(rest.substr(0, end));
        if (!problem.empty() && stray_ == Stray::Refused) return broken(std::move(problem));
        begin_ += end + size;
        if (!problem.empty()) continue;
        if (length_ > kLongestMessage) return broken("a message is too long");
        inBody_ = true;
        return Result::Message;
    }
}

FrameReader::Result FrameReader::next(std::string& message) {
    if (!problem_.empty()) return Result::Broken;
    if (!inBody_)
        if (const Result result = readHeader(); result != Result::Message) return result;
    if (buffer_.size() - begin_ < length_) return Result::More;
    message = buffer_.substr(begin_, length_);
    begin_ += length_;
    inBody_ = false;
    if (begin_ == buffer_.size() || begin_ > (1u << 20)) {
        buffer_.erase(0, begin_);
        begin_ = 0;
    }
    return Result::Message;
}

std::string frame(std::string_view message) {
    std::string text = "Content-Length: " + std::to_string(message.size()) + "\r\n\r\n";
    text += message;
    return text;
}

bool Channel::read(std::string& message, std::string& problem) {
    for (;;) {
        const FrameReader::Result result = reader_.next(message);
        if (result == FrameReader::Result::Message) return true;
        if (result == FrameReader::Result::Broken) {
            problem = reader_.problem();
            return false;
        }
        char bytes[1u << 16];
        const ssize_t got = ::read(input_, bytes, sizeof bytes);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            if (got < 0)
                problem = std::strerror(errno);
            else if (reader_.isInside())
                problem = "the input ends inside a message";
            return false;
        }
        reader_.add({bytes, static_cast<std::size_t>(got)});
    }
}

bool Channel::write(std::string_view message) {
    const std::string text = frame(message);
    const std::lock_guard<std::mutex> lock(writing_);
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t wrote = ::write(output_, text.data() + done, text.size() - done);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) return false;
        done += static_cast<std::size_t>(wrote);
    }
    return true;
}

} // namespace protocol
