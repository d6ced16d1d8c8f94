// Manual 1.17: what the controller says of itself.

#include "runtime/host/controller.h"
#include "runtime/net/address.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

/// The address at which servers of the program are reached.
std::string lanAddress(const Controller& controller) {
    const auto& listen = controller.options().network.listen;
    if (!listen) return net::ipText(net::kLoopback);
    return net::ipText(*listen == net::kAnyAddress ? net::kServicePort : *listen);
}

} // namespace

extern "C" {

Status rt_GetSysInfo(TaskCore* task, String* result, bool SerialNo, bool SWVersion, bool SWVersionName,
                     bool RobotType, bool CtrlId, bool LanIp, bool CtrlLang, bool SystemName) {
    Controller& controller = taskOf(task).controller();
    if (SerialNo)
        result->assign("00-00000");
    else if (SWVersion)
        result->assign("7.20");
    else if (SWVersionName)
        result->assign("RobotWare 7.20");
    else if (RobotType)
        result->assign(controller.motions().front()->model().name);
    else if (CtrlId || SystemName)
        result->assign("rapidc");
    else if (LanIp)
        result->assign(lanAddress(controller));
    else if (CtrlLang)
        result->assign("en");
    else
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the function needs an argument that says what is wanted, such as \\LanIp");
    return kOk;
}
}
