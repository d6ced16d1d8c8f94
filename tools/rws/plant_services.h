#pragma once
// PlantServices: all resources around the plant, in the order in which they need each other.

#include "tools/rws/access.h"
#include "tools/rws/event_log_pages.h"
#include "tools/rws/file_service.h"
#include "tools/rws/io_units.h"
#include "tools/rws/kinematics.h"
#include "tools/rws/mechanical_units.h"
#include "tools/rws/signals.h"
#include "tools/service/event_journal.h"
#include "tools/service/file_volumes.h"
#include "tools/service/manual_motion.h"

namespace rapidc::rws {

class PlantServices {
  public:
    /// The controller has been opened.
    PlantServices(service::VirtualController& controller, const Access& access);
    PlantServices(const PlantServices&) = delete;
    PlantServices& operator=(const PlantServices&) = delete;

    void addTo(Router& router, Subscribables& subscribables);

  private:
    service::EventJournal journal_;
    service::FileVolumes volumes_;
    service::ManualMotion manual_;
    EventLogPages events_;
    FileService files_;
    Signals signals_;
    IoUnits units_;
    Kinematics kinematics_;
    MechanicalUnits mechanicalUnits_;
};

} // namespace rapidc::rws
