#pragma once
// ReferenceDevice: the connection with an external device, and the messages that are exchanged in their periods.

#include "stdlib/impl/reference_interface/reference_message.h"

#include "runtime/net/socket.h"
#include "runtime/sched/task.h"

#include "stdlib_types.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace rt::lib {

class ReferenceDevice {
  public:
    ReferenceDevice(Controller& controller, Task& owner, ReferenceDescription description,
                    data::Sensor* sensor, bool stopsProgram);
    ~ReferenceDevice() { end(); }
    ReferenceDevice(const ReferenceDevice&) = delete;
    ReferenceDevice& operator=(const ReferenceDevice&) = delete;

    const ReferenceDescription& description() const { return description_; }
    /// Waits until a device that is reached by TCP has taken the connection.
    Status connect(TaskCore* task);
    bool isConnected() const { return socket_ != nullptr; }
    /// A task waits in connect().
    bool isConnecting() const { return isConnecting_; }
    /// Each `period` from now on; 0: no longer. The data are persistents, they stay where they are.
    void send(const ReferenceProperty& property, void* data, const TypeDesc& type, Time period);
    void receive(const ReferenceProperty& property, void* data, const TypeDesc& type, Time period);
    void close();
    /// The controller ends; a task that waits in connect() ends by itself.
    void shutDown();

  private:
    struct Exchange {
        const ReferenceProperty* property = nullptr;
        void* data = nullptr;
        const TypeDesc* type = nullptr;
        Time period = 0, next = 0;
    };
    void end();
    void schedule();
    void tick();
    void sendNow();
    void receiveAll();
    void take(const std::string& text);
    void supervise();
    void refuse(const std::string& why);
    void lose(const std::string& why);
    void show(float state, float error);
    InternState state() const;

    Controller& controller_;
    Task& owner_;
    ReferenceDescription description_;
    data::Sensor* sensor_;
    bool stopsProgram_, isConnecting_ = false;
    std::unique_ptr<net::Socket> socket_; ///< while connected
    Exchange sent_, received_;
    EventToken tick_ = 0;
    std::string stream_;                  ///< of TCP: what has come and is not a whole message
    uint32_t id_ = 0;                     ///< of the last message
    std::map<uint32_t, Time> unanswered_; ///< messages by their number, and when they were sent
    bool refused_ = false;                ///< since the last message that could be used
};

/// The devices of a controller, by their names in upper case.
class ReferenceDevices {
  public:
    static ReferenceDevices& of(Controller& controller);
    /// Null when it is not connected.
    ReferenceDevice* find(std::string_view name) const;
    ReferenceDevice& add(std::unique_ptr<ReferenceDevice> device);
    void remove(std::string_view name);

  private:
    std::map<std::string, std::unique_ptr<ReferenceDevice>> devices_;
    bool isOpen_ = false;
};

} // namespace rt::lib
