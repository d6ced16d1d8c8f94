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
    std::string passwordFile;                           ///< its first line is the password; "" = none
    std::string backupFolder, tempFolder, systemFolder; ///< "" = temporary ones
    std::string certificateFolder;                      ///< "" = of the user, or none
    bool noProgramStart = false;
    bool motorsOn = false; ///< also with noProgramStart
};

/// Adds the options of `run` that a controller has, and those of its servers.
void addServeOptions(const rt::Command& command, ServeSettings& settings);

/// The folder that keeps the certificate: the one asked for, or a folder of the user that can be written; "" = none. `problem`: the one
/// asked for cannot be used.
std::string certificateFolderOf(const ServeSettings& settings, std::string& problem);

/// Checks the settings before the controller is made: volumes are folders, other computers need a password. "" or what is wrong.
/// `folders` keeps the temporary ones as long as the controller lives.
std::string complete(ServeSettings& settings,
                     std::vector<std::unique_ptr<rapid::config::TemporaryFolder>>& folders);

} // namespace rapidc::serve
