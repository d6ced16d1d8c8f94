#include "tools/service/manual_motion.h"

#include "config/text_util.h"
#include "runtime/host/unit_activation.h"
#include "tools/service/data_path.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace rapidc::service {

namespace {

using rapid::config::sameName;

/// The numbers of a RAPID aggregate in order; TRUE is 1, FALSE 0, strings are left out.
std::vector<double> numbersOf(std::string_view text) {
    std::vector<double> numbers;
    std::string word;
    bool inString = false;
    for (const char c : std::string(text) + ",") {
        if (c == '"') inString = !inString;
        if (inString || c == '"') continue;
        if (c != '[' && c != ']' && c != ',' && c != ' ') {
            word += c;
            continue;
        }
        double value = 0;
        if (sameName(word, "TRUE") || sameName(word, "FALSE"))
            numbers.push_back(sameName(word, "TRUE") ? 1 : 0);
        else if (rapid::config::parseNumber(word, value))
            numbers.push_back(value);
        word.clear();
    }
    return numbers;
}

/// Pose from seven numbers.
motion::Pose poseAt(const std::vector<double>& numbers, std::size_t i) {
    return {{numbers[i], numbers[i + 1], numbers[i + 2]},
            robot::normalized({numbers[i + 3], numbers[i + 4], numbers[i + 5], numbers[i + 6]})};
}

} // namespace

motion::JointTarget jointsFrom(const robot::Kinematics& kinematics, const std::vector<double>& arm,
                               const std::vector<double>& external) {
    motion::JointTarget joints;
    joints.robax = motion::Joints::zeros(kinematics.jointCount());
    for (std::size_t i = 0; i < external.size() && i < joints.extax.size(); ++i)
        joints.extax[i] = external[i];
    for (std::size_t i = 0; i < joints.robax.size(); ++i) {
        const auto number = static_cast<std::size_t>(kinematics.axisNumber(i));
        if (number <= arm.size())
            joints.robax[i] = arm[number - 1];
        else if (number == 7 && motion::isConnected(joints.extax[0]))
            joints.robax[i] = std::exchange(joints.extax[0], motion::kNotConnected);
    }
    return joints;
}

ManualMotion::ManualMotion(VirtualController& controller) : controller_(controller) {
    Observer observer;
    observer.changed = [this](Change change, const rt::Task*) {
        if (change == Change::OperatingMode || change == Change::MotorState) {
            const bool may = controller_.panel().mode != OperatingMode::Auto &&
                             controller_.panel().motors == MotorState::On;
            if (!may) stopJogging();
        }
    };
    token_ = controller_.observers().add(std::move(observer));
    controller_.onRelease([this] { jogging_.clear(); });
}

ManualMotion::~ManualMotion() {
    controller_.onRelease({});
    controller_.observers().remove(token_);
}

rt::MotionDriver& ManualMotion::motionOf(const rt::MechanicalUnit& unit) const {
    return *controller_.core().motions()[unit.group];
}

rt::Task* ManualMotion::taskOf(const rt::MechanicalUnit& unit) const {
    rt::Task* any = nullptr;
    for (const auto& task : controller_.core().tasks()) {
        if (task->motionGroup() == static_cast<int>(unit.group)) return task.get();
        if (any == nullptr) any = task.get();
    }
    return any;
}

const UnitChoice& ManualMotion::choice(const rt::MechanicalUnit& unit) const {
    static const UnitChoice usual;
    const auto found = choices_.find(unit.name);
    return found == choices_.end() ? usual : found->second;
}

Refusal ManualMotion::choose(const rt::MechanicalUnit& unit, UnitChoice choice) {
    motion::FrameSetup frames;
    if (Refusal refusal = framesOf(unit, choice.tool, choice.workObject, frames); !refusal.empty())
        return refusal;
    for (const std::string& load : {choice.payload, choice.totalPayload}) {
        if (sameName(load, "load0")) continue;
        const FoundData found = findData(controller_, {taskOf(unit)->name(), {}, {}, load, {}});
        if (found.data == nullptr || found.type == nullptr || !sameName(found.type->name, "loaddata"))
            return fmt::format("there is no loaddata {}", load);
    }
    choices_[unit.name] = std::move(choice);
    ++changeCount_;
    return {};
}

Refusal ManualMotion::framesOf(const rt::MechanicalUnit& unit, const std::string& tool,
                               const std::string& workObject, motion::FrameSetup& frames) const {
    const rt::Task* task = taskOf(unit);
    const auto read = [&](const std::string& name, const char* type, std::size_t count,
                          std::vector<double>& numbers) -> Refusal {
        if (task == nullptr) return "there is no task";
        const FoundData found = findData(controller_, {task->name(), {}, {}, name, {}});
        if (found.data == nullptr)
            return fmt::format("there is no {} {} in task {}", type, name, task->name());
        const auto text = valueOf(found);
        if (!sameName(found.type->name, type) || !found.dims.empty() || !text)
            return fmt::format("{} is no {}", name, type);
        numbers = numbersOf(*text);
        return numbers.size() < count ? fmt::format("{} has no usable value", name) : Refusal();
    };
    frames = {};
    std::vector<double> numbers;
    if (!sameName(tool, "tool0")) {
        if (Refusal refusal = read(tool, "tooldata", 8, numbers); !refusal.empty()) return refusal;
        frames.tool.robotHeld = numbers[0] != 0;
        frames.tool.tframe = poseAt(numbers, 1);
    }
    if (!sameName(workObject, "wobj0")) {
        if (Refusal refusal = read(workObject, "wobjdata", 16, numbers); !refusal.empty()) return refusal;
        frames.workObject.robotHeld = numbers[0] != 0;
        frames.workObject.uframe = poseAt(numbers, 2); // after robhold and ufprog; ufmec is a string
        frames.workObject.oframe = poseAt(numbers, 9);
    }
    if (!frames.isConsistent())
        return fmt::format("tool {} and work object {} do not fit: the robot holds exactly one of them", tool,
                           workObject);
    return {};
}

// ---- Moving --------------------------------------------------------------------------------------------------------

rt::Jogging& ManualMotion::joggingOf(const rt::MechanicalUnit& unit) {
    auto& jogging = jogging_[unit.group];
    if (!jogging) jogging = std::make_unique<rt::Jogging>(controller_.core().scheduler(), motionOf(unit));
    return *jogging;
}

Refusal ManualMotion::refusalOfJogging() const {
    if (controller_.panel().mode == OperatingMode::Auto)
        return "jogging is not possible in automatic mode: choose manual mode";
    if (controller_.panel().motors != MotorState::On) return "the motors are off: switch them on first";
    if (controller_.isRunning()) return "the program is executing: stop it first";
    if (controller_.core().motions().empty()) return "there is nothing to move";
    return {};
}

Refusal ManualMotion::jog(const rt::MechanicalUnit& unit, rt::JogOrder order) {
    if (Refusal refusal = refusalOfJogging(); !refusal.empty()) return refusal;
    if (Refusal refusal = framesOf(unit, choice(unit).tool, choice(unit).workObject, order.frames);
        !refusal.empty())
        return refusal;
    return joggingOf(unit).order(order);
}

Refusal ManualMotion::goTo(const rt::MechanicalUnit& unit, const motion::RobTarget& target) {
    if (Refusal refusal = refusalOfJogging(); !refusal.empty()) return refusal;
    motion::FrameSetup frames;
    if (Refusal refusal = framesOf(unit, choice(unit).tool, choice(unit).workObject, frames);
        !refusal.empty())
        return refusal;
    const motion::MotionSystem& system = motionOf(unit).system();
    const auto goal = system.toJointTarget(target, frames);
    if (!goal) return "the position is out of reach";
    rt::JogOrder order = rt::jogOrderTo(system.currentJoints(), *goal);
    order.frames = frames;
    return joggingOf(unit).order(order);
}

Refusal ManualMotion::align(const rt::MechanicalUnit& unit) {
    if (Refusal refusal = refusalOfJogging(); !refusal.empty()) return refusal;
    rt::JogOrder order;
    if (Refusal refusal = framesOf(unit, choice(unit).tool, choice(unit).workObject, order.frames);
        !refusal.empty())
        return refusal;
    const motion::MotionSystem& system = motionOf(unit).system();
    const motion::JointTarget here = system.currentJoints();
    const motion::Pose flange = system.flangeInWorld(here);
    const motion::Pose base = flange * inverse(system.kinematics().forward(here.robax));
    const motion::Pose tool = order.frames.tool.robotHeld ? order.frames.tool.tframe : motion::Pose();
    motion::Pose tcp = flange * tool;
    const std::string& chosen = choice(unit).coordinateSystem;
    motion::Quat axes; // of the chosen coordinate system in world
    if (sameName(chosen, "Base")) axes = base.rot;
    if (sameName(chosen, "Wobj") && !order.frames.workObject.robotHeld)
        axes = (order.frames.workObject.uframe * order.frames.workObject.oframe).rot;
    const motion::Vec3 z = rotate(conjugate(axes), rotate(tcp.rot, {0, 0, 1}));
    motion::Vec3 nearest{z.x < 0 ? -1.0 : 1.0, 0, 0};
    if (std::fabs(z.y) > std::fabs(z.x)) nearest = {0, z.y < 0 ? -1.0 : 1.0, 0};
    if (std::fabs(z.z) > std::max(std::fabs(z.x), std::fabs(z.y))) nearest = {0, 0, z.z < 0 ? -1.0 : 1.0};
    const motion::Vec3 axis = cross(z, nearest);
    const double size = norm(axis);
    constexpr double kAligned = 1e-6;
    if (size < kAligned) return {};
    order.increment = std::asin(std::min(1.0, size)) * 180 / std::numbers::pi; // at most 54.7 degrees
    order.turn = rotate(axes, axis * (1 / size));
    tcp.rot = normalized(robot::fromAxisAngle(order.turn, *order.increment) * tcp.rot);
    const auto joints = system.kinematics().inverseNear(inverse(base) * tcp * inverse(tool), here.robax);
    if (!joints) return "the position is out of reach";
    order.goal = here;
    order.goal->robax = *joints;
    return joggingOf(unit).order(order);
}

void ManualMotion::stopJogging() {
    for (const auto& [group, jogging] : jogging_)
        if (jogging) jogging->stop();
}

bool ManualMotion::isJogging() const {
    for (const auto& [group, jogging] : jogging_)
        if (jogging && jogging->isMoving()) return true;
    return false;
}

std::string ManualMotion::jogLimit(const rt::MechanicalUnit& unit) const {
    const auto found = jogging_.find(unit.group);
    return found == jogging_.end() || !found->second ? std::string() : found->second->limit();
}

Refusal ManualMotion::setActive(const rt::MechanicalUnit& unit, bool active) {
    rt::Controller& core = controller_.core();
    if (unit.isActive == active) return {};
    if (std::string refusal = rt::refusalOfActivation(core, unit, active); !refusal.empty()) return refusal;
    if (unit.isConveyor) return "a program activates conveyors (ActUnit, DeactUnit)";
    if (controller_.isRunning()) return "the program is executing: stop it first";
    if (isJogging() || motionOf(unit).system().isMoving()) return "the robot moves";
    rt::activateUnit(core, *core.units().find(unit.name), active);
    ++changeCount_;
    controller_.observers().motion();
    return {};
}

Refusal ManualMotion::teleport(const rt::MechanicalUnit& unit, const motion::JointTarget& joints) {
    if (controller_.isRunning()) return "the program is executing: stop it first";
    rt::MotionDriver& driver = motionOf(unit);
    motion::MotionSystem& system = driver.system();
    if (isJogging() || system.isMoving()) return "the robot moves";
    motion::JointTarget there = system.currentJoints();
    if (unit.isRobot) {
        if (const int axis = system.kinematics().jointOutsideLimits(joints.robax); axis != 0)
            return fmt::format("axis {} would be outside its range",
                               system.kinematics().axisNumber(static_cast<std::size_t>(axis - 1)));
        there.robax = joints.robax;
    }
    const motion::ExternalAxisModels& axes = system.externalAxes();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!motion::isConnected(there.extax[i]) || !motion::isConnected(joints.extax[i])) continue;
        if (!(joints.extax[i] >= axes[i].lower && joints.extax[i] <= axes[i].upper))
            return fmt::format("external axis {} would be outside its range", static_cast<char>('a' + i));
        there.extax[i] = joints.extax[i];
    }
    if (!system.storePath()) return "the robot moves";
    const bool placed = system.placeAt(there);
    (void)system.restorePath();
    driver.refresh();
    controller_.observers().motion();
    return placed ? Refusal() : Refusal("the robot cannot be placed now");
}

} // namespace rapidc::service
