#include "tools/service/manual_motion.h"

#include "config/text_util.h"
#include "tools/service/data_path.h"

#include <fmt/format.h>

#include <cmath>

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

Refusal ManualMotion::jog(const rt::MechanicalUnit& unit, rt::JogOrder order) {
    if (controller_.panel().mode == OperatingMode::Auto)
        return "jogging is not possible in automatic mode: choose manual mode";
    if (controller_.panel().motors != MotorState::On) return "the motors are off: switch them on first";
    if (controller_.isRunning()) return "the program is executing: stop it first";
    if (Refusal refusal = framesOf(unit, choice(unit).tool, choice(unit).workObject, order.frames);
        !refusal.empty())
        return refusal;
    if (controller_.core().motions().empty()) return "there is nothing to move";
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
