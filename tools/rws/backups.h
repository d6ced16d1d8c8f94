#pragma once
// Backups: /ctrl/backup, a backup into a volume, and back.

#include "tools/rws/progress.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/backup_writer.h"
#include "tools/service/file_volumes.h"

#include <atomic>
#include <memory>
#include <thread>

namespace rapidc::rws {

class Backups {
  public:
    /// All of them must outlive the routes.
    Backups(service::VirtualController& controller, const service::ConfigurationStore& configuration,
            const service::FileVolumes& volumes, Progress& progress)
        : controller_(controller), configuration_(configuration), volumes_(volumes), progress_(progress) {}
    /// Waits for a backup that is being written.
    ~Backups();
    Backups(const Backups&) = delete;
    Backups& operator=(const Backups&) = delete;
    void addTo(Router& router, Subscribables& subscribables);

  private:
    enum class State : uint8_t { Init, InProgress, Ready, Failed };
    void enter(State state);
    Reply state(const Request& request, const char* type) const;
    Reply create(const Request& request);
    std::string order(const std::string& folder);
    void write(const std::string& host, const std::string& progress);
    Reply check(const Request& request) const;
    Reply restore(const Request& request);
    /// The folder on the host that the field `backup` names; a reply when there is none.
    std::optional<Reply> folderIn(const Request& request, bool exists, std::string& host) const;

    service::VirtualController& controller_;
    const service::ConfigurationStore& configuration_;
    const service::FileVolumes& volumes_;
    Progress& progress_;
    State state_ = State::Init;
    std::shared_ptr<int> alive_ = std::make_shared<int>(0); ///< commands posted by the writer may come later
    std::thread writer_;
};

} // namespace rapidc::rws
