#include "tools/rws/rare_states.h"

#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using service::Change;

Entry entryOf(const char* type, const char* title, const char* name, std::string value) {
    Entry entry;
    entry.type = type;
    entry.title = title;
    entry.value(name, std::move(value));
    return entry;
}

/// Nothing to listen to: the group has the entry, or none, and no event follows.
void addConstant(Subscribables& subscribables, const char* path, const char* resource,
                 std::optional<Entry> entry = std::nullopt) {
    subscribables.add({path, resource, false, std::nullopt,
                       [entry = std::move(entry)](const Request&, const Changed&,
                                                  Subscription& out) -> std::optional<Failure> {
                           if (entry) out.initial.push_back(*entry);
                           out.watch = std::make_unique<Watch>();
                           return std::nullopt;
                       }});
}

/// Counts how often what `read` returns has become another since the subscription.
void addCount(service::VirtualController& controller, Subscribables& subscribables, Subscribable what,
              Change change, const char* type, const char* title, std::function<std::string()> read) {
    what.open = [&controller, change, type, title,
                 read = std::move(read)](const Request&, const Changed& changed, Subscription& out) {
        const auto count = [type, title, read, seen = read(), number = uint64_t{0}]() mutable {
            std::string now = read();
            if (now != seen) ++number;
            seen = std::move(now);
            return entryOf(type, title, "change-count", fmt::format("{}", number));
        };
        return watchState(controller.observers(), {change}, count, changed, out);
    };
    subscribables.add(std::move(what));
}

std::string modesOfUnits(service::VirtualController& controller) {
    std::string modes;
    for (const auto& unit : controller.core().units().all())
        modes += unit->isActive ? 'A' : 'D';
    return modes;
}

std::string activeTasks(service::VirtualController& controller) {
    std::string active;
    for (const auto& task : controller.core().tasks())
        active += controller.isTaskActive(*task) ? 'A' : 'D';
    return active;
}

} // namespace

void addRareStates(service::VirtualController& controller, Subscribables& subscribables) {
    addCount(controller, subscribables, {"/rw/motionsystem/mechunits", "mechunitmodechangecount"},
             Change::Interval, "motionsystem-ev", "mechunit-statechange",
             [&controller] { return modesOfUnits(controller); });
    addCount(controller, subscribables, {"/rw/rapid/taskselection", "taskpanelchange"}, Change::Tasks,
             "rap-taskpanel-ev", "taskpanel", [&controller] { return activeTasks(controller); });
    addConstant(subscribables, "/rw/motionsystem/errorstate", "erroreventchange");
    addConstant(subscribables, "/rw/rapid/execution", "hdtrun");
    addConstant(subscribables, "/rw/rapid/tasks", "buildlogchange"); // what has mistakes is not loaded
    addConstant(subscribables, "/rw/system/energy", "",
                entryOf("sys-energy-ev", "energy", "energy-state", "not-paused"));
    subscribables.add(
        {"/rw/rapid/tasks/{task}", "syncstatechange", false, std::nullopt,
         [&controller](const Request& request, const Changed&, Subscription& out) -> std::optional<Failure> {
             const std::string& task = request.parameter("task");
             if (controller.core().findTask(task) == nullptr) return unknownTask(task);
             out.initial.push_back(entryOf("rap-syncstate-ev", "syncstatechange", "sync-state", "on"));
             out.watch = std::make_unique<Watch>();
             return std::nullopt;
         }});
}

} // namespace rapidc::rws
