#include "runtime/net/network_options.h"

#include "runtime/net/address.h"

#include <fmt/format.h>

namespace rt::net {

std::string takeListen(NetworkOptions& options, const std::string& text) {
    uint32_t ip = kAnyAddress;
    if (text != "any" && !parseIp(text, ip))
        return fmt::format("'{}' is not an address such as 192.168.0.10; --listen alone takes the one that "
                           "the program names",
                           text);
    options.listen = ip;
    return {};
}

std::string takeConnect(NetworkOptions& options, const std::string& text) {
    if (text == "any") {
        options.connectAnywhere = true;
        return {};
    }
    const std::size_t equals = text.find('=');
    uint32_t named = 0, other = 0;
    const std::string first = text.substr(0, equals);
    const std::string second = equals == std::string::npos ? first : text.substr(equals + 1);
    if (!parseIp(first, named) || !parseIp(second, other))
        return fmt::format(
            "'{}' is neither 'any' nor an address such as 192.168.0.10 nor a pair "
            "192.168.0.10=127.0.0.1 of the one that the program names and the one to use instead",
            text);
    options.connect[named] = other;
    return {};
}

} // namespace rt::net
