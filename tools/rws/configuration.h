#pragma once
// Configuration: /rw/cfg, the system parameters by domain, type and instance.

#include "tools/rws/access.h"
#include "tools/rws/progress.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/configuration_store.h"
#include "tools/service/file_volumes.h"

namespace rapidc::rws {

class Configuration {
  public:
    /// All of them must outlive the routes.
    Configuration(service::VirtualController& controller, service::ConfigurationStore& store,
                  const service::FileVolumes& volumes, Progress& progress, const Access& access)
        : controller_(controller), store_(store), volumes_(volumes), progress_(progress), access_(access) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    void subscribe(Subscribables& subscribables);
    using Instance = service::ConfigurationStore::Instance;
    Reply domains(const Request& request) const;
    Reply types(const Request& request) const;
    Reply type(const Request& request) const;
    Reply attributes(const Request& request) const;
    Reply instances(const Request& request) const;
    Reply instance(const Request& request) const;
    Reply set(const Request& request);
    Reply create(const Request& request);
    Reply remove(const Request& request);
    Reply validateInstances(const Request& request) const;
    Reply load(const Request& request, bool tryOnly);
    Reply save(const Request& request) const;
    /// `domain` as the store writes it; a failure when it, or a type of it, does not exist.
    std::optional<Failure> typeNamed(const std::string& written, const std::string& type,
                                     std::string& domain) const;
    std::optional<Failure> typeIn(const Request& request, std::string& domain) const;

    service::VirtualController& controller_;
    service::ConfigurationStore& store_;
    const service::FileVolumes& volumes_;
    Progress& progress_;
    const Access& access_;
};

} // namespace rapidc::rws
