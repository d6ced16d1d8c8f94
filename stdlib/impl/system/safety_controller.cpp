// The safety controller: the simulated one has no configuration and no version, so its texts are empty; and brakes are never
// checked.

#include "natives/additional.h"

using namespace rt;

extern "C" {

/// There is nothing to synchronize with.
Status rt_SafetyControllerSyncRequest(TaskCore*) {
    return kOk;
}

Status rt_SafetyControllerGetChecksum(TaskCore*, String* result) {
    result->assign("");
    return kOk;
}

Status rt_SafetyControllerGetUserChecksum(TaskCore*, String* result) {
    result->assign("");
    return kOk;
}

Status rt_SafetyControllerGetSWVersion(TaskCore*, String* result) {
    result->assign("");
    return kOk;
}

Status rt_SafetyControllerGetOpModePinCode(TaskCore*, String* result) {
    result->assign("");
    return kOk;
}

Status rt_IsBrakeCheckActive(TaskCore*, bool* result) {
    *result = false;
    return kOk;
}
}
