#include "tools/rws/backups.h"

#include "frontend/project/backup.h"
#include "frontend/source/source_file.h"
#include "tools/rws/file_service.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/service/panel_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace rapidc::rws {

namespace fs = std::filesystem;

Backups::~Backups() {
    controller_.panelOrders().setBackup({});
    if (writer_.joinable()) writer_.join();
}

Reply Backups::state(const Request&, const char* type) const {
    const char* text = state_ == State::Init         ? "Init State"
                       : state_ == State::InProgress ? "Backup in Progress"
                       : state_ == State::Ready      ? "Backup Ready"
                                                     : "Backup Error";
    Document document;
    document.add(type, "backup")
        .value("backup-state", text)
        .value("progress-state", state_ == State::InProgress ? "active" : "idle");
    return Reply::of(std::move(document));
}

std::optional<Reply> Backups::folderIn(const Request& request, bool exists, std::string& host) const {
    std::string path = pathInVolume(fieldOf(request, "backup"));
    while (path.ends_with('/'))
        path.pop_back();
    if (path.empty() || path.find('/') == std::string::npos)
        return badParameter("backup", "/fileservice/$BACKUP/name");
    if (!exists && !rapid::isValidUtf8(path)) return badParameter("backup", "a name in UTF-8");
    if (const service::FileResult found = volumes_.hostPath(path, host); !found.isDone())
        return refuseFile(found);
    std::error_code code;
    if (exists && !rapid::project::isBackup(host))
        return Reply::refuse(ReturnCode::NoPath, fmt::format("{} is not a backup", path));
    if (!exists && fs::exists(fs::symlink_status(host, code)))
        return Reply::refuse(ReturnCode::Rejected, fmt::format("{} exists already", path), 409);
    if (!exists && !fs::is_directory(fs::path(host).parent_path(), code))
        return Reply::refuse(ReturnCode::NoPath, fmt::format("the folder of {} does not exist", path));
    return std::nullopt;
}

void Backups::enter(State state) {
    state_ = state;
    controller_.noteBackup(state == State::InProgress, state == State::Failed);
}

/// The content is taken now; a thread of its own writes it, so that programs and clients do not wait for the disk.
Reply Backups::create(const Request& request) {
    if (state_ == State::InProgress) return Reply::refuse(ReturnCode::Rejected, "a backup is being written");
    std::string host;
    if (auto reply = folderIn(request, false, host)) return std::move(*reply);
    Reply reply = Reply::done(202);
    reply.location = progress_.begin("backup");
    write(host, reply.location);
    return reply;
}

/// `progress`: where clients see it; "" for none.
void Backups::write(const std::string& host, const std::string& progress) {
    if (writer_.joinable()) writer_.join(); // it has ended
    enter(State::InProgress);
    auto content =
        std::make_shared<const service::BackupContent>(service::takeBackup(controller_, configuration_));
    writer_ = std::thread(
        [this, alive = std::weak_ptr(alive_), &controller = controller_, content, host, progress] {
            const std::string problem = service::writeBackup(*content, host);
            controller.post([this, alive, problem, progress] {
                if (alive.expired()) return;
                enter(problem.empty() ? State::Ready : State::Failed);
                if (!progress.empty())
                    progress_.done(progress, problem.empty() ? ReturnCode::Success : ReturnCode::Rejected);
                if (!problem.empty()) fmt::print(stderr, "backup: {}\n", problem);
            });
        });
}

/// Of a system input, into "BACKUP:/name"; when that folder is there, into name_2, name_3 ... Returns why not, or "".
std::string Backups::order(const std::string& folder) {
    constexpr int kMost = 1000;
    if (state_ == State::InProgress) return "a backup is being written";
    const std::size_t colon = folder.find(':');
    if (colon == std::string::npos) return fmt::format("{} names no volume", folder);
    const std::string name =
        folder.substr(std::min(folder.find_first_not_of("/\\", colon + 1), folder.size()));
    if (name.empty()) return fmt::format("{} names no folder", folder);
    for (int number = 1; number <= kMost; ++number) {
        const std::string tried = number == 1 ? name : fmt::format("{}_{}", name, number);
        std::string host;
        std::error_code code;
        if (!volumes_
                 .hostPath(pathInVolume(fmt::format("/fileservice/${}/{}", folder.substr(0, colon), tried)),
                           host)
                 .isDone())
            return fmt::format("{} cannot be written", folder);
        if (fs::exists(fs::symlink_status(host, code))) continue;
        if (!fs::is_directory(fs::path(host).parent_path(), code))
            return fmt::format("the folder of {} does not exist", folder);
        write(host, "");
        return {};
    }
    return fmt::format("there are {} backups of that name", kMost);
}

Reply Backups::check(const Request& request) const {
    std::string host;
    if (auto reply = folderIn(request, true, host)) return std::move(*reply);
    Document document;
    document.add("ctrl-checkrestore", "check-restore").value("status", "ACCEPTED").value("path", "");
    return Reply::of(std::move(document));
}

Reply Backups::restore(const Request& request) {
    if (state_ == State::InProgress) return Reply::refuse(ReturnCode::Rejected, "a backup is being written");
    std::string host;
    if (auto reply = folderIn(request, true, host)) return std::move(*reply);
    return replyTo(controller_.restore(host));
}

void Backups::addTo(Router& router, Subscribables&) {
    controller_.panelOrders().setBackup([this](const std::string& folder) { return order(folder); });
    const std::string all = "/ctrl/backup";
    router.addBoth({Method::Get, all, "backupstate",
                    [this](const Request& r) { return state(r, "ctrl-backup-state"); }});
    router.getBoth(all, [this](const Request& r) { return state(r, "ctrl-backup-info"); });
    router.get(Dialect::V2, all + "/state",
               [this](const Request& r) { return state(r, "ctrl-backup-state"); });
    addOrder(router, all, "backup", "create", [this](const Request& r) { return create(r); });
    addOrder(router, all, "restore", "restore", [this](const Request& r) { return restore(r); });
    addOrder(router, all, "check-restore", "check-restore", [this](const Request& r) { return check(r); });
}

} // namespace rapidc::rws
