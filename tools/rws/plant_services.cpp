#include "tools/rws/plant_services.h"

namespace rapidc::rws {

PlantServices::PlantServices(service::VirtualController& controller, const Access& access)
    : journal_(controller), manual_(controller), events_(journal_), files_(volumes_), signals_(controller),
      units_(controller), kinematics_(manual_), mechanicalUnits_(controller, manual_, access) {
    for (const char* volume : {"HOME", "BACKUP", "TEMP", "RAMDISK", "SYSTEM"}) {
        if (const std::string folder = controller.folderOf(volume); !folder.empty())
            (void)volumes_.add(volume, folder);
    }
}

void PlantServices::addTo(Router& router, Subscribables& subscribables) {
    events_.addTo(router, subscribables);
    files_.addTo(router, subscribables);
    signals_.addTo(router, subscribables);
    units_.addTo(router, subscribables);
    kinematics_.addTo(router, subscribables);
    mechanicalUnits_.addTo(router, subscribables);
}

} // namespace rapidc::rws
