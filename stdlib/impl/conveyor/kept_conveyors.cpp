// Conveyors between two processes (--state): the belt continues where it was, with its objects and the connection.

#include "config/json_text.h"
#include "stdlib/impl/conveyor/tracking.h"

#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"

#include "stdlib_constants.h"

#include <cmath>
#include <stdexcept>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

constexpr double kFurthest = 1e9; // mm or degrees, per s
constexpr std::size_t kMostObjects = 10'000;

double lengthFrom(const Json& json) {
    const auto length = numberFrom<double>(json);
    if (!(std::fabs(length) <= kFurthest)) throw std::invalid_argument("no belt is that long");
    return length;
}

Json jsonOf(const std::optional<double>& place) {
    return place ? Json(*place) : Json();
}

std::optional<double> placeFrom(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(lengthFrom(json));
}

/// Number of the motion group that follows the connected object; -1: none does.
int followerOf(Controller& controller, const Conveyor& conveyor) {
    const auto object = conveyor.connected();
    for (std::size_t i = 0; object != nullptr && i < controller.motions().size(); ++i)
        if (isFollowed(*controller.motions()[i], *object)) return static_cast<int>(i);
    return -1;
}

Json save(Controller& controller, const Conveyor& conveyor) {
    const Conveyor::Kept kept = conveyor.kept();
    return {{"active", kept.isActive},
            {"belt", {kept.position, kept.speed, kept.target}},
            {"queue", kept.queue},
            {"connected", jsonOf(kept.connected)},
            {"lastSync", jsonOf(kept.lastSync)},
            {"nextObject", jsonOf(kept.nextObject)},
            {"follower", followerOf(controller, conveyor)}};
}

/// As in conveyor tracking after a power failure: the robot is at rest, and the object has moved without it.
void loseFollowed(Controller& controller, const Conveyor& conveyor, MotionDriver& motion) {
    const std::string reason = "the object on " + conveyor.name() +
                               " that it followed was lost while the controller was not running";
    controller.log().write(EventId::ConveyorTrackingStopped, nullptr, {motion.unitName(), reason});
    motion.raiseProcessError(err::ERR_CNV_DROPPED, reason);
}

void load(Controller& controller, Conveyor& conveyor, const Json& json) {
    Conveyor::Kept kept;
    json.at("active").get_to(kept.isActive);
    const Json& belt = json.at("belt");
    kept.position = lengthFrom(belt.at(0));
    kept.speed = lengthFrom(belt.at(1));
    kept.target = lengthFrom(belt.at(2));
    if (json.at("queue").size() > kMostObjects) throw std::invalid_argument("too many objects");
    for (const Json& object : json.at("queue")) {
        const double origin = lengthFrom(object);
        if (!kept.queue.empty() && origin < kept.queue.back())
            throw std::invalid_argument("the objects are not in order");
        kept.queue.push_back(origin);
    }
    kept.connected = placeFrom(json.at("connected"));
    kept.lastSync = placeFrom(json.at("lastSync"));
    kept.nextObject = placeFrom(json.at("nextObject"));
    const int follower = numberFrom<int>(json.at("follower"));
    const bool isFollowed = follower >= 0 && follower < static_cast<int>(controller.motions().size());
    if (isFollowed) kept.connected.reset();
    conveyor.restore(kept);
    if (MechanicalUnit* unit = controller.units().find(conveyor.name())) unit->isActive = kept.isActive;
    if (!isFollowed) return;
    MotionDriver& motion = *controller.motions()[static_cast<std::size_t>(follower)];
    // Once the paths have been restored and the program is about to continue.
    controller.scheduler().after(0, [&] { loseFollowed(controller, conveyor, motion); });
}

} // namespace

void keepConveyors(Controller& controller, StateKeepers& kept) {
    kept.keepers["conveyors"] = {[&controller] {
                                     Json all = Json::object();
                                     for (const auto& conveyor : controller.service<Conveyors>().all())
                                         all[conveyor->name()] = save(controller, *conveyor);
                                     return all;
                                 },
                                 [&controller](const Json& all) {
                                     for (const auto& conveyor : controller.service<Conveyors>().all())
                                         if (const auto found = all.find(conveyor->name());
                                             found != all.end())
                                             load(controller, *conveyor, *found);
                                 }};
}

} // namespace rt::lib
