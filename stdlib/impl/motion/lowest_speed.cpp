#include "stdlib/impl/motion/lowest_speed.h"

#include "runtime/host/controller.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/support/fail.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace rt::lib {

namespace {

using motion::kLowestSpeed;

constexpr double kNoWay = 0.1; // mm, deg

/// The lengths that a movement covers, straight from its beginning to its end.
struct Ways {
    double mm = 0, degrees = 0;      ///< of the TCP, of its orientation
    double linear = 0, rotating = 0; ///< mm, deg of external axes
};

Ways waysOf(MotionDriver& driver, const motion::MoveCommand& command) {
    const motion::JointTarget from = driver.system().plannedEnd();
    const motion::RobTarget start = driver.system().toRobTarget(from, command.frames);
    const bool isAbsolute = command.kind == motion::MoveKind::AbsJoint;
    const motion::RobTarget end =
        isAbsolute ? driver.system().toRobTarget(command.joints, command.frames) : command.target;
    Ways ways;
    ways.mm = norm(end.pose.pos - start.pose.pos);
    ways.degrees = robot::angleBetween(end.pose.rot, start.pose.rot);
    const auto& axes = driver.system().externalAxes();
    const motion::ExternalAxes& wanted = isAbsolute ? command.joints.extax : command.target.extax;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!axes[i].present || !motion::isConnected(wanted[i]) || !motion::isConnected(from.extax[i]))
            continue;
        double& way = axes[i].rotating ? ways.rotating : ways.linear;
        way = std::max(way, std::fabs(wanted[i] - from.extax[i]));
    }
    return ways;
}

} // namespace

void warnOfNoSpeed(TaskCore* task, const motion::MoveCommand& command) {
    const motion::SpeedData& speed = command.speed;
    const double least = std::min({speed.vTcp, speed.vOri, speed.vLeax, speed.vReax});
    const bool isTimed = command.duration > 0;
    if (isTimed || !(least >= 0 && least < kLowestSpeed)) return; // a negative speed is an error
    Task& owner = taskOf(task);
    MotionDriver& driver = owner.controller().motion(owner);
    const Ways ways = waysOf(driver, command);
    struct Row {
        const char* name;
        double speed, way;
        const char* unit;
    };
    const Row rows[] = {{"v_tcp", speed.vTcp, ways.mm, "mm/s"},
                        {"v_ori", speed.vOri, ways.degrees, "deg/s"},
                        {"v_leax", speed.vLeax, ways.linear, "mm/s"},
                        {"v_reax", speed.vReax, ways.rotating, "deg/s"}};
    for (const Row& row : rows) {
        if (row.speed >= kLowestSpeed || !(row.way > kNoWay)) continue;
        owner.report(EventId::NoSpeed,
                     {row.name, driver.unitName(), std::string("0.01 ") + row.unit,
                      formatDisplayNum(static_cast<float>(std::round(row.way / kLowestSpeed)))});
        return;
    }
}

} // namespace rt::lib
