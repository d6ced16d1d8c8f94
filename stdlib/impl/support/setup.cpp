#include "stdlib/impl/arc/arc_process.h"
#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/dispense/dispense_process.h"
#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/flow/booked_numbers.h"
#include "stdlib/impl/guided_motion/egm_process.h"
#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/io/cyclic_bools.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/motion/collisions.h"
#include "stdlib/impl/motion/soft_servo.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/triggers.h"
#include "stdlib/impl/motion/world_zones.h"
#include "stdlib/impl/queues/message_queue.h"
#include "stdlib/impl/servo_guns/servo_gun.h"
#include "stdlib/impl/sockets/sockets.h"
#include "stdlib/impl/spot/spot_gun.h"
#include "stdlib/impl/time/clocks.h"
#include "stdlib/impl/vision/cameras.h"
#include "stdlib/native_table.h"
#include "stdlib/standard_library.h"

#include "runtime/debug/state_keepers.h"

namespace rt {

void setUpStandardLibrary(Controller& controller) {
    for (const ErrorEntry& entry : errorTable())
        controller.log().addErrorName(entry.number, entry.name, entry.summary);
    lib::superviseCollisions(controller);
    controller.onProgramReset(lib::resetSettings);
    controller.onProgramReset(lib::endWeld);
    controller.onProgramReset(lib::openGuns);
    controller.onProgramReset(lib::endBead);
    controller.onProgramReset([](Task& task) { task.controller().service<lib::ServoGuns>().reset(); });
    controller.onProgramReset(lib::endGuidance);
    controller.onProgramReset([](Task& task) { lib::closeSockets(task, "its program begins again"); });
    controller.onConnectionsLost(lib::closeSockets);
    lib::openCameras(controller);
    auto& kept = controller.service<StateKeepers>();
    kept.orderAgain = lib::orderAgain;
    lib::keepSettings(controller, kept);
    lib::keepBookedNumbers(controller, kept);
    lib::keepCameras(controller, kept);
    lib::keepClocks(controller, kept);
    lib::keepConveyors(controller, kept);
    lib::keepFiles(controller, kept);
    lib::keepSignalVariables(controller, kept);
    lib::keepCyclicBools(controller, kept);
    lib::keepMessages(controller, kept);
    lib::keepServoGuns(controller, kept);
    lib::keepSpotGuns(controller, kept);
    lib::keepTriggers(controller, kept);
    lib::keepWorldZones(controller, kept);
    lib::keepSoftServo(controller, kept);
}

} // namespace rt
