#pragma once
// Support for all areas: tasks and modules that parameters name, paths of volumes, poses and places as JSON. On the controller's thread.

#include "runtime/robot/frames.h"
#include "tools/pendant/protocol.h"
#include "tools/service/pointers.h"
#include "tools/service/virtual_controller.h"

#include <optional>
#include <string>

namespace rapidc::pendant {

/// The task that params.task names; throws not_found.
rt::Task& taskOf(service::VirtualController& controller, const Json& params);
/// The module that params.module names, with its text; throws not_found.
struct NamedModule {
    rt::Task& task;
    const rt::LoadedModule& module;
    std::string text;
};
NamedModule moduleOf(service::VirtualController& controller, const Json& params);
/// params.line, from 1; throws bad_request.
uint32_t lineOf(const Json& params);
/// The unit of that name; throws not_found.
rt::MotionDriver& motionOf(service::VirtualController& controller, const std::string& unit);

struct HostFile {
    std::string rapid; ///< "HOME:/part/x.mod"
    std::string host;
};
/// A file or folder of a volume that params[name] names; throws bad_request.
HostFile fileOf(service::VirtualController& controller, const Json& params, const char* name);

/// Decimals of lengths in mm, of angles in degrees (and of mm of linear axes).
inline constexpr int kLengthDecimals = 3, kAngleDecimals = 4;
/// [x, y, z, q1, q2, q3, q4]
Json poseJson(const robot::Pose& pose);
Json vectorJson(const robot::Vec3& vector);
Json placeJson(const std::optional<service::PointerPlace>& place);
/// Whether a text contains another one, in any case.
bool matchesFilter(std::string_view text, std::string_view filter);

} // namespace rapidc::pendant
