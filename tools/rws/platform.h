#pragma once
// Platform: what a controller has around robot, signals and program: safety controller, certificates, network, cameras, energy. A virtual
// one says what it has of it, and refuses the rest as virtual controllers do.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

#include <string>

namespace rapidc::rws {

class Platform {
  public:
    /// The controller outlives the routes.
    explicit Platform(service::VirtualController& controller) : controller_(controller) {}
    /// The certificate that clients of HTTPS see, PEM. Before the first request.
    void setCertificate(std::string pem) { certificate_ = std::move(pem); }
    void addTo(Router& router);

  private:
    void addSafety(Router& router);
    void addCertificates(Router& router);
    void addNetwork(Router& router);
    void addEquipment(Router& router);
    Reply certificates(const Request& request) const;
    Reply interfaces() const;
    Reply cameras() const;
    Reply energy(const Request& request) const;

    service::VirtualController& controller_;
    std::string certificate_;
    int64_t energyReset_ = 0; ///< s of the controller's clock; 0: never
    uint64_t energyChanges_ = 0;
};

} // namespace rapidc::rws
