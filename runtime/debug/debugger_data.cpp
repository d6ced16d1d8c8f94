// The call chain and the data of a stopped program.

#include "runtime/base/text_util.h"
#include "runtime/debug/debugger.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/interrupts.h"

#include <fmt/format.h>

namespace rt {
namespace {

/// The value that a LocalDesc and the address in the frame give.
DebugVariable local(const SteppingFrame& frame, uint32_t index) {
    const LocalDesc& desc = frame.routine->locals[index];
    DebugVariable variable;
    variable.name = desc.name;
    variable.type = desc.type;
    variable.isParameter = desc.isParam != 0;
    variable.rank = desc.rank;
    for (uint32_t k = 0; k < desc.rank; ++k)
        variable.dims[k] = *static_cast<const int32_t*>(frame.addresses[index + 1 + k]);
    variable.data = frame.addresses[index];
    if (desc.kind == LocalDesc::Reference) variable.data = *static_cast<void* const*>(frame.addresses[index]);
    return variable;
}

} // namespace

DebugVariable dataOf(const GlobalDesc& desc) {
    DebugVariable variable;
    variable.name = desc.name;
    variable.module = desc.module;
    variable.type = desc.type;
    variable.data = desc.address;
    variable.isPersistent = desc.kind == kGlobalPersistent;
    variable.isConstant = desc.kind == kGlobalConstant;
    return variable;
}

std::vector<DebugFrame> Debugger::frames(const Task& task) const {
    std::vector<DebugFrame> result;
    bool trap = false;
    for (Frame* at = task.frame; at != nullptr; at = at->caller) {
        if (at->routine == &kTrapBoundary || at->routine == &kEventBoundary) {
            if (!result.empty()) result.back().isTrap = true;
            trap = false;
            continue;
        }
        result.push_back({placeOf(at), at, trap});
    }
    return result;
}

std::vector<DebugVariable> Debugger::locals(const DebugFrame& frame) const {
    std::vector<DebugVariable> result;
    const RoutineDesc* routine = frame.frame != nullptr ? frame.frame->routine : nullptr;
    if (routine == nullptr || routine->localCount == 0) return result;
    const auto& record = *static_cast<const SteppingFrame*>(frame.frame);
    for (uint32_t i = 0; i < routine->localCount; i += 1u + routine->locals[i].rank)
        if (routine->locals[i].type != nullptr && *routine->locals[i].name != '\0')
            result.push_back(local(record, i));
    return result;
}

std::vector<DebugVariable> Debugger::globals(const Task& task) const {
    std::vector<DebugVariable> result;
    for (const GlobalDesc* desc : host_.tables().globals())
        if (host_.tables().isDeclaredIn(*desc, static_cast<int32_t>(task.index())))
            if (desc->kind != kGlobalConstant || (desc->flags & kDataPredefined) == 0)
                result.push_back(dataOf(*desc));
    return result;
}

DebugVariable Debugger::find(const Task& task, const DebugFrame* frame, std::string_view path,
                             std::string& error) const {
    path = trimmed(path);
    const std::size_t end = std::min(path.find_first_of(".{ "), path.size());
    const std::string_view name = path.substr(0, end);
    if (frame != nullptr)
        for (const DebugVariable& variable : locals(*frame))
            if (sameName(variable.name, name)) return partOf(variable, path.substr(end), error);
    const std::size_t colon = name.find(':');
    std::string_view module = colon == std::string_view::npos ? "" : name.substr(0, colon);
    const std::string_view plain = colon == std::string_view::npos ? name : name.substr(colon + 1);
    // Data of the module of the current routine come first: they may be LOCAL.
    const GlobalDesc* found = nullptr;
    if (module.empty() && frame != nullptr) found = host_.findGlobal(plain, frame->place.module, task);
    if (found == nullptr) found = host_.findGlobal(plain, module, task);
    if (found != nullptr) return partOf(dataOf(*found), path.substr(end), error);
    error = fmt::format("there is no data '{}'", name);
    return {};
}

std::string Debugger::assign(const Task& task, const DebugFrame* frame, std::string_view path,
                             std::string_view text) {
    std::string error;
    const DebugVariable variable = find(task, frame, path, error);
    return error.empty() ? assignText(variable, trimmed(text)) : error;
}

} // namespace rt
