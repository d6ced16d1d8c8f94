#include "tools/rapidc/serve/serve_settings.h"

#include "config/read_file.h"
#include "runtime/base/text_util.h"
#include "runtime/host/command_line.h"
#include "runtime/net/address.h"
#include "tools/program/pipeline.h"
#include "tools/program/run_setup.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace rapidc::serve {

namespace fs = std::filesystem;

namespace {

void addPort(const rt::Command& command, const char* name, uint16_t& port, const char* of) {
    const auto take = [&port](const std::string& text) -> std::string {
        double number = 0;
        if (!rt::parseNumber(text, number) || number != static_cast<uint16_t>(number))
            return fmt::format("'{}' is not a port: a whole number from 0 (any free one) to 65535", text);
        port = static_cast<uint16_t>(number);
        return {};
    };
    command.addChecked(name, take, fmt::format("Port of {}; default: any free one", of)).typeName("PORT");
}

void addRobotWare(const rt::Command& command, int& version) {
    const auto take = [&version](const std::string& text) -> std::string {
        if (text != "6" && text != "7" && text != "8")
            return fmt::format("'{}' is not a RobotWare version: 6, 7 or 8", text);
        version = text.front() - '0';
        return {};
    };
    command
        .addChecked("--robotware", take,
                    "The RobotWare version that clients of RWS 2.0 read: 6, 7 or 8; default 7")
        .typeName("N");
}

/// "" or why the file of the password cannot be used.
std::string readPassword(ServeSettings& settings) {
    if (settings.passwordFile.empty()) return {};
    std::string text;
    if (const std::string problem = rapid::config::readFile(settings.passwordFile, text); !problem.empty())
        return fmt::format("--password-file={}: {}", settings.passwordFile, problem);
    settings.password = text.substr(0, text.find_first_of("\r\n"));
    if (settings.password.empty())
        return fmt::format("--password-file={}: its first line is empty", settings.passwordFile);
    return {};
}

/// Folders of a volume that are searched before the controller starts.
constexpr std::size_t kMostFolders = 20'000;

} // namespace

void addServeOptions(const rt::Command& command, ServeSettings& settings) {
    service::Settings& controller = settings.controller;
    addInputArgument(command, controller.inputs);
    addPort(command, "--http-port", settings.httpPort, "Robot Web Services 1.0 (HTTP)");
    addPort(command, "--https-port", settings.httpsPort, "Robot Web Services 2.0 (HTTPS)");
    addPort(command, "--web-port", settings.webPort, "the web page");
    command
        .add("--password", settings.password,
             "Password of the users 'Default User' and 'Admin'; default: robotics, as on a new controller")
        .typeName("TEXT");
    command
        .add("--password-file", settings.passwordFile,
             "A file whose first line is the password, so that no list of processes shows it")
        .typeName("FILE");
    command.addFlag("--no-program-start", settings.noProgramStart,
                    "Begin with the motors off and the program stopped at main");
    command.addFlag("--motors-on", settings.motorsOn,
                    "With --no-program-start: begin with the motors on, ready for the first start");
    addRobotWare(command, controller.robotWare);
    command.add("--backup-dir", settings.backupFolder, "The folder of $BACKUP; default: a temporary one")
        .typeName("DIR");
    command.add("--temp", settings.tempFolder, "The folder of $TEMP; default: a temporary one")
        .typeName("DIR");
    command
        .add("--system-dir", settings.systemFolder,
             "The folder of $SYSTEM: changed system parameters stay in it; default: a temporary one")
        .typeName("DIR");
    command
        .add("--certificate-dir", settings.certificateFolder,
             "The folder that keeps the certificate of HTTPS; default: one of the user")
        .typeName("DIR");
    rt::addRunOptions(command, controller.options, true);
    addAssumeSignalsOption(command, controller.inputs);
    addWarningOption(command, controller.inputs);
}

std::string certificateFolderOf(const ServeSettings& settings, std::string& problem) {
    std::string folder = settings.certificateFolder;
    const char* state = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    if (folder.empty() && state != nullptr && state[0] == '/')
        folder = std::string(state) + "/rapidc/certificate";
    if (folder.empty() && home != nullptr && home[0] == '/')
        folder = std::string(home) + "/.local/state/rapidc/certificate";
    std::error_code code;
    if (!folder.empty()) fs::create_directories(folder, code);
    if (!code && !folder.empty() && ::access(folder.c_str(), W_OK) == 0) return folder;
    if (!settings.certificateFolder.empty())
        problem = fmt::format("--certificate-dir={}: the folder cannot be written", folder);
    return {};
}

std::string complete(ServeSettings& settings,
                     std::vector<std::unique_ptr<rapid::config::TemporaryFolder>>& folders) {
    service::Settings& controller = settings.controller;
    rt::RunOptions& options = controller.options;
    controller.programStart = !settings.noProgramStart;
    controller.motorsOn = settings.motorsOn;
    Inputs& inputs = controller.inputs;
    takeOptions(inputs, options);
    if (std::string problem = readPassword(settings); !problem.empty()) return problem;
    if (options.network.listen) {
        settings.address = rt::net::ipText(*options.network.listen); // 0.0.0.0: all interfaces
        if (!rt::net::isLoopback(*options.network.listen) && settings.password == kDefaultPassword)
            return fmt::format(
                "--listen={} lets other computers control the robot: choose a password with --password-file",
                settings.address);
    }
    if (settings.password.empty()) return "--password must not be empty";
    std::string error;
    findStimulus(options, inputs.paths);
    if (!readStimulus(options, error)) return error;
    // Uploads, copies and backups that a killed process left incomplete.
    for (const std::string& volume :
         {options.home, settings.backupFolder, settings.tempFolder, settings.systemFolder})
        if (!volume.empty()) rapid::config::removeLeftoversBelow(volume, kMostFolders);
    // Volumes outlive the controller, which a restart replaces.
    const auto use = [&](const char* volume, const std::string& given) -> std::string {
        std::string path = given;
        if (path.empty()) {
            folders.push_back(std::make_unique<rapid::config::TemporaryFolder>());
            if (const int problem = folders.back()->make(volume); problem != 0)
                return fmt::format("cannot make a folder for ${}: {}", volume, std::strerror(problem));
            path = folders.back()->path();
        }
        options.volumes.push_back(fmt::format("{}={}", volume, path));
        return {};
    };
    for (const auto& [volume, given] :
         {std::pair{"BACKUP", settings.backupFolder}, std::pair{"TEMP", settings.tempFolder},
          std::pair{"RAMDISK", std::string()}, std::pair{"SYSTEM", settings.systemFolder},
          std::pair{"DATA", std::string()}})
        if (error = use(volume, given); !error.empty()) return error;
    return {};
}

} // namespace rapidc::serve
