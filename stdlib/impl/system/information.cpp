// Manual 1.14, 1.17: what a program can ask about the system it runs on. Everything is the same on each run.

#include "runtime/host/cfg_types.h"
#include "runtime/host/controller.h"
#include "runtime/net/address.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "natives/support.h"
#include "natives/time.h"
#include "stdlib_constants.h"

#include <cmath>
#include <iterator>

using namespace rt;

namespace {

constexpr const char* kVersion = "7.20.0"; // of the RobotWare whose language this is

// The part of RobotWare's options that this controller simulates.
constexpr const char* kOptions[] = {"Multitasking", "World Zones", "Fixed Position Events", "Path Recovery",
                                    "Independent Axis"};
constexpr const char* kProducts[] = {"RobotControl"};

/// The address at which servers of the program are reached.
std::string lanAddress(const Controller& controller) {
    const auto& listen = controller.options().network.listen;
    if (!listen) return net::ipText(net::kLoopback);
    return net::ipText(*listen == net::kAnyAddress ? net::kServicePort : *listen);
}

/// The entry after position `listNumber`; false after the last one, and the search is at its beginning again.
template <std::size_t Count> bool nextOf(const char* const (&list)[Count], float& listNumber, String& name) {
    if (!(listNumber >= 0 && listNumber < static_cast<float>(Count))) {
        listNumber = 0;
        return false;
    }
    name.assign(list[static_cast<std::size_t>(listNumber)]);
    listNumber = std::trunc(listNumber) + 1;
    return true;
}

} // namespace

extern "C" {

/// CtrlId is empty on a virtual controller; the address is the one that its sockets use.
Status rt_GetSysInfo(TaskCore* task, String* result, bool SerialNo, bool SWVersion, bool SWVersionName,
                     bool RobotType, bool CtrlId, bool LanIp, bool CtrlLang, bool SystemName) {
    if (SerialNo)
        result->assign(kSerialNumber);
    else if (SWVersion)
        result->assign(kVersion);
    else if (SWVersionName)
        result->assign(std::string("RobotWare ") + kVersion);
    else if (RobotType)
        result->assign(taskOf(task).controller().motion(taskOf(task)).model().name);
    else if (CtrlId)
        result->assign("");
    else if (LanIp)
        result->assign(lanAddress(taskOf(task).controller()));
    else if (CtrlLang)
        result->assign("en");
    else if (SystemName)
        result->assign("rapidc");
    else
        return lib::fail(task, err::ERR_ARGVALERR, "say which information is wanted, such as \\SerialNo");
    return kOk;
}

Status rt_IsSysID(TaskCore*, bool* result, const String* SystemId) {
    *result = SystemId->view() == kSerialNumber;
    return kOk;
}

Status rt_GetNextOption(TaskCore*, bool* result, float* ListNumber, String* Name) {
    *result = nextOf(kOptions, *ListNumber, *Name);
    return kOk;
}

Status rt_GetNextProduct(TaskCore*, bool* result, float* ListNumber, String* Name) {
    *result = nextOf(kProducts, *ListNumber, *Name);
    return kOk;
}

/// The memory of the host is not counted: a large number that stays the same.
Status rt_ProgMemFree(TaskCore*, float* result) {
    *result = 64.0F * 1024 * 1024;
    return kOk;
}

Status rt_GetUASUserName(TaskCore*, String* result) {
    result->assign("Default User");
    return kOk;
}

/// Hours since the start, in virtual time: the motors have been on since.
Status rt_GetServiceInfo(TaskCore* task, String* result, Handle* MechUnit, bool) {
    Status status = kOk;
    if (lib::unitOf(task, *MechUnit, status) == nullptr) return status;
    result->assign(std::to_string(taskOf(task).now() / (3600 * kSecond)));
    return kOk;
}
}
