#include "tools/rws/plant_services.h"

#include <filesystem>

namespace rapidc::rws {

namespace {

/// The folder of changed system parameters.
std::string parameterFolder(service::VirtualController& controller) {
    const std::string folder = controller.folderOf("SYSTEM") + "/SYSPAR";
    std::error_code ignored; // writing fails with a message
    std::filesystem::create_directories(folder, ignored);
    return folder;
}

} // namespace

PlantServices::PlantServices(service::VirtualController& controller, const Access& access)
    : journal_(controller), configuration_(controller, parameterFolder(controller)), manual_(controller),
      progress_(controller.observers()), signals_(controller), ioUnits_(controller),
      mechanicalUnits_(controller, manual_, access), kinematics_(manual_),
      configurationPages_(controller, configuration_, volumes_, progress_, access),
      eventLog_(journal_, volumes_, progress_), system_(controller, volumes_), platform_(controller),
      files_(volumes_), backups_(controller, configuration_, volumes_, progress_) {
    for (const char* volume : {"HOME", "BACKUP", "TEMP", "RAMDISK", "DATA", "SYSTEM"})
        if (const std::string folder = controller.folderOf(volume); !folder.empty())
            (void)volumes_.add(volume, folder);
}

void PlantServices::addTo(Router& router, Subscribables& subscribables) {
    signals_.addTo(router, subscribables);
    ioUnits_.addTo(router, subscribables);
    mechanicalUnits_.addTo(router, subscribables);
    kinematics_.addTo(router, subscribables);
    configurationPages_.addTo(router, subscribables);
    eventLog_.addTo(router, subscribables);
    system_.addTo(router, subscribables);
    platform_.addTo(router);
    files_.addTo(router, subscribables);
    backups_.addTo(router, subscribables);
    progress_.addTo(router, subscribables);
}

} // namespace rapidc::rws
