#include "tools/service/system_facts.h"

#include "config/read_file.h"
#include "frontend/project/backinfo.h"
#include "frontend/project/backup.h"
#include "frontend/project/files.h"

#include <fmt/format.h>

#include <array>

namespace rapidc::service {

namespace {

namespace fs = std::filesystem;
namespace project = rapid::project;

// Options of RobotWare that this controller simulates, under the names that clients look for.
constexpr std::array<const char*, 8> kOptions = {
    "616-1 PC Interface",  "623-1 Multitasking",     "608-1 World Zones",
    "611-1 Path Recovery", "610-1 Independent Axis", "689-1 Externally Guided Motion (EGM)",
    "612-1 Path Offset",   "RobotWare Base"};

/// FNV-1a, twice: an identity that does not change from start to start.
std::string guidOf(const std::string& text) {
    uint64_t parts[2] = {14695981039346656037ULL, 1099511628211ULL * 31};
    for (uint64_t& hash : parts)
        for (const char c : text)
            hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return fmt::format("{{{:08X}-{:04X}-4{:03X}-A{:03X}-{:012X}}}", parts[0] >> 32, (parts[0] >> 16) & 0xFFFF,
                       parts[0] & 0xFFF, (parts[1] >> 48) & 0xFFF, parts[1] & 0xFFFFFFFFFFFF);
}

} // namespace

RobotWareVersion robotWareVersion(int robotWare) {
    if (robotWare == 6) return {6, 16, 2, 0, "6.16.02.00", "6.16.02.00"};
    if (robotWare == 8) return {8, 2, 1, 1023, "8.2.1", "8.2.1+1023"};
    return {7, 21, 0, 512, "7.21.0", "7.21.0+512"};
}

SystemFacts systemFacts(VirtualController& controller) {
    SystemFacts facts;
    facts.name = "rapidc";
    rt::Controller& core = controller.core();
    for (const std::string& path : controller.settings().inputs.paths) {
        std::string bytes;
        const fs::path info =
            project::isFolder(path) ? project::findPath(path, "BACKINFO/backinfo.txt") : fs::path();
        if (info.empty() || !rapid::config::readFile(info.string(), bytes).empty()) continue;
        const project::BackupInfo backup = project::readBackupInfo(bytes);
        if (!backup.systemId.empty()) facts.name = backup.systemId;
        facts.options = backup.options;
        facts.addIns = backup.addIns;
        break;
    }
    for (const rt::CfgInstance* option : core.instances("SYS", "PRESENT_OPTIONS"))
        if (option != nullptr) {
            const std::string text = option->text("desc", option->text("name"));
            if (!text.empty() &&
                std::find(facts.options.begin(), facts.options.end(), text) == facts.options.end())
                facts.options.push_back(text);
        }
    if (facts.options.empty()) facts.options.assign(kOptions.begin(), kOptions.end());
    facts.id = guidOf(facts.name);
    for (const auto& motion : core.motions())
        if (facts.robotType.empty() && !motion->unitName().empty()) facts.robotType = motion->model().name;
    if (facts.robotType.empty()) facts.robotType = "none";
    facts.startSeconds = core.calendarSeconds() - core.scheduler().now() / rt::kSecond;
    return facts;
}

} // namespace rapidc::service
