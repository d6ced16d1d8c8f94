#pragma once
// ServeSettings: the options of `rapidc serve`, and the folders that its volumes are.

#include "config/temporary.h"
#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rt {
class Command;
}

namespace rapidc::serve {

inline constexpr const char* kDefaultPassword = "robotics"; ///< of every user, as on a new controller

struct ServeSettings {
    service::Settings controller;
    uint16_t httpPort = 0, httpsPort = 0, webPort = 0; ///< 0: any free one
    std::string address = "127.0.0.1";                 ///< of the network interface
    std::string password = kDefaultPassword;
    std::string passwordFile;             ///< its first line is the password; "" = none
    std::string backupFolder, tempFolder; ///< "" = temporary ones
    bool noProgramStart = false;
};

/// Adds the options of `run` that a controller has, and those of its servers.
void addServeOptions(const rt::Command& command, ServeSettings& settings);

/// Checks the settings before the controller is made: volumes are folders, other computers need a password. "" or what is wrong.
/// `folders` keeps the temporary ones as long as the controller lives.
std::string complete(ServeSettings& settings,
                     std::vector<std::unique_ptr<rapid::config::TemporaryFolder>>& folders);

} // namespace rapidc::serve
