// rapidc test: compiles once, runs each unit test in a process and on a controller of its own.

#include "runtime/host/command_line.h"
#include "tools/program/module_store.h"
#include "tools/program/native_library.h"
#include "tools/program/pipeline.h"
#include "tools/program/run_setup.h"
#include "tools/program/unit_compiler.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"
#include "tools/testing/coverage.h"
#include "tools/testing/discovery.h"
#include "tools/testing/reports.h"
#include "tools/testing/test_driver.h"
#include "tools/testing/test_pool.h"

#include "config/temporary.h"
#include "runtime/base/text_util.h"
#include "runtime/host/stop_signals.h"
#include "runtime/host/unit_loader.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <thread>
#include <unistd.h>

namespace rapidc {

namespace {

namespace fs = std::filesystem;
using testing::TestCase;
using testing::TestResult;

constexpr double kMaxTime = 600; // s of virtual time
constexpr double kTimeout = 60;  // s of the wall clock

struct TestSettings {
    Inputs inputs;
    rt::RunOptions options;
    std::vector<std::string> filters;
    std::string format = "human";
    std::string junit, tap, json, lcov, page; ///< paths; "" for none
    bool list = false, verbose = false, coverage = false, withOtherTasks = false;
    unsigned jobs = 0; ///< 0: as many as there are processors
    double timeout = kTimeout;
    std::optional<uint32_t> shuffle;

    bool countsStatements() const { return coverage || !lcov.empty() || !page.empty(); }
};

// ---- The program -----------------------------------------------------------------------------------------------------

/// The program as the processes of the tests inherit it: compiled, or, if it is large, ready to be compiled as it is called.
class CompiledTests {
  public:
    CompiledTests(const Compilation& compilation, const TestSettings& settings)
        : stepping_(settings.countsStatements() || timesStatements(compilation)), natives_(nativeSymbols()),
          codegen_(codegenOptions(!stepping_)) {
        codegen_.isExecutedOnce = !stepping_;
    }

    bool lower(Compilation& compilation, const std::string& name) {
        return lowerToIr(compilation, name, stepping_, module_, codegen_.partsAbove + 1,
                         testing::isTestRoutine);
    }
    /// False with a message. The thread that compiles a large program would not outlive fork(): then the tests do it.
    bool compile(const Compilation& compilation, std::string& error) {
        passes_ = irPasses(compilation, stepping_);
        sources_ = sourcesOf(compilation, stepping_, codegen_.optimise);
        isLarge_ = module_.instructionCount() > codegen_.partsAbove;
        return isLarge_ || load(error);
    }
    /// In the process of a test, or of everything.
    const rt::ProgramDesc* program(std::string& error) {
        if (!program_ && !load(error)) return nullptr;
        return program_->program();
    }
    bool isLarge() const { return isLarge_; }
    const ProgramSources& sources() const { return *sources_; }

  private:
    bool load(std::string& error) {
        runPassesInParts(codegen_, module_, passes_);
        program_ = codegen::jit(module_, codegen_, natives_, error);
        return program_ != nullptr;
    }

    bool stepping_;
    bool isLarge_ = false;
    ir::Module module_;
    ir::PassOptions passes_;
    std::vector<codegen::NativeSymbol> natives_;
    codegen::CodegenOptions codegen_;
    std::unique_ptr<ProgramSources> sources_;
    std::unique_ptr<codegen::JitProgram> program_;
};

// ---- One test ----------------------------------------------------------------------------------------------------------

/// The test's own copy of a HOME: folder. False with a message when it cannot be made.
bool copyHome(const std::string& from, rapid::config::TemporaryFolder& folder, std::string& error) {
    if (const int problem = folder.make("home"); problem != 0) {
        error = fmt::format("cannot make a folder for HOME: {}", std::strerror(problem));
        return false;
    }
    std::error_code code;
    fs::copy(from, folder.path(), fs::copy_options::recursive | fs::copy_options::skip_symlinks, code);
    if (code) error = fmt::format("cannot copy '{}': {}", from, code.message());
    return !code;
}

TestResult runHere(const TestCase& test, const TestSettings& settings, CompiledTests& compiled) {
    const rt::StopSignals signals;
    TestResult result;
    result.outcome = testing::Outcome::Error;
    testing::TestProgram program;
    program.program = compiled.program(result.message);
    if (program.program == nullptr) return result;
    program.options = settings.options;
    program.withOtherTasks = settings.withOtherTasks;
    program.withCoverage = settings.countsStatements();
    rapid::config::TemporaryFolder home;
    if (!settings.options.home.empty()) {
        if (!copyHome(settings.options.home, home, result.message)) return result;
        program.options.home = home.path();
    }
    SourceCompiler compiler(compiled.sources());
    rt::UnitLoader loader(compiler, rt::findNativeAddress);
    return testing::runTest(program, test, loader, std::make_unique<SourceStore>());
}

// ---- Reports -----------------------------------------------------------------------------------------------------------

bool writeFile(const std::string& path, const std::string& text, const char* option) {
    if (path.empty()) return true;
    std::error_code ignored;
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty()) fs::create_directories(folder, ignored);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    const bool complete = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const int problem = errno;
    const bool closed = file != nullptr && std::fclose(file) == 0;
    if (!complete || !closed) {
        const int why = complete ? errno : problem;
        fmt::print(stderr, "rapidc test: {}: '{}' cannot be written: {}\n", option, path, std::strerror(why));
    }
    return complete && closed;
}

std::string tapOf(const std::vector<testing::Finished>& results) {
    std::string text = testing::tapHead(results.size());
    for (size_t i = 0; i < results.size(); ++i)
        text += testing::tapText(i + 1, results[i].test, results[i].result);
    return text;
}

std::string sourceOf(const Compilation& compilation, const std::string& path) {
    for (const auto& task : compilation.tasks)
        for (const auto& file : task.files)
            if (file->path() == path) return std::string(file->text());
    return {};
}

/// The statements of the tests themselves do not count.
bool isCounted(const std::vector<TestCase>& tests, const rt::RoutineDesc& routine) {
    if (rt::sameName(routine.name, testing::kSetUp) || rt::sameName(routine.name, testing::kTearDown))
        return false;
    return std::none_of(tests.begin(), tests.end(), [&](const TestCase& test) {
        return rt::sameName(test.module, routine.module) && rt::sameName(test.name, routine.name);
    });
}

class Session {
  public:
    Session(TestSettings& settings, Compilation& compilation, std::vector<TestCase> all,
            std::vector<TestCase> chosen)
        : settings_(settings), compilation_(compilation), all_(std::move(all)), tests_(std::move(chosen)),
          compiled_(compilation, settings) {}

    int run() {
        std::string error;
        const std::string name = nameOfProgram(settings_.inputs);
        const bool lowered = !compilation_.sink.hasErrors() && compiled_.lower(compilation_, name);
        printDiagnostics(compilation_);
        if (!lowered || !compiled_.compile(compilation_, error)) {
            if (!error.empty()) fmt::print(stderr, "rapidc test: {}\n", error);
            return static_cast<int>(rt::ExitStatus::BadProgram);
        }
        const rt::StopSignals signals;
        testing::PoolOptions pool;
        pool.jobs = settings_.jobs != 0 ? settings_.jobs : std::max(1U, std::thread::hardware_concurrency());
        pool.timeout = settings_.timeout;
        if (settings_.format == "tap") fmt::print("{}", testing::tapHead(tests_.size()));
        const bool complete = testing::runTests(
            tests_, pool, [this](const TestCase& test) { return runHere(test, settings_, compiled_); },
            [this](const TestCase& test, const TestResult& result) { take(test, result); });
        const bool written = report(complete);
        std::fflush(stdout);
        rt::StopSignals::endIfReceived();
        if (!testing::totalsOf(results_).isGood() || !complete)
            return static_cast<int>(rt::ExitStatus::StoppedByError);
        return static_cast<int>(written ? rt::ExitStatus::Ended : rt::ExitStatus::BadUsage);
    }

  private:
    void take(const TestCase& test, const TestResult& bytes) {
        const TestResult& result = results_.emplace_back(testing::Finished{test, inUtf8(bytes)}).result;
        if (settings_.format == "human")
            fmt::print("{}", testing::humanText(test, result, settings_.verbose, isatty(STDOUT_FILENO) != 0));
        if (settings_.format == "tap") fmt::print("{}", testing::tapText(results_.size(), test, result));
        std::fflush(stdout);
    }

    bool report(bool complete) {
        if (settings_.format == "human") fmt::print("{}", testing::humanTotals(testing::totalsOf(results_)));
        if (settings_.format == "junit") fmt::print("{}", testing::junitText(results_));
        if (settings_.format == "json") fmt::print("{}", testing::jsonText(results_));
        if (!complete)
            fmt::print(stderr, "rapidc test: ended by {} after {} of {} tests\n",
                       rt::StopSignals::name(rt::StopSignals::received()), results_.size(), tests_.size());
        bool written = writeFile(settings_.junit, testing::junitText(results_), "--junit");
        written = writeFile(settings_.tap, tapOf(results_), "--tap") && written;
        written = writeFile(settings_.json, testing::jsonText(results_), "--json") && written;
        return (!settings_.countsStatements() || reportCoverage()) && written;
    }

    bool reportCoverage() {
        std::string error;
        const rt::ProgramDesc* program = compiled_.program(error);
        if (program == nullptr) {
            fmt::print(stderr, "rapidc test: no coverage: {}\n", error);
            return false;
        }
        testing::Coverage coverage(
            *program, [this](const rt::RoutineDesc& routine) { return isCounted(all_, routine); });
        for (const testing::Finished& one : results_)
            coverage.add(one.result);
        const std::vector<testing::CoveredFile> files = coverage.files();
        if (settings_.coverage && settings_.format == "human")
            fmt::print("{}", testing::coverageSummary(files));
        bool written = writeFile(settings_.lcov, testing::lcovText(files), "--lcov");
        const auto textOf = [this](const std::string& path) { return sourceOf(compilation_, path); };
        return writeFile(settings_.page, settings_.page.empty() ? "" : testing::coveragePage(files, textOf),
                         "--coverage-page") &&
               written;
    }

    TestSettings& settings_;
    Compilation& compilation_;
    std::vector<TestCase> all_, tests_;
    CompiledTests compiled_;
    std::vector<testing::Finished> results_;
};

int listTests(const TestSettings& settings, const std::vector<TestCase>& tests) {
    if (settings.format == "json") {
        fmt::print("{}", testing::listJson(tests));
        return 0;
    }
    for (const TestCase& test : tests)
        fmt::print("{}  {}:{}\n", test.id, test.file, test.line);
    return 0;
}

std::string listed(const std::vector<std::string>& texts) {
    std::string result;
    for (const std::string& text : texts)
        result += (result.empty() ? "'" : ", '") + text + "'";
    return result;
}

int test(TestSettings& settings) {
    Inputs& inputs = settings.inputs;
    inputs.cameras = settings.options.cameras;
    inputs.home = settings.options.home;
    const auto compilation = checkInputs(inputs);
    if (!compilation->usageErrors.empty()) return usageError("test", compilation->usageErrors.front());
    if (!compilation->program || compilation->program->tasks.empty()) {
        printDiagnostics(*compilation);
        return static_cast<int>(rt::ExitStatus::BadProgram);
    }
    std::vector<TestCase> all = testing::findTests(*compilation->program);
    std::vector<TestCase> chosen = testing::filterTests(all, settings.filters);
    if (settings.shuffle) testing::shuffleTests(chosen, *settings.shuffle);
    if (settings.list) return listTests(settings, chosen);
    std::string error = outputConflict(*compilation, {{"--junit", settings.junit},
                                                      {"--tap", settings.tap},
                                                      {"--json", settings.json},
                                                      {"--lcov", settings.lcov},
                                                      {"--coverage-page", settings.page}});
    if (!error.empty() || !readStimulus(settings.options, error)) return usageError("test", error);
    if (chosen.empty() && !compilation->sink.hasErrors()) {
        if (!all.empty())
            return usageError(
                "test", fmt::format("none of the {} tests matches {}", all.size(), listed(settings.filters)));
        return usageError(
            "test",
            fmt::format("there are no tests in {}: a test is a procedure without parameters whose name "
                        "begins with Test (docs/testing.md)",
                        listed(inputs.paths)));
    }
    settings.options.robots = inputs.robots;
    settings.options.conveyors = inputs.conveyors;
    if (settings.options.home.empty()) settings.options.home = compilation->homeFolder;
    if (!settings.options.hasMaxTime) settings.options.maxTime = kMaxTime;
    return Session(settings, *compilation, std::move(all), std::move(chosen)).run();
}

// ---- Options -----------------------------------------------------------------------------------------------------------

/// An option that takes a number, `least` at least.
void addNumber(const rt::Command& command, const char* name, double least, bool whole,
               const std::function<void(double)>& take, const std::string& text, const char* type) {
    const auto check = [=](const std::string& given) -> std::string {
        double number = 0;
        if (!rt::parseNumber(given, number) || !(number >= least) || number > UINT32_MAX ||
            (whole && number != std::floor(number)))
            return fmt::format("'{}' is not a {}number from {:g} on", given, whole ? "whole " : "", least);
        take(number);
        return {};
    };
    command.addChecked(name, check, text).typeName(type);
}

void addRunOptions(const rt::Command& command, TestSettings& settings) {
    rt::RunOptions& options = settings.options;
    command.add("--home", options.home, "HOME: of each test is a copy of this folder; default: an empty one")
        .typeName("DIR");
    command.add("--volume", options.volumes, "A further disk of the controller; repeatable")
        .typeName("NAME=DIR")
        .oneValueEach();
    command.add("--device", options.devices, "A serial channel or printer; repeatable")
        .typeName("NAME=FILE[,FILE]")
        .oneValueEach();
    command.add("--camera", options.cameras, "A camera and what it sees; repeatable")
        .typeName("NAME=FILE.json")
        .oneValueEach();
    command
        .add("--stimulus", options.stimulus, "Events from outside, for tests without a stimulus of their own")
        .typeName("FILE.csv");
    command.addFlag("--offline", options.network.offline, "Sockets connect tasks of this controller only");
    command.addFlag("--all-tasks", settings.withOtherTasks,
                    "The other tasks execute their main beside each test");
    const auto maxTime = [&options](double seconds) {
        options.maxTime = seconds;
        options.hasMaxTime = true;
    };
    addNumber(command, "--max-time", 0, false, maxTime,
              fmt::format("Limit of each test in virtual time; default {:g}", kMaxTime), "SECONDS");
    addNumber(
        command, "--timeout", 0, false, [&settings](double seconds) { settings.timeout = seconds; },
        fmt::format("Limit of each test on the wall clock; default {:g}", kTimeout), "SECONDS");
    addNumber(
        command, "--seed", 0, true, [&options](double seed) { options.seed = static_cast<uint32_t>(seed); },
        "Start value of Rand in each test; default 1", "N");
    addNumber(
        command, "--shuffle", 0, true,
        [&settings](double seed) { settings.shuffle = static_cast<uint32_t>(seed); },
        "Random order of the tests, the same for the same number; default: as in the sources", "N");
    addNumber(
        command, "-j,--jobs", 1, true,
        [&settings](double jobs) { settings.jobs = static_cast<unsigned>(jobs); },
        "Tests at a time; default: as many as there are processors", "N");
}

} // namespace

void addTestCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<TestSettings>();
    const rt::Command command =
        line.addCommand("test", "Run unit tests written in RAPID", [settings] { return test(*settings); });
    addInputArgument(command, settings->inputs);
    command
        .add("--filter", settings->filters,
             "Only tests whose id MODULE.TEST contains this, or matches it with * and ?; "
             "!PATTERN leaves tests out; repeatable")
        .typeName("PATTERN")
        .oneValueEach();
    command.addFlag("--list", settings->list, "Show the tests and where they are; --format=json for editors");
    command.add("--format", settings->format, "Format of the results on standard output")
        .oneOf({"human", "tap", "junit", "json"});
    command.add("--junit", settings->junit, "Also write JUnit XML").typeName("FILE.xml");
    command.add("--tap", settings->tap, "Also write TAP").typeName("FILE.tap");
    command.add("--json", settings->json, "Also write JSON").typeName("FILE.json");
    command.addFlag("--coverage", settings->coverage, "Show how many statements the tests have executed");
    command.add("--lcov", settings->lcov, "Write the coverage as a trace file of lcov").typeName("FILE.info");
    command.add("--coverage-page", settings->page, "Write the coverage as a page").typeName("FILE.html");
    command.addFlag("-v,--verbose", settings->verbose, "Show what every test writes, and its events");
    addTaskOption(command, settings->inputs);
    addConfigOption(command, settings->inputs);
    addRobotOption(command, settings->inputs);
    addAssumeSignalsOption(command, settings->inputs);
    addWarningOption(command, settings->inputs);
    addRunOptions(command, *settings);
}

} // namespace rapidc
