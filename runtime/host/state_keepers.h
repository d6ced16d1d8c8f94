#pragma once
// StateKeepers: parts of the controller outside runtime/host that keep something between two processes (--state), such as the
// motion settings of the standard library. A service of the controller.

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
    std::map<std::string, Keeper> keepers; ///< by name; loaded only when the program goes on
    /// Orders an interrupt of an earlier process again. False: it cannot be done.
    std::function<bool(Task&, int number, bool single, bool safe, const InterruptOrder&)> orderAgain;
};

} // namespace rt
