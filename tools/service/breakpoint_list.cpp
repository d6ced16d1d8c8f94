#include "tools/service/breakpoint_list.h"

#include "config/letter_case.h"
#include "runtime/debug/debugger.h"

namespace rapidc::service {

using rapid::config::sameName;

BreakpointList::BreakpointList(VirtualController& controller) : controller_(controller) {
    Observer observer;
    observer.changed = [this](Change change, const rt::Task*) {
        if (change == Change::Generation)
            for (Mark& mark : marks_)
                setInDebugger(mark);
        if (change == Change::Generation || change == Change::Modules) report();
        if (change == Change::Execution && !controller_.isRunning()) stopping_ = true;
    };
    observer_ = controller_.observers().add(std::move(observer));
}

BreakpointList::~BreakpointList() {
    controller_.observers().remove(observer_);
}

void BreakpointList::setInDebugger(Mark& mark) {
    rt::Debugger& debugger = controller_.core().debugger();
    debugger.watch();
    mark.id = debugger.breakpoints()
                  .addLine(
                      mark.module, mark.line,
                      [module = mark.module](const rt::RoutineDesc& routine) {
                          return rt::isPlace(routine, module);
                      },
                      [this, task = mark.task](rt::Task& at, rt::Frame*) {
                          return stopping_ && sameName(at.name(), task);
                      })
                  .id;
}

uint32_t BreakpointList::actualLineOf(int id) const {
    for (const rt::Breakpoint& each : controller_.core().debugger().breakpoints().all())
        if (each.id == id) return each.actualLine;
    return 0;
}

BreakpointList::Added BreakpointList::add(Mark& mark, bool exactly) {
    if (marks_.size() >= kMost) return Added::TooMany;
    setInDebugger(mark);
    mark.actualLine = actualLineOf(mark.id);
    rt::Breakpoints& breakpoints = controller_.core().debugger().breakpoints();
    if (mark.actualLine == 0 || (exactly && mark.actualLine != mark.line)) {
        breakpoints.remove(mark.id);
        return mark.actualLine == 0 ? Added::NoInstruction : Added::NotInLine;
    }
    for (const Mark& other : all()) {
        if (!sameName(other.task, mark.task) || !sameName(other.module, mark.module) ||
            other.shownLine() != mark.actualLine)
            continue;
        breakpoints.remove(mark.id);
        mark = other;
        return Added::Present;
    }
    marks_.push_back(mark);
    report();
    return Added::New;
}

std::size_t BreakpointList::remove(const std::string& task, const std::string& module, uint32_t line) {
    return removeIf([&](const Mark& mark) {
        return sameName(mark.task, task) && sameName(mark.module, module) &&
               (mark.line == line || actualLineOf(mark.id) == line);
    });
}

void BreakpointList::clear() {
    (void)removeIf([](const Mark&) { return true; });
}

std::size_t BreakpointList::removeIf(const std::function<bool(const Mark&)>& goes) {
    const std::size_t count = std::erase_if(marks_, [&](const Mark& mark) {
        const bool isGone = goes(mark);
        if (isGone) controller_.core().debugger().breakpoints().remove(mark.id);
        return isGone;
    });
    if (count != 0) report();
    return count;
}

std::vector<BreakpointList::Mark> BreakpointList::all() const {
    std::vector<Mark> marks = marks_;
    for (Mark& mark : marks)
        mark.actualLine = actualLineOf(mark.id);
    return marks;
}

int BreakpointList::onChange(std::function<void()> action) {
    actions_[++lastListener_] = std::move(action);
    return lastListener_;
}

void BreakpointList::report() const {
    for (const auto& [listener, action] : actions_)
        action();
}

} // namespace rapidc::service
