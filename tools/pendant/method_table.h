#pragma once
// MethodTable: the methods of the protocol by name, and what each area of them is to the hub.

#include "tools/pendant/protocol.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rapidc::service {
class VirtualController;
class BreakpointList;
class EventJournal;
class ManualMotion;
class ConfigurationStore;
class FileVolumes;
} // namespace rapidc::service

namespace rapidc::pendant {

class Client;
class Hub;

/// Answers a request of a client, on the controller's thread; short. Throws RequestError.
using Method = std::function<Json(Client& client, const Json& params)>;
/// The second half of a method that waits for the disk: on a worker thread, away from the controller.
using DiskWork = std::function<Json()>;
/// The first half, on the controller's thread.
using DiskMethod = std::function<DiskWork(Client& client, const Json& params)>;

class MethodTable {
  public:
    struct Entry {
        Method method;
        DiskMethod diskMethod; ///< one of the two
    };
    void add(const char* name, Method method) { methods_[name] = {std::move(method), {}}; }
    void addOnDisk(const char* name, DiskMethod method) { methods_[name] = {{}, std::move(method)}; }
    /// Null when there is none.
    const Entry* find(const std::string& name) const {
        const auto found = methods_.find(name);
        return found == methods_.end() ? nullptr : &found->second;
    }

  private:
    std::map<std::string, Entry> methods_;
};

/// The parts of a controller that pages show and change; all of them outlive the pages.
struct Shared {
    service::VirtualController& controller; ///< opened
    service::EventJournal& journal;
    service::BreakpointList& breakpoints;
    service::ManualMotion& manual;
    const service::ConfigurationStore& configuration;
    const service::FileVolumes& volumes;
};

/// The parts that methods work with.
struct Context : Shared {
    Hub& hub;
};

/// Methods and notifications of one subject. All calls on the controller's thread.
class Area {
  public:
    virtual ~Area() = default;
    virtual void addTo(MethodTable& methods) = 0;
    /// Its part of the answer to `state`.
    virtual void describe(Json& /*state*/) {}
    /// Sends what has changed since the last call; soon after Hub::wake(), at most 30 times a second.
    virtual void flush() {}
    /// The client has gone.
    virtual void forget(const Client& /*client*/) {}
};

} // namespace rapidc::pendant
