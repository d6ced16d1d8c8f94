#pragma once
// NetworkOptions: how far sockets of a program reach (options --offline, --listen, --connect).

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace rt::net {

struct NetworkOptions {
    bool offline = false;           ///< sockets connect the tasks of this controller and nothing else
    std::optional<uint32_t> listen; ///< none: loopback; 0: the address that the program names; else this one
    bool connectAnywhere = false;
    std::map<uint32_t, uint32_t> connect; ///< allowed addresses, and where they lead
};

/// Takes the value of --listen: "any" or an address. Returns what is wrong with it, or "".
std::string takeListen(NetworkOptions& options, const std::string& text);
/// Takes a value of --connect: "any", ADDRESS, or ADDRESS=OTHER. Returns what is wrong with it, or "".
std::string takeConnect(NetworkOptions& options, const std::string& text);

} // namespace rt::net
