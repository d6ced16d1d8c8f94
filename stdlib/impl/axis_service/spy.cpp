// SpyStart, SpyStop (manual 1.18): a file with a line for each statement that a program executes, and when. A statement is over
// when the next one of its task begins; one that calls a routine, when the first of the routine does.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/system/whole_file.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/step_hook.h"

#include "natives/calibration.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace rt;

namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20; // of the file
constexpr int32_t kAsksForSpy = 4;                        // beside what a debugger asks
constexpr std::size_t kTextWidth = 40;                    // longer statements are cut off

/// The lines of source files, read once.
class SourceLines {
  public:
    /// "" when the file cannot be read.
    std::string lineOf(const std::string& file, uint32_t number) {
        auto known = files_.find(file);
        if (known == files_.end()) known = files_.emplace(file, read(file)).first;
        const auto& lines = known->second;
        return number >= 1 && number <= lines.size() ? lines[number - 1] : "";
    }

  private:
    static std::vector<std::string> read(const std::string& file) {
        std::vector<std::string> lines;
        std::string bytes;
        if (!readStream(file, bytes).empty()) return lines;
        const std::string text = toUtf8(bytes);
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            lines.push_back(text.substr(begin, end - begin));
            begin = end + 1;
        }
        return lines;
    }

    std::map<std::string, std::vector<std::string>> files_;
};

/// Receives the stops of tasks before the debugger while it records. A service of the controller.
class Spy final : public StepHook {
  public:
    bool isOn() const { return isOn_; }
    void start(Controller& controller, std::string path) {
        controller_ = &controller;
        path_ = std::move(path);
        began_ = controller.scheduler().now();
        text_ = fmt::format("{:<10} {:<{}} {:>9}   CODE  {:>9}\n", "TASK", "INSTR", kTextWidth, "IN", "OUT");
        open_.clear();
        isOn_ = true;
        inner_ = controller.tasks().front()->stepHook();
        for (const auto& task : controller.tasks()) {
            task->setStepHook(this);
            task->askSteps += kAsksForSpy;
        }
        if (std::exchange(endsWithRun_, true)) return;
        controller.onShutDown([this] { (void)stop(); }); // no caller is left to report a problem to
    }
    /// "" or why the file cannot be written.
    std::string stop() {
        if (!std::exchange(isOn_, false)) return {};
        for (const auto& task : controller_->tasks()) {
            close(*task, "WAIT");
            task->setStepHook(inner_);
            task->askSteps -= kAsksForSpy;
        }
        return lib::writeWhole(*controller_, path_, text_);
    }

    int32_t beforeStatement(Task& task, Frame* at) override {
        const RoutineDesc& routine = *at->routine;
        if (routine.noStepIn == 0 && routine.isBuiltin == 0) {
            close(task, "READY");
            open_[&task] = {&routine, at->statement, task.now()};
        }
        return inner_->beforeStatement(task, at);
    }
    bool isBackward(const Task& task) const override { return inner_->isBackward(task); }
    Status failed(Task& task) override { return inner_->failed(task); }

  private:
    struct Open {
        const RoutineDesc* routine = nullptr;
        int32_t statement = -1;
        Time since = 0;
    };

    void close(const Task& task, const char* code) {
        const auto found = open_.find(&task);
        if (found == open_.end()) return;
        const Open open = found->second;
        open_.erase(found);
        if (text_.size() > kMostBytes) return;
        text_ += fmt::format("{:<10} {:<{}} {:>9} : {:<5} {:>9}\n", task.name(),
                             textOf(*open.routine, open.statement), kTextWidth, millis(open.since), code,
                             millis(task.now()));
    }
    int64_t millis(Time time) const { return (time - began_) / kMillisecond; }
    std::string textOf(const RoutineDesc& routine, int32_t statement) {
        const StmtDesc& s = routine.statements[statement];
        std::string text = sources_.lineOf(routine.file, s.line);
        if (text.size() < s.column) return fmt::format("{}/{}:{}", routine.module, routine.name, s.line);
        text = trimmed(std::string_view(text).substr(
            s.column - 1, s.endLine == s.line ? s.endColumn - s.column + 1 : std::string::npos));
        while (text.ends_with(';') || text.ends_with(' '))
            text.pop_back();
        return text.substr(0, kTextWidth);
    }

    Controller* controller_ = nullptr;
    StepHook* inner_ = nullptr;
    std::string path_, text_;
    Time began_ = 0;
    bool isOn_ = false, endsWithRun_ = false;
    std::map<const Task*, Open> open_;
    SourceLines sources_;
};

} // namespace

extern "C" {

/// A recording in progress ends.
Status rt_SpyStart(TaskCore* task, const String* File) {
    Controller& controller = taskOf(task).controller();
    auto& spy = controller.service<Spy>();
    (void)spy.stop(); // its own file, whose problem was reported when it was opened
    const std::string problem = lib::writeWhole(controller, File->view(), "");
    if (!problem.empty())
        return lib::fail(task, err::ERR_FILEOPEN,
                         fmt::format("{} cannot be opened: {}", File->view(), problem));
    spy.start(controller, std::string(File->view()));
    return kOk;
}

/// Without effect when nothing is recorded.
Status rt_SpyStop(TaskCore* task) {
    const std::string problem = taskOf(task).controller().service<Spy>().stop();
    return problem.empty() ? kOk : lib::fail(task, err::ERR_FILEOPEN, problem);
}
}
