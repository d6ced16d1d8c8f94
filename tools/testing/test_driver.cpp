#include "tools/testing/test_driver.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/module_units.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/step_hook.h"
#include "stdlib/impl/testing/test_record.h"
#include "stdlib/standard_library.h"
#include "tools/testing/statement_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace testing {
namespace {

using rt::lib::TestRecord;

enum class Phase : uint8_t { SetUp, Test, TearDown };
constexpr std::size_t kPhases = 3;

Spot spotOf(const rt::SourcePlace& place) {
    return {place.file, place.module, place.routine, place.line, place.column};
}

/// Leads a task through the phases and notes how they end. A service of the controller.
class Driver final : public rt::DebugClient {
  public:
    /// `endsOthers`: at the end of the test the other tasks, which may execute for ever, are not waited for.
    void begin(rt::Controller& controller, const TestCase& test,
               std::array<rt::EntryFunction, kPhases> routines, bool endsOthers) {
        endsOthers_ = endsOthers;
        controller_ = &controller;
        test_ = &test;
        routines_ = routines;
        task_ = controller.tasks()[test.taskIndex].get();
        controller.debugger().setClient(this);
        controller.log().addListener([this](const rt::Event& event) { note(event); });
        controller.onConnectionsLost([this](rt::Task& task, const char*) {
            // EXIT ends the program: nothing starts it again.
            if (&task == task_ && !task.endReason().empty()) controller_->debugger().setClient(nullptr);
        });
    }

    /// The program of the task: called in place of main.
    rt::Status execute(rt::Task& task, Phase from, Phase to) {
        for (auto phase = static_cast<std::size_t>(from); phase <= static_cast<std::size_t>(to); ++phase) {
            phase_ = static_cast<Phase>(phase);
            if (routines_[phase] == nullptr) continue;
            const rt::Status status = routines_[phase](&task, nullptr);
            task.frame = nullptr;
            if (status != rt::kOk) return status;
            if (phase_ == Phase::Test) judgeExpectedError(false, {});
        }
        isComplete_ = true;
        if (endsOthers_) controller_->debugger().quit();
        return rt::kOk;
    }

    void stopped(rt::Debugger& debugger, rt::Task& task, rt::StopReason reason) override {
        if (reason == rt::StopReason::Order) return; // the stimulus may start the program again
        noteStop(task, reason);
        const bool canTidy =
            phase_ != Phase::TearDown && routines_[static_cast<std::size_t>(Phase::TearDown)];
        if (!canTidy || task_->state() == rt::TaskState::Finished) {
            debugger.quit();
            return;
        }
        phase_ = Phase::TearDown;
        rt::MotionDriver& arm = controller_->motion(*task_);
        arm.clearPath();
        task_->moveToRoutine(&tearDownEntry);
        task_->keepVariables();
        debugger.continuous(*task_);
        (void)task_->resume();
        arm.programStart();
    }

    TestResult finish(rt::ExitStatus status) {
        TestResult result = std::move(result_);
        const TestRecord& record = controller_->service<TestRecord>();
        result.assertions = record.assertions;
        result.virtualTime = controller_->scheduler().now();
        const bool isOver = status == rt::ExitStatus::MaxTimeReached || status >= rt::ExitStatus::Interrupted;
        if (isDecided_) {
            if (isOver && !isComplete_) result.message += fmt::format("; {}", inPhase(limit_));
            return result;
        }
        result.outcome = Outcome::Error;
        if (record.failure) { // the system handler had no say: an UNDO handler was at work
            fail(result, *record.failure);
        } else if (isOver) {
            result.outcome = Outcome::Timeout;
            result.spot = limitSpot_;
            result.message = limit_;
        } else if (isComplete_) {
            result.outcome = Outcome::Passed;
        } else if (!task_->endReason().empty()) {
            result.spot = spotOf(task_->endPlace());
            result.message = fmt::format("the test ended by {} before its end", task_->endReason());
        } else if (!lastError_.text.empty()) {
            describeError(result, lastError_);
        } else {
            result.spot = limitSpot_;
            result.message = limit_.empty() ? "the test did not come to its end" : limit_;
        }
        return result;
    }

    static rt::Status entry(rt::TaskCore* core, rt::Frame*);
    static rt::Status tearDownEntry(rt::TaskCore* core, rt::Frame*);

  private:
    /// Errors, and what ended the run: the places are gone once the tasks are.
    void note(const rt::Event& event) {
        if (event.number == static_cast<int>(rt::EventId::NothingPending) ||
            event.number == static_cast<int>(rt::EventId::MaxTimeReached) ||
            event.number == static_cast<int>(rt::EventId::RunInterrupted)) {
            limitSpot_ = spotOf(task_->place());
            limit_ = event.number == static_cast<int>(rt::EventId::NothingPending)
                         ? "the test waits for something that cannot happen any more"
                     : event.number == static_cast<int>(rt::EventId::MaxTimeReached)
                         ? fmt::format("the test has not ended after {:g} s of virtual time",
                                       controller_->options().maxTime)
                         : "the test was ended from outside";
            return;
        }
        if (event.type == rt::EventType::Error) lastError_ = event;
    }

    void noteStop(rt::Task& task, rt::StopReason reason) {
        const TestRecord& record = controller_->service<TestRecord>();
        if (record.skip && phase_ != Phase::TearDown && !isDecided_) {
            decide(Outcome::Skipped, spotOf(record.skip->place), record.skip->reason);
            return;
        }
        if (reason != rt::StopReason::Error) {
            decide(Outcome::Error, spotOf(task.endPlace()),
                   fmt::format("the test was stopped by {}",
                               task.endReason().empty() ? "an order" : task.endReason()));
            return;
        }
        if (record.failure && !isFailureNoted_) {
            isFailureNoted_ = true;
            if (isDecided_)
                add(record.failure->text);
            else
                fail(result_, *record.failure);
            isDecided_ = true;
            return;
        }
        if (phase_ == Phase::Test && judgeExpectedError(true, lastError_)) return;
        if (isDecided_) {
            add(lastError_.text);
            return;
        }
        isDecided_ = true;
        describeError(result_, lastError_);
    }

    /// Judges ExpectError; true when the error that stopped the test is the one.
    bool judgeExpectedError(bool stopped, const rt::Event& error) {
        const TestRecord& record = controller_->service<TestRecord>();
        if (record.expectedError == 0) return false;
        const std::string name = controller_->log().errorName(record.expectedError);
        const std::string text = name.empty() ? fmt::format("error {}", record.expectedError)
                                              : fmt::format("{} ({})", name, record.expectedError);
        if (stopped && error.errorNumber == record.expectedError) {
            isDecided_ = true; // passed, unless TearDown fails
            return true;
        }
        if (stopped || isDecided_) return false;
        decide(Outcome::Failed, spotOf(record.expectedAt), fmt::format("expected {}, actual no error", text));
        result_.expected = text;
        result_.actual = "no error";
        return false;
    }

    void decide(Outcome outcome, Spot spot, const std::string& message) {
        if (isDecided_) {
            add(message);
            return;
        }
        isDecided_ = true;
        result_.outcome = outcome;
        result_.spot = std::move(spot);
        result_.message = inPhase(message);
    }

    void add(const std::string& message) {
        if (result_.outcome == Outcome::Passed || result_.outcome == Outcome::Skipped)
            result_.outcome = Outcome::Error;
        result_.message += (result_.message.empty() ? "" : "; ") + inPhase(message);
    }

    void fail(TestResult& result, const TestRecord::Failure& failure) const {
        result.outcome = Outcome::Failed;
        result.spot = spotOf(failure.place);
        result.message = inPhase(failure.text);
        result.expected = failure.expected;
        result.actual = failure.actual;
    }

    void describeError(TestResult& result, const rt::Event& error) const {
        result.outcome = Outcome::Error;
        result.spot = spotOf(error.place);
        result.message = inPhase(error.text.empty() ? "the program was stopped by an error" : error.text);
        for (const rt::SourcePlace& call : error.calls) {
            const bool isSame = !result.calls.empty() && result.calls.back().file == call.file &&
                                result.calls.back().line == call.line; // a recursion
            if (call.line != 0 && !isSame) result.calls.push_back(spotOf(call));
        }
    }

    std::string inPhase(const std::string& text) const {
        if (phase_ == Phase::SetUp) return fmt::format("in {}: {}", kSetUp, text);
        if (phase_ == Phase::TearDown) return fmt::format("in {}: {}", kTearDown, text);
        return text;
    }

    rt::Controller* controller_ = nullptr;
    const TestCase* test_ = nullptr;
    rt::Task* task_ = nullptr;
    std::array<rt::EntryFunction, kPhases> routines_{};
    Phase phase_ = Phase::SetUp;
    TestResult result_;
    bool isDecided_ = false;      // result_ has what ended the test
    bool isFailureNoted_ = false; // of the record
    bool isComplete_ = false;     // every phase came to its end
    bool endsOthers_ = false;
    rt::Event lastError_;
    Spot limitSpot_;
    std::string limit_;
};

rt::Status Driver::entry(rt::TaskCore* core, rt::Frame*) {
    rt::Task& task = rt::taskOf(core);
    return task.controller().service<Driver>().execute(task, Phase::SetUp, Phase::TearDown);
}

rt::Status Driver::tearDownEntry(rt::TaskCore* core, rt::Frame*) {
    rt::Task& task = rt::taskOf(core);
    return task.controller().service<Driver>().execute(task, Phase::TearDown, Phase::TearDown);
}

/// main of tasks that the test does not concern.
rt::Status noEntry(rt::TaskCore*, rt::Frame*) {
    return rt::kOk;
}

rt::EntryFunction findRoutine(const rt::ProgramDesc& program, const TestCase& test, const std::string& name) {
    for (uint32_t i = 0; i < program.routineCount; ++i) {
        const rt::RoutineEntry& entry = program.routines[i];
        if (entry.task != static_cast<int32_t>(test.taskIndex) || entry.kind != rt::kRoutineProc) continue;
        if (rt::sameName(entry.name, name) && rt::sameName(entry.module, test.module))
            return reinterpret_cast<rt::EntryFunction>(entry.address);
    }
    return nullptr;
}

/// The same program, whose task executes the test instead of main.
class TestedProgram {
  public:
    TestedProgram(const TestProgram& program, const TestCase& test)
        : desc_(*program.program), tasks_(desc_.tasks, desc_.tasks + desc_.taskCount) {
        for (uint32_t i = 0; i < desc_.taskCount; ++i) {
            if (i == test.taskIndex)
                tasks_[i].entry = &Driver::entry;
            else if (!program.withOtherTasks || tasks_[i].entry == nullptr)
                tasks_[i].entry = &noEntry;
            else
                continue;
            tasks_[i].type = "NORMAL"; // a background task would begin again and again
        }
        desc_.tasks = tasks_.data();
    }
    const rt::ProgramDesc& desc() const { return desc_; }

  private:
    rt::ProgramDesc desc_;
    std::vector<rt::TaskDesc> tasks_;
};

rt::RunOptions optionsFor(const TestProgram& program, const TestCase& test) {
    rt::RunOptions options = program.options;
    if (test.maxTime) options.maxTime = *test.maxTime;
    options.hasMaxTime = true;
    if (test.seed) options.seed = *test.seed;
    if (!test.stimulusFile.empty()) {
        options.stimulus = test.stimulusFile;
        options.stimulusText.reset();
    }
    if (!test.stimulusLines.empty()) {
        options.stimulus = test.file;
        options.stimulusText = test.stimulusLines;
    }
    return options;
}

} // namespace

TestResult runTest(const TestProgram& program, const TestCase& test, rt::ModuleLoader& loader,
                   std::unique_ptr<rt::ModuleStore> store) {
    const TestedProgram tested(program, test);
    TestResult result;
    result.outcome = Outcome::Error;
    result.spot = {test.file, test.module, test.name, test.line, test.column};
    const std::array<rt::EntryFunction, kPhases> routines = {
        test.hasSetUp ? findRoutine(tested.desc(), test, kSetUp) : nullptr,
        findRoutine(tested.desc(), test, test.name),
        test.hasTearDown ? findRoutine(tested.desc(), test, kTearDown) : nullptr};
    if (routines[1] == nullptr) {
        result.message = "the test is not part of the compiled program";
        return result;
    }
    StatementCounts counts; // lives longer than the tasks that ask it
    rt::Controller controller(optionsFor(program, test));
    rt::setUpStandardLibrary(controller);
    rt::setModuleLoader(controller, &loader);
    controller.saver().setStore(std::move(store));
    if (controller.prepare(tested.desc()) != rt::ExitStatus::Ended) {
        result.message = "the controller of the test cannot start";
        return result;
    }
    auto& driver = controller.service<Driver>();
    driver.begin(controller, test, routines, program.withOtherTasks);
    if (program.withCoverage) counts.attach(controller);
    const rt::ExitStatus status = controller.run();
    std::fflush(stdout);
    result = driver.finish(status);
    if (program.withCoverage) result.executed = counts.executed(*program.program);
    return result;
}

} // namespace testing
