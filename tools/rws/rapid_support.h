#pragma once
// Shared by the resources around RAPID: small parts of replies, values of forms, tasks, paths of volumes.

#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rapidc::rws {

/// A resource that only leads to others: a class and a relative path for each.
Reply folder(std::initializer_list<std::pair<const char*, const char*>> children);
/// A resource with one value.
Reply oneValue(std::string type, std::string title, std::string name, std::string value);
/// 400: "speed-ratio must be ...".
Reply badParameter(std::string_view name, std::string_view expected);
/// An order of the controller: 204, or its refusal with this code.
Reply replyTo(const service::Refusal& refusal, ReturnCode code = ReturnCode::Rejected, int status = 0);

/// "true" or "false".
inline const char* boolText(bool value) {
    return value ? "true" : "false";
}

/// Registers an order: RWS 1.0 POST pattern?action=oldName, RWS 2.0 POST pattern/newName.
void addOrder(Router& router, const std::string& pattern, const char* oldName, const char* newName,
              const Handler& handler);

/// Lines of modules in requests: at most.
inline constexpr int64_t kMostLine = 10'000'000;

/// The task that the parameter, the query or the form names "task"; null: there is none.
rt::Task* taskOf(service::VirtualController& controller, const Request& request);
/// 404: a task that a path names does not exist.
Failure unknownTask(const std::string& name);
/// 400 or 404 because of that.
Reply noTask(const Request& request);

/// A file of a volume.
struct VolumePath {
    std::string rapid; ///< "HOME:/part/x.mod"
    std::string host;  ///< where it lies on this computer
};
/// "$HOME/x", "HOME/x", "HOME:/x", "HOME:x", "/fileservice/$HOME/x". None: it leads out of the volumes, or names none.
std::optional<VolumePath> volumePath(const service::VirtualController& controller, std::string_view path);

} // namespace rapidc::rws
