#pragma once
// rawbytes: a container of up to 1024 bytes that lies in the variable itself (manual 1.10). Bytes from `length` on are
// always 0.

#include "stdlib_types.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace rt::lib {

inline constexpr uint32_t kRawBytesCapacity = sizeof(data::Rawbytes::bytes);

/// The valid bytes.
inline std::span<const uint8_t> bytesOf(const data::Rawbytes& container) {
    return {container.bytes, std::min(container.length, kRawBytesCapacity)};
}

/// Makes `length` bytes valid, at most the capacity; those that are no longer valid become 0.
inline void setLength(data::Rawbytes& container, std::size_t length) {
    const auto fits = static_cast<uint32_t>(std::min<std::size_t>(length, kRawBytesCapacity));
    if (fits < container.length) std::memset(container.bytes + fits, 0, container.length - fits);
    container.length = fits;
}

/// Replaces the contents with the bytes given, at most the capacity.
inline void assign(data::Rawbytes& container, std::span<const uint8_t> bytes) {
    const std::size_t count = std::min<std::size_t>(bytes.size(), kRawBytesCapacity);
    if (count > 0) std::memmove(container.bytes, bytes.data(), count);
    if (count >= container.length)
        container.length = static_cast<uint32_t>(count);
    else
        setLength(container, count);
}

/// Puts bytes at an offset from 0; the container grows when they reach beyond its valid bytes. The caller has checked
/// that offset + count is at most the capacity.
inline void put(data::Rawbytes& container, std::size_t offset, const void* bytes, std::size_t count) {
    std::memmove(container.bytes + offset, bytes, count);
    container.length = std::max(container.length, static_cast<uint32_t>(offset + count));
}

} // namespace rt::lib
