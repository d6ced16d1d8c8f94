#include "tools/pendant/unit_frames.h"

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/debug/debug_data.h"
#include "runtime/host/motion_driver.h"
#include "runtime/motion/targets.h"
#include "stdlib/impl/motion/state.h"
#include "tools/pendant/support.h"

namespace rapidc::pendant {

namespace {

using rapid::config::sameName;

robot::Pose poseOf(const rt::data::Pose& pose) {
    const float trans[3] = {pose.trans.x, pose.trans.y, pose.trans.z};
    const float rot[4] = {pose.rot.q1, pose.rot.q2, pose.rot.q3, pose.rot.q4};
    return motion::poseFromFloats(trans, rot);
}

NamedFrame frameOf(const rt::data::Tooldata& tool) {
    NamedFrame frame;
    frame.pose = poseOf(tool.tframe);
    frame.isHeld = tool.robhold;
    frame.massKg = static_cast<double>(tool.tload.mass);
    return frame;
}

NamedFrame frameOf(const rt::data::Wobjdata& object) {
    NamedFrame frame;
    frame.pose = poseOf(object.uframe) * poseOf(object.oframe);
    frame.isHeld = object.robhold;
    return frame;
}

template <class Data>
std::vector<NamedFrame> framesOf(service::VirtualController& controller, const rt::Task& task,
                                 const char* type) {
    std::vector<NamedFrame> frames;
    const rt::ProgramTables& tables = controller.core().tables();
    for (const rt::GlobalDesc* global : tables.globals()) {
        if (!sameName(global->type->baseName, type) ||
            !tables.isDeclaredIn(*global, static_cast<int32_t>(task.index())))
            continue;
        if ((global->flags & rt::kDataPredefined) != 0) continue;
        const rt::DebugVariable variable = rt::dataOf(*global);
        if (variable.rank > 0 || variable.data == nullptr || variable.isConstant) continue;
        NamedFrame frame = frameOf(*static_cast<const Data*>(variable.data));
        frame.name = global->name;
        frame.module = global->module;
        frames.push_back(std::move(frame));
    }
    return frames;
}

NamedFrame named(NamedFrame frame, const std::vector<NamedFrame>& known, const char* standard,
                 bool isStandardHeld) {
    if (frame.pose == robot::Pose{} && frame.isHeld == isStandardHeld) frame.name = standard;
    for (const NamedFrame& each : known)
        if (each.pose == frame.pose && each.isHeld == frame.isHeld)
            frame.name = each.name, frame.module = each.module;
    return frame;
}

} // namespace

NamedFrame tool0() {
    NamedFrame frame;
    frame.name = "tool0";
    frame.isHeld = true;
    return frame;
}

NamedFrame workObject0() {
    NamedFrame frame;
    frame.name = "wobj0";
    return frame;
}

rt::Task* taskMoving(service::VirtualController& controller, const rt::MotionDriver& motion) {
    for (const auto& task : controller.core().tasks())
        if (task->motionGroup() == static_cast<int>(motion.group())) return task.get();
    return nullptr;
}

std::vector<NamedFrame> toolsOf(service::VirtualController& controller, const rt::Task& task) {
    return framesOf<rt::data::Tooldata>(controller, task, "tooldata");
}

std::vector<NamedFrame> workObjectsOf(service::VirtualController& controller, const rt::Task& task) {
    return framesOf<rt::data::Wobjdata>(controller, task, "wobjdata");
}

NamedFrame toolInForce(service::VirtualController& controller, rt::Task& task) {
    return named(frameOf(rt::lib::motionState(&task).tool), toolsOf(controller, task), "tool0", true);
}

NamedFrame workObjectInForce(service::VirtualController& controller, rt::Task& task) {
    return named(frameOf(rt::lib::motionState(&task).workObject), workObjectsOf(controller, task), "wobj0",
                 false);
}

FramesInForce framesInForce(rt::Task& task) {
    const rt::lib::MotionState& state = rt::lib::motionState(&task);
    return {frameOf(state.tool).pose, frameOf(state.workObject).pose};
}

Json frameJson(const NamedFrame& frame) {
    return {{"name", frame.name},
            {"module", frame.module},
            {"pose", poseJson(frame.pose)},
            {"held", frame.isHeld}};
}

} // namespace rapidc::pendant
