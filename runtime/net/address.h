#pragma once
// Address: an IPv4 address with a port, as programs name it and as the computer uses it.

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace rt::net {

struct Address {
    uint32_t ip = 0; ///< the first of the four numbers is the most significant byte
    uint16_t port = 0;

    auto operator<=>(const Address&) const = default;
};

inline constexpr uint32_t kAnyAddress = 0;           ///< 0.0.0.0
inline constexpr uint32_t kLoopback = 0x7F000001;    ///< 127.0.0.1
inline constexpr uint32_t kServicePort = 0xC0A87D01; ///< 192.168.125.1, the service port of every controller

/// "192.168.125.1" as a number; false when it is not four numbers from 0 to 255.
bool parseIp(std::string_view text, uint32_t& ip);
std::string ipText(uint32_t ip);
/// "127.0.0.1:5000"
std::string addressText(const Address& address);
/// 127.0.0.0 to 127.255.255.255.
inline bool isLoopback(uint32_t ip) {
    return ip >> 24 == 127;
}

} // namespace rt::net
