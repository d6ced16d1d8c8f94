#pragma once
// PendantService: the web page of a controller and its WebSocket, for the HTTP server.
//
//     pendant::PendantService pendant({controller, journal, manual, configuration, volumes},
//                                     {.password = password, .address = address});
//     uint16_t port = 0;
//     server.listen({.address = address, .port = wanted, .service = &pendant}, port);
//     pendant.setPort(port);
//     server.every(pendant::PendantService::kTick, [&pendant] { pendant.tick(); });
//     server.start();
//
// The controller has been opened. The server stops before this object ends, and run() of the controller has returned then.

#include "tools/http/server.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/page_files.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace rapidc::pendant {

struct PendantSettings {
    PageFiles files = builtPage();
    std::string password;              ///< of pages on other computers
    std::string address = "127.0.0.1"; ///< of the network interface
};

class PendantService final : public http::Service {
  public:
    static constexpr std::chrono::milliseconds kTick{33};

    PendantService(const Shared& shared, PendantSettings settings);
    ~PendantService() override;

    /// Before the server starts: the port that was taken.
    void setPort(uint16_t port) { port_ = port; }
    /// Each kTick, from the network thread.
    void tick();

    // ---- http::Service
    http::Decision decide(const http::Head& head) override;
    void handle(http::Request request, http::Respond respond) override;
    http::Response refusal(int status, const std::string& reason) override;

  private:
    class Socket;

    bool isOwnHost(const http::Head& head) const;
    http::Decision decideSocket(const http::Head& head);
    std::string checkPassword(const Client& client, const std::string& password);

    service::VirtualController& controller_;
    const PendantSettings settings_;
    Hub hub_;
    uint16_t port_ = 0;
    const std::shared_ptr<std::atomic<int>> sockets_ = std::make_shared<std::atomic<int>>(0);
    /// After a wrong password the computer that sent it waits. On the controller's thread.
    std::map<std::string, std::chrono::steady_clock::time_point> locked_;
};

} // namespace rapidc::pendant
