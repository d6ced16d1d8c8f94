#pragma once
// IoUnits: /rw/iosystem/networks and /rw/iosystem/devices.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

#include <string>

namespace rapidc::rws {

class IoUnits {
  public:
    explicit IoUnits(service::VirtualController& controller) : controller_(controller) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    void subscribe(Subscribables& subscribables);
    /// "" when there is none of the name in the path.
    std::string findNetwork(const Request& request) const;
    rt::IoDevices& devices() const { return controller_.core().io().devices(); }
    Reply networks(const Request& request) const;
    Reply network(const Request& request) const;
    Reply setNetwork(const Request& request);
    Reply listDevices(const Request& request) const;
    Reply device(const Request& request) const;
    Reply searchNetworks(const Request& request) const;
    Reply networkConfiguration(const Request& request) const;
    Reply deviceConfiguration(const Request& request) const;
    Reply setDevice(const Request& request);
    Reply search(const Request& request) const;
    /// The name of the device that "dev" or "net/dev" means; "" when there is none.
    std::string find(const Request& request) const;
    void describeNetwork(const std::string& name, Entry& entry) const;
    void describeDevice(const std::string& name, Entry& entry) const;

    service::VirtualController& controller_;
};

} // namespace rapidc::rws
