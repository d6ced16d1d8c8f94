#include "tools/rws/roots.h"

#include "tools/rws/rapid_support.h"

namespace rapidc::rws {

void addRoots(Router& router) {
    router.getBoth("/", [](const Request&) {
        return folder({{"rw-li", "/rw"},
                       {"ctrl-li", "/ctrl"},
                       {"users-li", "/users"},
                       {"uas-li", "/uas"},
                       {"fileservice-li", "/fileservice"},
                       {"subscription-li", "/subscription"}});
    });
    router.getBoth("/rw", [](const Request&) {
        return folder({{"system-li", "/rw/system"},
                       {"panel-li", "/rw/panel"},
                       {"rapid-li", "/rw/rapid"},
                       {"iosystem-li", "/rw/iosystem"},
                       {"motionsystem-li", "/rw/motionsystem"},
                       {"cfg-li", "/rw/cfg"},
                       {"elog-li", "/rw/elog"},
                       {"mastership-li", "/rw/mastership"},
                       {"dipc-li", "/rw/dipc"}});
    });
}

} // namespace rapidc::rws
