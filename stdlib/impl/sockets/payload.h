#pragma once
// The data that socket instructions send and receive: one of \Str, \RawData and \Data.

#include "stdlib_types.h"

#include "runtime/abi/rt_abi.h"
#include "runtime/net/socket.h"

#include <array>
#include <string_view>

namespace rt::lib {

/// Arguments of an instruction that sends; null: not given.
struct Outgoing {
    const String* text;
    const data::Rawbytes* raw;
    const float* bytes;
    int32_t count; ///< of the array `bytes`
    const float* wanted;

    /// `view` lies in the arguments or in `buffer`. ERR_ARGVALERR is raised when they make no sense.
    Status get(TaskCore* task, std::array<char, net::kLargestMessage>& buffer, std::string_view& view) const;
};

/// Arguments of an instruction that receives; null: not given.
struct Incoming {
    String* text;
    data::Rawbytes* raw;
    float* bytes;
    int32_t count; ///< of the array `bytes`
    float* received;

    /// Bytes that the variable takes.
    std::size_t capacity() const;
    /// Whether so many bytes are all that a container of bytes takes. A program that asks for them takes what has come:
    /// published drivers ask for 1024 bytes, and their clients send messages that are shorter.
    bool isWhole(float bytesWanted) const;
    /// How many of these bytes go into the variable: characters that do not fit in full stay for the next instruction.
    std::size_t fitting(std::string_view view) const;
    /// At most the capacity.
    void put(std::string_view view) const;
    /// Raises ERR_ARGVALERR when there is no variable.
    Status check(TaskCore* task) const;
};

} // namespace rt::lib
