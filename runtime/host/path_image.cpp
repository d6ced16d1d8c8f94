#include "runtime/host/path_image.h"

#include "config/json_text.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rt {
namespace {

using Json = nlohmann::json;

template <std::size_t N> std::array<double, N> numbersFrom(const Json& json) {
    const auto numbers = json.get<std::vector<double>>();
    if (numbers.size() != N) throw std::invalid_argument("a different number of values");
    std::array<double, N> result{};
    std::copy(numbers.begin(), numbers.end(), result.begin());
    return result;
}

motion::Joints jointsFrom(const Json& json) {
    const auto numbers = json.get<std::vector<double>>();
    if (numbers.size() > robot::kMostJoints) throw std::invalid_argument("more axes than an arm has");
    motion::Joints result = motion::Joints::zeros(numbers.size());
    std::copy(numbers.begin(), numbers.end(), result.begin());
    return result;
}

Json frameJson(const motion::FrameSetup& frames) {
    Json json = {{"toolHeld", frames.tool.robotHeld},
                 {"tool", jsonOf(frames.tool.tframe)},
                 {"objectHeld", frames.workObject.robotHeld},
                 {"user", jsonOf(frames.workObject.uframe)},
                 {"object", jsonOf(frames.workObject.oframe)},
                 {"displacement", jsonOf(frames.displacement)},
                 {"base", jsonOf(frames.baseFrame)}};
    if (frames.userMover != nullptr) json["unit"] = frames.userMover->name;
    if (frames.carrier != nullptr) json["carrierGroup"] = frames.carrierGroup;
    if (frames.carrierUnit != nullptr) json["carrierUnit"] = frames.carrierUnit->name;
    return json;
}

int wholeFrom(const Json& json, int most) {
    if (!json.is_number_integer()) throw std::invalid_argument("no whole number");
    const auto number = json.get<int64_t>();
    if (number < -most || number > most) throw std::invalid_argument("out of range");
    return static_cast<int>(number);
}

const robot::ExternalUnit* unitFrom(const Json& name, const robot::UnitLookup& units) {
    const robot::ExternalUnit* unit = units ? units(name.get<std::string>()) : nullptr;
    if (unit == nullptr) throw std::invalid_argument("no such mechanical unit");
    return unit;
}

motion::FrameSetup framesFrom(const Json& json, const robot::UnitLookup& units) {
    constexpr int kMostGroups = 1000;
    motion::FrameSetup frames;
    frames.tool = {json.at("toolHeld").get<bool>(), poseFrom(json.at("tool"))};
    frames.workObject = {json.at("objectHeld").get<bool>(), poseFrom(json.at("user")),
                         poseFrom(json.at("object"))};
    frames.displacement = poseFrom(json.at("displacement"));
    frames.baseFrame = poseFrom(json.at("base"));
    if (json.contains("unit")) frames.userMover = unitFrom(json.at("unit"), units);
    if (json.contains("carrierGroup")) frames.carrierGroup = wholeFrom(json.at("carrierGroup"), kMostGroups);
    if (json.contains("carrierUnit")) frames.carrierUnit = unitFrom(json.at("carrierUnit"), units);
    return frames;
}

} // namespace

Json jsonOf(const motion::Pose& pose) {
    return {pose.pos.x, pose.pos.y, pose.pos.z, pose.rot.w, pose.rot.x, pose.rot.y, pose.rot.z};
}

motion::Pose poseFrom(const Json& json) {
    const auto n = numbersFrom<7>(json);
    return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}};
}

Json jsonOf(const motion::MotionSettings& s) {
    return {s.velocityPercent,  s.maxTcpSpeed,      s.accelerationPercent, s.rampPercent,
            s.pathAcceleration, s.pathDeceleration, s.worldAcceleration,   s.finePointRampPercent};
}

motion::MotionSettings settingsFrom(const Json& json) {
    const auto n = numbersFrom<8>(json);
    return {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
}

Json jsonOf(const motion::MoveCommand& c) {
    const motion::ConfData& conf = c.target.conf;
    return {{"kind", static_cast<int>(c.kind)},
            {"joints", c.joints.robax},
            {"jointAxes", c.joints.extax},
            {"target", jsonOf(c.target.pose)},
            {"conf", {conf.cf1, conf.cf4, conf.cf6, conf.cfx}},
            {"targetAxes", c.target.extax},
            {"armAngle", std::isnan(c.target.armAngle) ? Json() : Json(c.target.armAngle)},
            {"circlePoint", jsonOf(c.circlePoint)},
            {"frames", frameJson(c.frames)},
            {"speed", {c.speed.vTcp, c.speed.vOri, c.speed.vLeax, c.speed.vReax}},
            {"duration", c.duration},
            {"fine", c.zone.finep},
            {"zone",
             {c.zone.pzoneTcp, c.zone.pzoneOri, c.zone.pzoneEax, c.zone.zoneOri, c.zone.zoneLeax,
              c.zone.zoneReax}},
            {"stop",
             {c.stop.positionPercent, c.stop.speedPercent, c.stop.minTime, c.stop.maxTime, c.stop.standTime}},
            {"stopAwaited", c.stop.isAwaited},
            {"load", {c.load.mass, c.load.inertia}},
            {"confJ", c.confJ},
            {"confL", c.confL},
            {"circleOrientation", static_cast<int>(c.circleOrientation)},
            {"singularity", static_cast<int>(c.singularity)},
            {"concurrent", c.concurrent},
            {"ident", c.ident},
            {"settings", jsonOf(c.settings)}};
}

motion::CircleOrientation circleOrientationFrom(int number) {
    constexpr int kLast = static_cast<int>(motion::CircleOrientation::Wrist56);
    if (number < 0 || number > kLast) throw std::invalid_argument("no way of turning on a circle");
    return static_cast<motion::CircleOrientation>(number);
}

motion::MoveCommand moveFrom(const Json& json, const robot::UnitLookup& units) {
    motion::MoveCommand c;
    constexpr int kLastKind = static_cast<int>(motion::MoveKind::Circular), kMostTurns = 1000;
    c.kind = static_cast<motion::MoveKind>(std::abs(wholeFrom(json.at("kind"), kLastKind)));
    c.joints = {jointsFrom(json.at("joints")), numbersFrom<6>(json.at("jointAxes"))};
    const Json& conf = json.at("conf");
    c.target = {poseFrom(json.at("target")),
                {wholeFrom(conf.at(0), kMostTurns), wholeFrom(conf.at(1), kMostTurns),
                 wholeFrom(conf.at(2), kMostTurns), wholeFrom(conf.at(3), kMostTurns)},
                numbersFrom<6>(json.at("targetAxes"))};
    if (json.contains("armAngle") && !json.at("armAngle").is_null())
        c.target.armAngle = json.at("armAngle").get<double>();
    c.circlePoint = poseFrom(json.at("circlePoint"));
    c.frames = framesFrom(json.at("frames"), units);
    const auto speed = numbersFrom<4>(json.at("speed"));
    c.speed = {speed[0], speed[1], speed[2], speed[3]};
    json.at("duration").get_to(c.duration);
    const auto zone = numbersFrom<6>(json.at("zone"));
    c.zone = {json.at("fine").get<bool>(), zone[0], zone[1], zone[2], zone[3], zone[4], zone[5]};
    const auto stop = numbersFrom<5>(json.at("stop"));
    c.stop = {stop[0], stop[1], stop[2], stop[3], stop[4], json.at("stopAwaited").get<bool>()};
    const auto load = numbersFrom<2>(json.at("load"));
    c.load = {load[0], load[1]};
    json.at("confJ").get_to(c.confJ);
    json.at("confL").get_to(c.confL);
    c.circleOrientation = circleOrientationFrom(json.at("circleOrientation").get<int>());
    constexpr int kLastMode = static_cast<int>(motion::SingularityMode::LockAxis4);
    c.singularity =
        static_cast<motion::SingularityMode>(std::abs(wholeFrom(json.at("singularity"), kLastMode)));
    json.at("concurrent").get_to(c.concurrent);
    if (json.contains("ident")) json.at("ident").get_to(c.ident);
    c.settings = settingsFrom(json.at("settings"));
    return c;
}

namespace {

Json movesJson(const std::vector<motion::MoveCommand>& moves) {
    Json json = Json::array();
    for (const motion::MoveCommand& move : moves)
        json.push_back(jsonOf(move));
    return json;
}

std::vector<motion::MoveCommand> movesFrom(const Json& json, const robot::UnitLookup& units) {
    std::vector<motion::MoveCommand> moves;
    for (const Json& move : json)
        moves.push_back(moveFrom(move, units));
    return moves;
}

Json placeJson(const MotionDriver::EarlierPlace& place) {
    Json json = {{"passed", place.isPassed},
                 {"from", place.from.robax},
                 {"fromAxes", place.from.extax},
                 {"covered", place.covered}};
    if (place.before) json["before"] = jsonOf(*place.before);
    return json;
}

MotionDriver::EarlierPlace placeFrom(const Json& json, const robot::UnitLookup& units) {
    MotionDriver::EarlierPlace place;
    json.at("passed").get_to(place.isPassed);
    place.from = {jointsFrom(json.at("from")), numbersFrom<6>(json.at("fromAxes"))};
    json.at("covered").get_to(place.covered);
    if (json.contains("before")) place.before = moveFrom(json.at("before"), units);
    return place;
}

StopFlags stopFlagsFrom(const Json& json) {
    return {json.at("stopMove").get<bool>(), json.value("otherStopMove", false)};
}

} // namespace

Json jsonOf(const MotionDriver::EarlierPath& path) {
    Json json = {{"path", movesJson(path.moves)},
                 {"stopMove", path.stopMove.byMotionTask},
                 {"otherStopMove", path.stopMove.byOtherTask},
                 {"levelHold", path.levelHold},
                 {"suspended", path.isSuspended}};
    if (path.awaited) json["awaited"] = jsonOf(*path.awaited);
    if (path.begun) json["begun"] = jsonOf(*path.begun);
    if (path.place) json["place"] = placeJson(*path.place);
    Json stored = Json::array();
    for (const MotionDriver::EarlierLevel& level : path.stored) {
        Json one = {{"path", movesJson(level.moves)},
                    {"stopMove", level.stopMove.byMotionTask},
                    {"otherStopMove", level.stopMove.byOtherTask},
                    {"suspended", level.isSuspended},
                    {"left", level.left.robax},
                    {"leftAxes", level.left.extax}};
        if (level.begun) one["begun"] = jsonOf(*level.begun);
        if (level.place) one["place"] = placeJson(*level.place);
        stored.push_back(std::move(one));
    }
    json["stored"] = std::move(stored);
    return json;
}

MotionDriver::EarlierPath earlierPathFrom(const Json& json, const robot::UnitLookup& units) {
    MotionDriver::EarlierPath path;
    path.moves = movesFrom(json.at("path"), units);
    path.stopMove = stopFlagsFrom(json);
    if (json.contains("awaited")) path.awaited = moveFrom(json.at("awaited"), units);
    if (json.contains("begun")) path.begun = poseFrom(json.at("begun"));
    if (!json.contains("stored")) return path; // written by an earlier version
    json.at("levelHold").get_to(path.levelHold);
    path.isSuspended = json.value("suspended", false);
    if (json.contains("place")) path.place = placeFrom(json.at("place"), units);
    for (const Json& one : json.at("stored")) {
        MotionDriver::EarlierLevel level;
        level.moves = movesFrom(one.at("path"), units);
        level.stopMove = stopFlagsFrom(one);
        level.isSuspended = one.value("suspended", false);
        level.left = {jointsFrom(one.at("left")), numbersFrom<6>(one.at("leftAxes"))};
        if (one.contains("begun")) level.begun = poseFrom(one.at("begun"));
        if (one.contains("place")) level.place = placeFrom(one.at("place"), units);
        path.stored.push_back(std::move(level));
    }
    return path;
}

Json jsonOf(const SavedInterrupt& i) {
    return {{"number", i.number},       {"single", i.single},        {"safe", i.safe},
            {"asleep", i.asleep},       {"ordered", i.ordered},      {"kind", i.order.kind},
            {"object", i.order.object}, {"numbers", i.order.numbers}};
}

SavedInterrupt interruptFrom(const Json& json) {
    constexpr int kMostNumbers = 1 << 23;
    SavedInterrupt i;
    i.number = wholeFrom(json.at("number"), kMostNumbers);
    json.at("single").get_to(i.single);
    json.at("safe").get_to(i.safe);
    json.at("asleep").get_to(i.asleep);
    json.at("ordered").get_to(i.ordered);
    json.at("kind").get_to(i.order.kind);
    json.at("object").get_to(i.order.object);
    json.at("numbers").get_to(i.order.numbers);
    return i;
}

} // namespace rt
