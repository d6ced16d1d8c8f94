#pragma once
// Hub: all pages that are connected, and all methods. On the controller's thread, but for wake() and tick().

#include "tools/pendant/client.h"
#include "tools/pendant/method_table.h"
#include "tools/rws/workers.h"
#include "tools/service/virtual_controller.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::pendant {

class Hub {
  public:
    explicit Hub(const Shared& shared);
    ~Hub();
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;

    void add(std::shared_ptr<Client> client);
    void remove(const std::shared_ptr<Client>& client);
    /// Answers a request, a JSON object with an id, now or later, and calls endRequest() of the client.
    void handle(const std::shared_ptr<Client>& client, const std::shared_ptr<const Json>& request);
    /// "" when the password is right, else what to say. Asked for clients that need a login.
    void setPasswordCheck(std::function<std::string(const Client&, const std::string& password)> check) {
        checkPassword_ = std::move(check);
    }

    bool hasClients() const { return !clients_.empty(); }
    const std::vector<std::shared_ptr<Client>>& clients() const { return clients_; }
    /// To all clients that have said hello.
    void broadcast(const char* event, const Json& data);
    /// As broadcast, but not to those that read too slowly.
    void broadcastUnlessCongested(const char* event, const Json& data);
    static std::shared_ptr<const std::string> notification(const char* event, const Json& data);

    /// Executes what no request waits for: a mistake there is reported on stderr and must not end the controller.
    static void guarded(const std::function<void()>& action);

    /// From any thread: something is to be flushed.
    void wake() { isDirty_.store(true, std::memory_order_relaxed); }
    /// From any thread, each 33 ms: lets the areas send what has changed.
    void tick();

  private:
    Json hello(Client& client, const Json& params);
    Json state();
    const MethodTable::Entry& methodFor(const Client& client, const std::string& name) const;
    void flush();
    void endAll();

    service::VirtualController& controller_;
    std::vector<std::shared_ptr<Client>> clients_;
    std::vector<std::unique_ptr<Area>> areas_;
    MethodTable methods_;
    rws::Workers workers_; ///< after what they use
    std::function<std::string(const Client&, const std::string&)> checkPassword_;
    service::Observers::Token observer_ = 0;
    bool isRestarting_ = false; ///< the next generation comes from a restart
    std::atomic<bool> isDirty_{false};
};

} // namespace rapidc::pendant
