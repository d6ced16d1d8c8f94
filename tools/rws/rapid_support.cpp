#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"

#include <algorithm>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

const std::string kFileService = "/fileservice/";

} // namespace

Reply folder(std::initializer_list<std::pair<const char*, const char*>> children) {
    Document document;
    for (const auto& [type, path] : children)
        document.add(type, path).self = path;
    return Reply::of(std::move(document));
}

Reply oneValue(std::string type, std::string title, std::string name, std::string value) {
    Document document;
    document.add(std::move(type), std::move(title)).value(std::move(name), std::move(value));
    return Reply::of(std::move(document));
}

Reply badParameter(std::string_view name, std::string_view expected) {
    return Reply::refuse(ReturnCode::BadParameter,
                         std::string(name) + " is missing or wrong; expected: " + std::string(expected));
}

Reply replyTo(const service::Refusal& refusal, ReturnCode code, int status) {
    return refusal.empty() ? Reply::done() : Reply::refuse(code, refusal, status);
}

void addOrder(Router& router, const std::string& pattern, const char* oldName, const char* newName,
              const Handler& handler) {
    router.action(pattern, oldName, handler);
    router.post(Dialect::V2, pattern + "/" + newName, handler);
}

rt::Task* taskOf(service::VirtualController& controller, const Request& request) {
    std::string name = request.parameter("task");
    if (name.empty()) name = request.query.text("task");
    if (name.empty()) name = request.form.text("task");
    return controller.core().findTask(name);
}

Failure unknownTask(const std::string& name) {
    return {ReturnCode::NotFound, "task '" + name + "' does not exist"};
}

Reply noTask(const Request& request) {
    // a path that names no task leads nowhere; a parameter that does not is wrong
    const std::string& name = request.parameter("task");
    if (!name.empty()) return Reply::refuse(ReturnCode::NotFound, unknownTask(name).message);
    return badParameter("task", "the name of a task");
}

std::optional<VolumePath> volumePath(const service::VirtualController& controller, std::string_view path) {
    if (path.size() > kFileService.size() && sameName(path.substr(0, kFileService.size()), kFileService))
        path.remove_prefix(kFileService.size());
    if (path.starts_with('/')) path.remove_prefix(1);
    if (path.starts_with('$')) path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(":/"), path.size());
    const std::string volume(path.substr(0, end));
    path.remove_prefix(end);
    if (path.starts_with(':')) path.remove_prefix(1);
    while (path.starts_with('/'))
        path.remove_prefix(1);
    const rt::Volumes& volumes = const_cast<service::VirtualController&>(controller).core().volumes();
    VolumePath result;
    result.rapid = volume + ":/" + std::string(path);
    const bool isClean = !volume.empty() && result.rapid.find('\0') == std::string::npos;
    if (!isClean || !volumes.has(volume) || !volumes.resolve(result.rapid, result.host)) return std::nullopt;
    return result;
}

} // namespace rapidc::rws
