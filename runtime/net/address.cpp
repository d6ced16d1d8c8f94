#include "runtime/net/address.h"

#include <fmt/format.h>

#include <arpa/inet.h>

namespace rt::net {

bool parseIp(std::string_view text, uint32_t& ip) {
    in_addr parsed{};
    if (text.find('\0') != std::string_view::npos ||
        inet_pton(AF_INET, std::string(text).c_str(), &parsed) != 1)
        return false;
    ip = ntohl(parsed.s_addr);
    return true;
}

std::string ipText(uint32_t ip) {
    return fmt::format("{}.{}.{}.{}", ip >> 24, ip >> 16 & 0xFF, ip >> 8 & 0xFF, ip & 0xFF);
}

std::string addressText(const Address& address) {
    return fmt::format("{}:{}", ipText(address.ip), address.port);
}

} // namespace rt::net
