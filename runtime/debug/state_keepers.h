#pragma once
// StateKeepers: parts of the controller outside runtime/host that keep something between two processes (--state), such as the
// motion settings of the standard library. A service of the controller.

#include "runtime/abi/rt_abi.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <map>
#include <string>

namespace rt {

class Task;
struct InterruptOrder;

struct StateKeepers {
    struct Keeper {
        std::function<nlohmann::json()> save;
        std::function<void(const nlohmann::json&)> load; ///< may throw what the JSON library throws
    };
    std::map<std::string, Keeper> keepers; ///< by name; loaded only when the program continues
    /// Objects that variables name by handles (clocks ...), as texts. Handles of types without an entry are made again.
    struct HandleKeeper {
        std::function<std::string(Handle)> textOf; ///< "": the variable names no object
        std::function<Handle(const std::string&)>
            make; ///< 0: the text describes none; may throw what the JSON library throws
    };
    std::map<std::string, HandleKeeper> handles; ///< by the name of the type
    /// Orders an interrupt of an earlier process again. False: it cannot be done.
    std::function<bool(Task&, int number, bool single, bool safe, const InterruptOrder&)> orderAgain;
};

} // namespace rt
