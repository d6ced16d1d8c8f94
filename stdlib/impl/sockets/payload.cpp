#include "stdlib/impl/sockets/payload.h"

#include "stdlib/impl/rawbytes/raw_bytes.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rt::lib {
namespace {

constexpr const char* kNoData = "one of the arguments \\Str, \\RawData and \\Data is needed";

} // namespace

Status Outgoing::get(TaskCore* task, std::array<char, net::kLargestMessage>& buffer,
                     std::string_view& view) const {
    std::size_t size = 0;
    if (text != nullptr) {
        view = text->view();
        size = view.size();
    } else if (raw != nullptr) {
        const auto valid = bytesOf(*raw);
        view = {reinterpret_cast<const char*>(valid.data()), valid.size()};
        size = view.size();
    } else if (bytes != nullptr) {
        size = static_cast<std::size_t>(count);
    } else {
        return fail(task, err::ERR_ARGVALERR, kNoData);
    }
    if (wanted != nullptr &&
        !(*wanted >= 0 && *wanted <= static_cast<float>(size) && std::trunc(*wanted) == *wanted))
        return fail(
            task, err::ERR_ARGVALERR,
            fmt::format(
                "\\NoOfBytes is {}, but must be a whole number from 0 to {}, the bytes that there are",
                *wanted, size));
    const std::size_t used = wanted != nullptr ? static_cast<std::size_t>(*wanted) : size;
    if (used > net::kLargestMessage)
        return fail(task, err::ERR_ARGVALERR,
                    fmt::format("{} bytes are too many for one instruction, which sends {} at most", used,
                                net::kLargestMessage));
    for (std::size_t i = 0; view.data() == nullptr && i < used; ++i) {
        if (!(bytes[i] >= 0 && bytes[i] <= 255 && std::trunc(bytes[i]) == bytes[i]))
            return fail(
                task, err::ERR_ARGVALERR,
                fmt::format("element {} of \\Data is {}, which is not a byte (0 to 255)", i + 1, bytes[i]));
        buffer[i] = static_cast<char>(static_cast<uint8_t>(bytes[i]));
    }
    view = view.data() == nullptr ? std::string_view(buffer.data(), used) : view.substr(0, used);
    return kOk;
}

Status Incoming::check(TaskCore* task) const {
    const bool isThere = text != nullptr || raw != nullptr || bytes != nullptr;
    return isThere ? kOk : fail(task, err::ERR_ARGVALERR, kNoData);
}

std::size_t Incoming::capacity() const {
    if (text != nullptr) return kStringCapacity;
    if (raw != nullptr) return kRawBytesCapacity;
    return std::min(static_cast<std::size_t>(count), net::kLargestMessage);
}

bool Incoming::isWhole(float bytesWanted) const {
    return raw != nullptr && bytesWanted == static_cast<float>(capacity());
}

std::size_t Incoming::fitting(std::string_view view) const {
    const std::size_t most = capacity();
    if (view.size() <= most) return view.size();
    constexpr std::size_t kLongestCharacter = 4;
    for (std::size_t back = 1; text != nullptr && back < kLongestCharacter; ++back)
        if (characterSize(rest(view, most - back)) > back) return most - back;
    return most;
}

void Incoming::put(std::string_view view) const {
    if (text != nullptr)
        text->assign(view);
    else if (raw != nullptr)
        assign(*raw, {reinterpret_cast<const uint8_t*>(view.data()), view.size()});
    else
        std::transform(view.begin(), view.end(), bytes,
                       [](char c) { return static_cast<float>(static_cast<uint8_t>(c)); });
    if (received != nullptr) *received = static_cast<float>(view.size());
}

} // namespace rt::lib
