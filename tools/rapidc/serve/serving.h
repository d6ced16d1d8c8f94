#pragma once
// Serving: everything between the network and a controller: Robot Web Services in both dialects, and the web page.

#include "tools/http/server.h"
#include "tools/pendant/pendant_service.h"
#include "tools/rapidc/serve/serve_settings.h"
#include "tools/rws/front_door.h"
#include "tools/rws/plant_services.h"
#include "tools/rws/rapid_services.h"
#include "tools/rws/subscriptions.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

namespace rapidc::serve {

class Serving {
  public:
    /// The controller has been opened; it must outlive this.
    Serving(const ServeSettings& settings, service::VirtualController& controller);
    /// Closes all connections.
    ~Serving();
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

    /// Opens the ports. "" or what is wrong.
    std::string open();
    /// Whether an earlier process has left changed system parameters: VirtualController::reopen() takes them.
    bool hasKeptParameters() { return plant_.configuration().takeKept(); }
    /// Begins to answer. As soon as answers come without delay it writes the addresses to standard output: one line of JSON.
    void start();

  private:
    /// Announces when the controller has executed several commands in a row at once: a large routine that is compiled when the
    /// program starts would keep the first clients waiting for longer than they do.
    void announceWhenPrompt();
    void announce();
    std::string listen(const char* option, http::Endpoint endpoint, uint16_t& port);

    const ServeSettings& settings_;
    service::VirtualController& controller_;
    rws::Router router_;
    rws::Subscribables subscribables_;
    rws::RapidServices rapid_;
    rws::PlantServices plant_;
    rws::Subscriptions subscriptions_;
    std::unique_ptr<rws::FrontDoor> door_;
    pendant::PendantService pendant_;
    service::Observers::Token observer_ = 0;
    std::chrono::steady_clock::time_point started_;
    bool isAnnounced_ = false;        ///< on the thread of the server
    std::atomic<int> prompt_ = 0;     ///< commands in a row that were executed at once
    std::atomic<bool> asked_ = false; ///< a command is on its way
    http::Server server_;             ///< last: it ends first
    uint16_t httpPort_ = 0, httpsPort_ = 0, webPort_ = 0;
};

} // namespace rapidc::serve
