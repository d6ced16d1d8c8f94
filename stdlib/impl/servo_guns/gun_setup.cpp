#include "stdlib/impl/servo_guns/gun_setup.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace rt::lib {
namespace {

constexpr int kMostForces = 10;
constexpr double kUsualForce = 1000, kUsualTorque = 5; // N, Nm: of a gun without forces in MOC.cfg

/// Without regard to case and underscores: tip_force1 is TipForce1.
bool isAttribute(std::string name, std::string_view wanted) {
    std::erase(name, '_');
    return sameName(name, wanted);
}

double numberOf(const CfgInstance& instance, const std::string& name, double otherwise) {
    for (const CfgAttribute& attribute : instance.attributes)
        if (isAttribute(attribute.name, name)) (void)instance.number(attribute.name, otherwise);
    return otherwise;
}

/// All names that lead on from the unit.
std::set<std::string> namesFrom(const Controller& controller, const MechanicalUnit& unit) {
    std::set<std::string> names{upperCase(unit.name)};
    for (const MechanicalUnit::Axis& axis : unit.own)
        names.insert(upperCase(axis.single));
    for (const char* type : {"MECHANICAL_UNIT", "SINGLE", "JOINT", "PROCESS"})
        for (const CfgInstance* instance : controller.instances("MOC", type)) {
            if (!names.contains(upperCase(instance->text("name")))) continue;
            for (const CfgAttribute& attribute : instance->attributes)
                if (!attribute.text().empty()) names.insert(upperCase(attribute.text()));
        }
    return names;
}

GunSetup setupFrom(const CfgInstance& process) {
    GunSetup setup;
    for (int i = 1; i <= kMostForces; ++i) {
        const double force = numberOf(process, fmt::format("TipForce{}", i), 0);
        const double torque = std::abs(numberOf(process, fmt::format("SqueezeTorque{}", i), 0));
        if (force > 0 && torque > 0) setup.forces.emplace_back(force, torque);
    }
    if (setup.forces.empty()) setup.forces.emplace_back(kUsualForce, kUsualTorque);
    std::sort(setup.forces.begin(), setup.forces.end());
    setup.readyDelay = std::max(numberOf(process, "ForceReadyDelay", 0), 0.0);
    return setup;
}

/// `x` on the line through the points, which begins at 0 when there is one only.
template <class X, class Y>
double onLine(const std::vector<std::pair<double, double>>& points, double x, X xOf, Y yOf) {
    std::pair<double, double> from{0, 0}, to = points.front();
    for (std::size_t i = 1; i < points.size() && xOf(to) < x; ++i) {
        from = to;
        to = points[i];
    }
    const double width = xOf(to) - xOf(from);
    return width > 0 ? yOf(from) + (yOf(to) - yOf(from)) * (x - xOf(from)) / width : yOf(to);
}

double first(const std::pair<double, double>& p) {
    return p.first;
}
double second(const std::pair<double, double>& p) {
    return p.second;
}

} // namespace

double GunSetup::forceOf(double torque) const {
    return onLine(forces, torque, second, first);
}

double GunSetup::torqueOf(double force) const {
    return onLine(forces, force, first, second);
}

std::optional<GunSetup> gunSetup(const Controller& controller, const MechanicalUnit& unit) {
    if (unit.isRobot || unit.own.size() != 1) return std::nullopt;
    const std::set<std::string> names = namesFrom(controller, unit);
    for (const CfgInstance* process : controller.instances("MOC", "SG_PROCESS"))
        if (names.contains(upperCase(process->text("name")))) return setupFrom(*process);
    return std::nullopt;
}

} // namespace rt::lib
