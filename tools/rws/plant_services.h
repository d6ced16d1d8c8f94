#pragma once
// PlantServices: all resources around the plant: signals, motion, configuration, event log, files, the controller itself.

#include "tools/rws/access.h"
#include "tools/rws/backups.h"
#include "tools/rws/configuration.h"
#include "tools/rws/event_log_pages.h"
#include "tools/rws/file_service.h"
#include "tools/rws/io_units.h"
#include "tools/rws/kinematics.h"
#include "tools/rws/mechanical_units.h"
#include "tools/rws/platform.h"
#include "tools/rws/progress.h"
#include "tools/rws/signals.h"
#include "tools/rws/system.h"
#include "tools/service/configuration_store.h"
#include "tools/service/event_journal.h"
#include "tools/service/file_volumes.h"
#include "tools/service/manual_motion.h"

namespace rapidc::rws {

class PlantServices {
  public:
    /// The controller has been opened; both outlive the services and their routes. Made and destroyed on the controller's thread, or while
    /// it does not run.
    PlantServices(service::VirtualController& controller, const Access& access);
    PlantServices(const PlantServices&) = delete;
    PlantServices& operator=(const PlantServices&) = delete;

    void addTo(Router& router, Subscribables& subscribables);

    /// Of HTTPS, PEM; before the first request.
    void setCertificate(std::string pem) { platform_.setCertificate(std::move(pem)); }

    // Shared with the web page.
    service::ManualMotion& manualMotion() { return manual_; }
    service::EventJournal& journal() { return journal_; }
    service::ConfigurationStore& configuration() { return configuration_; }
    const service::FileVolumes& volumes() const { return volumes_; }

  private:
    service::FileVolumes volumes_;
    service::EventJournal journal_;
    service::ConfigurationStore configuration_;
    service::ManualMotion manual_;
    Progress progress_;
    Signals signals_;
    IoUnits ioUnits_;
    MechanicalUnits mechanicalUnits_;
    Kinematics kinematics_;
    Configuration configurationPages_;
    EventLogPages eventLog_;
    System system_;
    Platform platform_;
    FileService files_;
    Backups backups_;
};

} // namespace rapidc::rws
