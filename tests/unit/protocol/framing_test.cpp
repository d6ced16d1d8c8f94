#include "tools/protocol/framing.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using protocol::FrameReader;

namespace {

/// All messages of a stream that comes in pieces of that size.
std::vector<std::string> messagesOf(const std::string& bytes, std::size_t piece, FrameReader& reader) {
    std::vector<std::string> messages;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        reader.add(std::string_view(bytes).substr(at, piece));
        std::string message;
        while (reader.next(message) == FrameReader::Result::Message)
            messages.push_back(message);
    }
    return messages;
}

} // namespace

TEST_CASE("Frames come out whole, however the bytes arrive", "[protocol]") {
    const std::string bytes = protocol::frame("{\"a\":1}") + protocol::frame("") +
                              "content-LENGTH : 3\r\nContent-Type: x\r\n\r\nabc" + "Content-Length: 2\n\nde";
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
        FrameReader reader;
        CHECK(messagesOf(bytes, piece, reader) == std::vector<std::string>{"{\"a\":1}", "", "abc", "de"});
        CHECK_FALSE(reader.isInside());
    }
}

TEST_CASE("A broken header ends the stream with a reason", "[protocol]") {
    for (const char* bytes :
         {"Content-Length: x\r\n\r\n", "Content-Length: -1\r\n\r\n",
          "Content-Length: 1\r\nContent-Length: 1\r\n\r\na", "Other: 1\r\n\r\n", "no colon\r\n\r\n",
          "Content-Length: 99999999999999999999\r\n\r\n", "Content-Length: 999999999999\r\n\r\n"}) {
        FrameReader reader;
        std::string message;
        reader.add(bytes);
        CHECK(reader.next(message) == FrameReader::Result::Broken);
        CHECK_FALSE(reader.problem().empty());
        reader.add(protocol::frame("later"));
        CHECK(reader.next(message) == FrameReader::Result::Broken);
    }
    FrameReader reader;
    std::string message;
    reader.add(std::string(FrameReader::kLongestHeader + 1, 'a'));
    CHECK(reader.next(message) == FrameReader::Result::Broken);
}

TEST_CASE("Lines that are not a header can be skipped", "[protocol]") {
    const std::string bytes = "a stray line\r\n\r\n" + protocol::frame("one") + "Content-Length: x\n\n" +
                              "Other: 1\r\n\r\n" + protocol::frame("two");
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
        FrameReader reader(FrameReader::Stray::Skipped);
        CHECK(messagesOf(bytes, piece, reader) == std::vector<std::string>{"one", "two"});
    }
    FrameReader reader(FrameReader::Stray::Skipped);
    std::string message;
    reader.add("Content-Length: 999999999999\r\n\r\n");
    CHECK(reader.next(message) == FrameReader::Result::Broken);
}

TEST_CASE("The end of the input inside a message is known", "[protocol]") {
    FrameReader reader;
    std::string message;
    CHECK_FALSE(reader.isInside());
    reader.add("Content-Length: 5\r\n\r\nab");
    CHECK(reader.next(message) == FrameReader::Result::More);
    CHECK(reader.isInside());
}
