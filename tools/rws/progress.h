#pragma once
// Progress: /progress, work that continues after its request was answered. On the controller's thread only.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/observers.h"

#include <map>
#include <string>

namespace rapidc::rws {

class Progress {
  public:
    /// The observers must outlive it.
    explicit Progress(service::Observers& observers) : observers_(observers) {}
    /// The path of a new resource, for the header Location; it is pending until done() is called with it.
    std::string begin(const std::string& operation);
    /// `code`: ReturnCode::Success or why the work failed.
    void done(const std::string& path, ReturnCode code);
    void addTo(Router& router, Subscribables& subscribables);

  private:
    static constexpr std::size_t kKept = 100;
    struct Work {
        std::string operation;
        bool isReady = false;
        ReturnCode code = ReturnCode::Success;
    };
    static void describe(const Work& work, Entry& entry);

    service::Observers& observers_;
    std::map<uint64_t, Work> works_;
    uint64_t last_ = 0;
};

} // namespace rapidc::rws
