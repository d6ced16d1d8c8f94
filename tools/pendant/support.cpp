#include "tools/pendant/support.h"

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/host/motion_driver.h"
#include "tools/rws/rapid_support.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

constexpr int kQuaternionDecimals = 7;

} // namespace

rt::Task& taskOf(service::VirtualController& controller, const Json& params) {
    const std::string name = textOf(params, "task");
    rt::Task* task = controller.core().findTask(name);
    if (task == nullptr) notFound(fmt::format("There is no task {}", name));
    return *task;
}

NamedModule moduleOf(service::VirtualController& controller, const Json& params) {
    rt::Task& task = taskOf(controller, params);
    const std::string name = textOf(params, "module");
    const rt::LoadedModule* module =
        controller.core().tables().findModule(static_cast<int32_t>(task.index()), name);
    std::string text;
    if (module == nullptr || !controller.moduleText(task, module->name, text))
        notFound(fmt::format("There is no module {} in task {}", name, task.name()));
    return {task, *module, std::move(text)};
}

uint32_t lineOf(const Json& params) {
    return static_cast<uint32_t>(wholeOf(params, "line", 1, rws::kMostLine));
}

rt::MotionDriver& motionOf(service::VirtualController& controller, const std::string& unit) {
    for (const auto& motion : controller.core().motions())
        if (rapid::config::sameName(motion->unitName(), unit)) return *motion;
    notFound(fmt::format("There is no robot {}", unit));
}

HostFile fileOf(service::VirtualController& controller, const Json& params, const char* name) {
    const std::string path = textOf(params, name);
    std::optional<rws::VolumePath> found = rws::volumePath(controller, path);
    if (!found)
        badRequest(fmt::format("{} is not in a volume of the controller", path),
                   "Write it as HOME:/folder/name");
    return {std::move(found->rapid), std::move(found->host)};
}

Json vectorJson(const robot::Vec3& vector) {
    return Json::array({rounded(vector.x, kLengthDecimals), rounded(vector.y, kLengthDecimals),
                        rounded(vector.z, kLengthDecimals)});
}

Json poseJson(const robot::Pose& pose) {
    Json json = vectorJson(pose.pos);
    for (const double part : {pose.rot.w, pose.rot.x, pose.rot.y, pose.rot.z})
        json.push_back(rounded(part, kQuaternionDecimals));
    return json;
}

Json placeJson(const std::optional<service::PointerPlace>& place) {
    if (!place) return nullptr;
    return {{"module", place->module},      {"routine", place->routine}, {"line", place->beginLine},
            {"column", place->beginColumn}, {"endLine", place->endLine}, {"endColumn", place->endColumn},
            {"level", place->executionType}};
}

bool matchesFilter(std::string_view text, std::string_view filter) {
    return filter.empty() || rapid::config::containsName(text, filter);
}

} // namespace rapidc::pendant
