// breakpoints.*: those that pages have set. They stay when the controller is restarted or the program replaced.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/debug/debugger.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"

#include <vector>

namespace rapidc::pendant {

namespace {

using rapid::config::sameName;
using service::Change;

constexpr std::size_t kMost = 1000;
constexpr int64_t kMostLine = 10'000'000;

class BreakpointArea final : public Area {
  public:
    explicit BreakpointArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.changed = [this](Change change, const rt::Task*) {
            if (change == Change::Generation)
                for (Mark& mark : marks_)
                    setInDebugger(mark);
            // statements may lie elsewhere now
            if (change == Change::Generation || change == Change::Modules) isChanged_ = true, hub_.wake();
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~BreakpointArea() override { controller_.observers().remove(observer_); }
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
    struct Mark {
        std::string task, module;
        uint32_t line = 0; ///< as asked for
        int id = 0;        ///< of the debugger
    };

    rt::Debugger& debugger() const { return controller_.core().debugger(); }

    void setInDebugger(Mark& mark) {
        debugger().watch();
        mark.id = debugger()
                      .breakpoints()
                      .addLine(
                          mark.module, mark.line,
                          [module = mark.module](const rt::RoutineDesc& routine) {
                              return rt::isPlace(routine, module);
                          },
                          [task = mark.task](rt::Task& at, rt::Frame*) { return sameName(at.name(), task); })
                      .id;
    }

    Json describe(const Mark& mark) const {
        uint32_t line = 0;
        for (const rt::Breakpoint& each : debugger().breakpoints().all())
            if (each.id == mark.id) line = each.actualLine;
        return {{"task", mark.task},
                {"module", mark.module},
                {"line", line != 0 ? line : mark.line},
                {"verified", line != 0}};
    }

    Json list() const {
        Json marks = Json::array();
        for (const Mark& mark : marks_)
            marks.push_back(describe(mark));
        return marks;
    }

    uint32_t lineOf(const Mark& mark) const { return describe(mark).at("line").get<uint32_t>(); }

    Json set(const Json& params) {
        const NamedModule named = moduleOf(controller_, params);
        Mark mark{named.task.name(), named.module.name,
                  static_cast<uint32_t>(wholeOf(params, "line", 1, kMostLine)), 0};
        if (marks_.size() >= kMost)
            throw RequestError{code::kTooLarge, "There are too many breakpoints", "Remove some of them"};
        setInDebugger(mark);
        const uint32_t line = lineOf(mark);
        for (const Mark& other : marks_) {
            if (!sameName(other.task, mark.task) || !sameName(other.module, mark.module) ||
                lineOf(other) != line)
                continue;
            debugger().breakpoints().remove(mark.id); // it is there already
            return describe(other);
        }
        if (!describe(mark).at("verified").get<bool>()) {
            debugger().breakpoints().remove(mark.id);
            refuseUnless("no instruction follows that line: choose a line of a routine");
        }
        marks_.push_back(mark);
        isChanged_ = true;
        hub_.wake();
        return describe(mark);
    }

    void clear(const Json& params) {
        const bool all = !has(params, "task") && !has(params, "module") && !has(params, "line");
        const std::string task = all ? "" : textOf(params, "task"),
                          module = all ? "" : textOf(params, "module");
        const auto line = all ? 0 : static_cast<uint32_t>(wholeOf(params, "line", 1, kMostLine));
        const auto matches = [&](const Mark& mark) {
            return all || (sameName(mark.task, task) && sameName(mark.module, module) &&
                           (mark.line == line || lineOf(mark) == line));
        };
        const std::size_t count = std::erase_if(marks_, [&](const Mark& mark) {
            const bool goes = matches(mark);
            if (goes) debugger().breakpoints().remove(mark.id);
            return goes;
        });
        if (count == 0 && !all) notFound("There is no breakpoint in that line");
        isChanged_ = true;
        hub_.wake();
    }

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    std::vector<Mark> marks_;
    bool isChanged_ = false;
};

} // namespace

std::unique_ptr<Area> makeBreakpointArea(const Context& context) {
    return std::make_unique<BreakpointArea>(context);
}

} // namespace rapidc::pendant
