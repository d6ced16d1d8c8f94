// breakpoints.*: those of all clients of the controller.

#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/service/breakpoint_list.h"

namespace rapidc::pendant {

namespace {

using service::BreakpointList;

class BreakpointArea final : public Area {
  public:
    explicit BreakpointArea(const Context& context)
        : controller_(context.controller), breakpoints_(context.breakpoints), hub_(context.hub) {
        listener_ = breakpoints_.onChange([this] {
            isChanged_ = true;
            hub_.wake();
        });
    }
    ~BreakpointArea() override { breakpoints_.forget(listener_); }
    BreakpointArea(const BreakpointArea&) = delete;
    BreakpointArea& operator=(const BreakpointArea&) = delete;

    void addTo(MethodTable& methods) override {
        methods.add("breakpoints.list",
                    [this](Client&, const Json&) { return Json{{"breakpoints", list()}}; });
        methods.add("breakpoints.set", [this](Client&, const Json& params) { return set(params); });
        methods.add("breakpoints.clear", [this](Client&, const Json& params) {
            clear(params);
            return Json();
        });
    }
    void describe(Json& state) override { state["breakpoints"] = list(); }
    void flush() override {
        if (std::exchange(isChanged_, false)) hub_.broadcast("breakpoints", {{"breakpoints", list()}});
    }

  private:
    static Json describe(const BreakpointList::Mark& mark) {
        return {{"task", mark.task},
                {"module", mark.module},
                {"line", mark.shownLine()},
                {"verified", mark.actualLine != 0}};
    }

    Json list() const {
        Json marks = Json::array();
        for (const BreakpointList::Mark& mark : breakpoints_.all())
            marks.push_back(describe(mark));
        return marks;
    }

    Json set(const Json& params) {
        const NamedModule named = moduleOf(controller_, params);
        BreakpointList::Mark mark;
        mark.task = named.task.name();
        mark.module = named.module.name;
        mark.line = lineOf(params);
        switch (breakpoints_.add(mark, false)) {
        case BreakpointList::Added::TooMany:
            throw RequestError{code::kTooLarge, "There are too many breakpoints", "Remove some of them"};
        case BreakpointList::Added::NoInstruction:
        case BreakpointList::Added::NotInLine:
            refuseUnless("no instruction follows that line: choose a line of a routine");
            break;
        case BreakpointList::Added::New:
        case BreakpointList::Added::Present: break;
        }
        return describe(mark);
    }

    void clear(const Json& params) {
        if (!has(params, "task") && !has(params, "module") && !has(params, "line"))
            return breakpoints_.clear();
        const auto line = lineOf(params);
        if (breakpoints_.remove(textOf(params, "task"), textOf(params, "module"), line) == 0)
            notFound("No breakpoint is set in that line");
    }

    service::VirtualController& controller_;
    BreakpointList& breakpoints_;
    Hub& hub_;
    int listener_ = 0;
    bool isChanged_ = false;
};

} // namespace

std::unique_ptr<Area> makeBreakpointArea(const Context& context) {
    return std::make_unique<BreakpointArea>(context);
}

} // namespace rapidc::pendant
