#pragma once
// IoDevices: the I/O devices and networks of the configuration (manual 1.9) and their states. They are simulated: each one works
// until a program deactivates it or the stimulus disturbs it.

#include "runtime/io/cfg_parser.h"
#include "runtime/sched/wait_queue.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// Names are compared without regard to case.
class IoDevices {
  public:
    /// `apply` is called whenever the signals of a device become reachable or unreachable.
    explicit IoDevices(std::function<void(std::string_view device, bool isReachable)> apply)
        : apply_(std::move(apply)) {}

    /// Takes the devices, networks and trust levels of a file of domain EIO.
    void configure(const CfgFile& file);
    /// A device that only a signal names.
    void addDevice(std::string_view name);

    /// Names as they are written, sorted without regard to case.
    std::vector<std::string> deviceNames() const;
    /// Those of the configuration and of devices.
    std::vector<std::string> networkNames() const;
    /// The network of a device; "Local" when the configuration does not say.
    std::string networkOf(std::string_view device) const;

    bool isDevice(std::string_view name) const { return find(name) != nullptr; }
    /// Of the configuration, or one that every controller has.
    bool isNetwork(std::string_view name) const;
    /// Its trust level (DenyDeactivate; 0 in RobotWare 5) does not allow that a program deactivates it.
    bool mustStayActive(std::string_view device) const;
    /// Activated, as at the start, and not deactivated since.
    bool isActive(std::string_view device) const;
    /// The device answers and its network works.
    bool hasContact(std::string_view device) const;
    bool isNetworkOfInError(std::string_view device) const;
    bool isNetworkInError(std::string_view network) const;
    /// Losses of contact are not reported (IODeviceMute).
    bool isMuted(std::string_view device) const;

    void setActive(std::string_view device, bool active);
    void setContact(std::string_view device, bool contact);
    void setNetworkError(std::string_view network, bool error);
    void setMuted(std::string_view device, bool muted);
    /// A restart: every device is active and reports its losses.
    void restart();

    /// Notified after each change of a state.
    WaitQueue& changed() { return changed_; }

  private:
    struct Device {
        std::string name, network, trustLevel;
        bool isActive = true, isLost = false, isMuted = false;
        bool wasReachable = true;
    };
    const Device* find(std::string_view name) const;
    Device& deviceFor(std::string_view name);
    bool answers(const Device& device) const;
    void applyStates();

    std::function<void(std::string_view, bool)> apply_;
    std::map<std::string, Device> devices_;           // by name in upper case
    std::map<std::string, bool> networks_;            // upper case -> in error
    std::map<std::string, std::string> networkNames_; // upper case -> as written
    std::map<std::string, bool> denyDeactivation_;    // by trust level in upper case
    WaitQueue changed_;
};

} // namespace rt
