// Manual 1.7, 2.9: instructions for world zones. Where the manual is silent: the sides of a volume must not be 0; WZDisable
// and WZFree leave an output as it is; numbers of zones are never used twice.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/world_zones.h"
#include "stdlib/impl/support/fail.h"

#include "natives/world_zones.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace rt;
using lib::WorldZone;
using lib::ZoneShape;

namespace {

lib::WorldZones& zonesOf(TaskCore* task) {
    return lib::zonesOf(taskOf(task).controller(), lib::motionOf(task));
}

Status zoneMisused(TaskCore* task, std::string why) {
    return taskOf(task).fatal(static_cast<int>(EventId::WorldZoneMisused), std::move(why));
}

/// A zone is inside or outside of its shape; then the shape gets its handle.
Status define(TaskCore* task, bool inside, bool outside, ZoneShape shape, Handle& result) {
    if (inside == outside)
        return lib::fail(task, err::ERR_ARGVALERR, "a world zone needs one of \\Inside and \\Outside");
    shape.outside = outside;
    result = taskOf(task).controller().service<lib::ZoneShapes>().intern(shape);
    return kOk;
}

Status notAVolume(TaskCore* task, const char* why) {
    return lib::fail(task, err::ERR_ARGVALERR, why);
}

std::array<double, 3> toArray(const data::Pos& p) {
    return {p.x, p.y, p.z};
}

lib::ZoneAxes toAxes(const data::Jointtarget& target) {
    const data::Robjoint& r = target.robax;
    const double arm[] = {r.rax_1, r.rax_2, r.rax_3, r.rax_4, r.rax_5, r.rax_6};
    const motion::ExternalAxes external = lib::toAxes(target.extax);
    lib::ZoneAxes axes{};
    std::copy(std::begin(arm), std::end(arm), axes.begin());
    std::copy(external.begin(), external.end(), axes.begin() + std::size(arm));
    return axes;
}

/// The low values below the high ones, for all axes that are used.
Status defineJoints(TaskCore* task, bool inside, bool outside, const lib::ZoneAxes& low,
                    const lib::ZoneAxes& high, Handle& result) {
    ZoneShape shape;
    shape.kind = ZoneShape::Kind::Joints;
    shape.lowAxes = low;
    shape.highAxes = high;
    for (std::size_t i = 0; i < low.size(); ++i) {
        if (!motion::isConnected(low[i]) || !motion::isConnected(high[i])) continue;
        if (!(low[i] < high[i]))
            return lib::failWith(
                task, err::ERR_ARGVALERR,
                "axis {}: the limits of a world zone must leave a range (9E9 for an axis that "
                "is not looked at)",
                static_cast<double>(i + 1));
    }
    return define(task, inside, outside, shape, result);
}

/// The zone of either kind, checked for what both have in common; `number` is in the variable of the program.
Status prepare(TaskCore* task, const char* instruction, bool temp, bool stat, float* number, Handle shape,
               WorldZone& zone) {
    if (temp == stat)
        return lib::fail(task, err::ERR_ARGVALERR,
                         std::string(instruction) + " needs one of \\Temp and \\Stat");
    if (number == nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         std::string(instruction) +
                             ": \\Temp needs data of type wztemporary, \\Stat of type wzstationary");
    const ZoneShape* volume = taskOf(task).controller().service<lib::ZoneShapes>().find(shape);
    if (volume == nullptr)
        return zoneMisused(task,
                           std::string(instruction) + ": the shape has not been defined (WZBoxDef ...).");
    if (stat && taskOf(task).events().running() != SystemEvent::PowerOn)
        return zoneMisused(task, std::string(instruction) +
                                     " \\Stat is allowed only in a routine of the event POWER ON (SYS.cfg, "
                                     "CAB_EXEC_HOOKS).");
    if (zonesOf(task).find(static_cast<int>(*number)) != nullptr)
        return zoneMisused(task,
                           std::string(instruction) +
                               ": the variable names a world zone that exists already. Use another one, or "
                               "erase the zone with WZFree first.");
    zone.shape = *volume;
    zone.stationary = stat;
    return kOk;
}

Status add(TaskCore* task, const WorldZone& zone, float& number) {
    const int made = zonesOf(task).add(zone);
    if (made == 0)
        return zoneMisused(task, "There are 20 world zones already, the maximum. Erase one with WZFree.");
    number = static_cast<float>(made);
    return kOk;
}

/// The temporary zone of a variable; null and the error in `status` when there is none.
WorldZone* zoneOf(TaskCore* task, const char* instruction, const data::Wztemporary& variable,
                  Status& status) {
    WorldZone* zone = zonesOf(task).find(static_cast<int>(variable.wz));
    if (zone == nullptr || zone->stationary) {
        status = zoneMisused(task, std::string(instruction) +
                                       ": the variable names no temporary world zone. Define it "
                                       "with WZLimSup \\Temp or WZDOSet \\Temp first.");
        return nullptr;
    }
    return zone;
}

float* numberIn(bool stat, data::Wztemporary* temporary, data::Wzstationary* stationary) {
    if (stat) return stationary != nullptr ? &stationary->wz : nullptr;
    return temporary != nullptr ? &temporary->wz : nullptr;
}

} // namespace

extern "C" {

Status rt_WZBoxDef(TaskCore* task, bool Inside, bool Outside, Handle* Shape, const data::Pos* LowPoint,
                   const data::Pos* HighPoint) {
    ZoneShape shape;
    shape.kind = ZoneShape::Kind::Box;
    const std::array<double, 3> a = toArray(*LowPoint);
    const std::array<double, 3> b = toArray(*HighPoint);
    for (std::size_t i = 0; i < a.size(); ++i) {
        shape.low[i] = std::min(a[i], b[i]);
        shape.high[i] = std::max(a[i], b[i]);
        if (!(shape.low[i] < shape.high[i]))
            return notAVolume(task, "WZBoxDef: the corners must differ in x, y and z");
    }
    return define(task, Inside, Outside, shape, *Shape);
}

/// A negative height: the centre is that of the upper end.
Status rt_WZCylDef(TaskCore* task, bool Inside, bool Outside, Handle* Shape, const data::Pos* CentrePoint,
                   float Radius, float Height) {
    if (!(Radius > 0) || Height == 0 || !std::isfinite(Height))
        return notAVolume(task, "WZCylDef: the radius must be above 0, the height other than 0");
    ZoneShape shape;
    shape.kind = ZoneShape::Kind::Cylinder;
    shape.low = toArray(*CentrePoint);
    shape.low[2] += std::min(0.0, static_cast<double>(Height));
    shape.radius = Radius;
    shape.height = std::abs(static_cast<double>(Height));
    return define(task, Inside, Outside, shape, *Shape);
}

Status rt_WZSphDef(TaskCore* task, bool Inside, bool Outside, Handle* Shape, const data::Pos* CentrePoint,
                   float Radius) {
    if (!(Radius > 0)) return notAVolume(task, "WZSphDef: the radius must be above 0");
    ZoneShape shape;
    shape.kind = ZoneShape::Kind::Sphere;
    shape.low = toArray(*CentrePoint);
    shape.radius = Radius;
    return define(task, Inside, Outside, shape, *Shape);
}

Status rt_WZHomeJointDef(TaskCore* task, bool Inside, bool Outside, Handle* Shape,
                         const data::Jointtarget* MiddleJointVal, const data::Jointtarget* DeltaJointVal) {
    lib::ZoneAxes low = toAxes(*MiddleJointVal);
    lib::ZoneAxes high = low;
    const lib::ZoneAxes delta = toAxes(*DeltaJointVal);
    for (std::size_t i = 0; i < low.size(); ++i) {
        if (!motion::isConnected(low[i])) continue;
        low[i] = motion::isConnected(delta[i]) ? low[i] - delta[i] : delta[i];
        high[i] += delta[i];
    }
    return defineJoints(task, Inside, Outside, low, high, *Shape);
}

Status rt_WZLimJointDef(TaskCore* task, bool Inside, bool Outside, Handle* Shape,
                        const data::Jointtarget* LowJointVal, const data::Jointtarget* HighJointVal) {
    return defineJoints(task, Inside, Outside, toAxes(*LowJointVal), toAxes(*HighJointVal), *Shape);
}

Status rt_WZLimSup(TaskCore* task, bool Temp, bool Stat, data::Wztemporary* WorldZoneData,
                   data::Wzstationary* StatZone, Handle* Shape) {
    WorldZone zone;
    float* const number = numberIn(Stat, WorldZoneData, StatZone);
    if (const Status status = prepare(task, "WZLimSup", Temp, Stat, number, *Shape, zone)) return status;
    zone.action = WorldZone::Action::Stop;
    return add(task, zone, *number);
}

/// The access level of the signal does not matter: what a program may not write is what such a signal should be.
Status rt_WZDOSet(TaskCore* task, bool Temp, bool Stat, data::Wztemporary* WorldZoneData,
                  data::Wzstationary* StatZone, bool Inside, bool Before, Handle* Shape, Handle* Signal,
                  float SetValue) {
    if (Inside == Before)
        return lib::fail(task, err::ERR_ARGVALERR, "WZDOSet needs one of \\Inside and \\Before");
    if (SetValue != 0 && SetValue != 1)
        return lib::fail(task, err::ERR_ARGVALERR, "WZDOSet: the value must be 0 or 1");
    Status status = kOk;
    (void)lib::signalOf(task, *Signal, status);
    if (status != kOk) return status;
    WorldZone zone;
    float* const number = numberIn(Stat, WorldZoneData, StatZone);
    status = prepare(task, "WZDOSet", Temp, Stat, number, *Shape, zone);
    if (status != kOk) return status;
    zone.action = Inside ? WorldZone::Action::OutputInside : WorldZone::Action::OutputBefore;
    zone.output = *Signal;
    zone.value = SetValue != 0;
    return add(task, zone, *number);
}

Status rt_WZDisable(TaskCore* task, data::Wztemporary* WorldZoneData) {
    Status status = kOk;
    WorldZone* zone = zoneOf(task, "WZDisable", *WorldZoneData, status);
    if (zone != nullptr) zonesOf(task).disable(*zone);
    return status;
}

/// A zone that is enabled already stays so.
Status rt_WZEnable(TaskCore* task, data::Wztemporary* WorldZoneData) {
    Status status = kOk;
    WorldZone* zone = zoneOf(task, "WZEnable", *WorldZoneData, status);
    if (zone != nullptr && !zone->enabled) zonesOf(task).enable(*zone);
    return status;
}

Status rt_WZFree(TaskCore* task, data::Wztemporary* WorldZoneData) {
    Status status = kOk;
    const WorldZone* zone = zoneOf(task, "WZFree", *WorldZoneData, status);
    if (zone == nullptr) return status;
    zonesOf(task).erase(zone->number);
    WorldZoneData->wz = 0;
    return kOk;
}
}
