#include "tests/fuzz/program_runner.h"

#include "codegen/codegen.h"
#include "config/letter_case.h"
#include "frontend/diag/messages/calls.h"
#include "ir/lower/lower.h"
#include "ir/passes/passes.h"
#include "runtime/host/controller.h"
#include "stdlib/native_table.h"
#include "stdlib/standard_library.h"
#include "stdlib/stdlib_text.h"
#include "tests/fuzz/fuzz_support.h"
#include "tools/program/constant_calls.h"
#include "tools/program/native_library.h"

#include <algorithm>
#include <fcntl.h>
#include <sstream>
#include <sys/mman.h>
#include <unistd.h>

namespace rapid::fuzz {

namespace {

constexpr const char* kSignals =
    "EIO:CFG_1.0:5:0::\n#\nEIO_SIGNAL:\n\n"
    "      -Name \"di1\" -SignalType \"DI\"\n      -Name \"di2\" -SignalType \"DI\"\n"
    "      -Name \"do1\" -SignalType \"DO\"\n      -Name \"do2\" -SignalType \"DO\"\n"
    "      -Name \"gi1\" -SignalType \"GI\" -Size 8\n"
    "      -Name \"gi2\" -SignalType \"GI\" -Size 8\n"
    "      -Name \"go1\" -SignalType \"GO\" -Size 8\n"
    "      -Name \"go2\" -SignalType \"GO\" -Size 8\n"
    "      -Name \"ai1\" -SignalType \"AI\"\n      -Name \"ai2\" -SignalType \"AI\"\n"
    "      -Name \"ao1\" -SignalType \"AO\"\n      -Name \"ao2\" -SignalType \"AO\"\n";

std::string contentsOf(int descriptor) {
    std::string out(static_cast<size_t>(::lseek(descriptor, 0, SEEK_END)), '\0');
    const ssize_t got = ::pread(descriptor, out.data(), out.size(), 0);
    out.resize(got > 0 ? static_cast<size_t>(got) : 0);
    return out;
}

/// Catches what is written to a descriptor, in memory.
class Capture {
  public:
    explicit Capture(int descriptor) : descriptor_(descriptor), saved_(::dup(descriptor)) {
        memory_ = ::memfd_create("output", 0);
        ::dup2(memory_, descriptor_);
    }
    ~Capture() {
        ::dup2(saved_, descriptor_);
        ::close(saved_);
        ::close(memory_);
    }
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;
    std::string text() const { return contentsOf(memory_); }

  private:
    int descriptor_, saved_, memory_;
};

/// A file in memory, for what a run writes.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(::memfd_create("record", 0)) {}
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    std::string text() const { return contentsOf(descriptor_); }

  private:
    int descriptor_;
};

std::string show(const diag::Sink& sink) {
    std::string text;
    for (const diag::Diagnostic& d : sink.sorted())
        if (d.severity == diag::Severity::Error) text += renderText(d, false);
    return text;
}

} // namespace

bool dependsOnWallTime(std::string_view name) {
    constexpr std::string_view kNames[] = {"CTime",        "CDate",          "GetTime",     "FileTime",
                                           "FileTimeDnum", "ModTime",        "ModTimeDnum", "FSSize",
                                           "GetSysInfo",   "GetServiceInfo", "ProgMemFree", "TextGet"};
    return std::any_of(std::begin(kNames), std::end(kNames),
                       [&](std::string_view known) { return config::sameName(known, name); });
}

ProgramRunner::ProgramRunner() {
    for (const stdlib::StdlibSource& source : stdlib::sources())
        texts_.push_back({source.name, source.declarations});
    options_.library = texts_;
    options_.requireMain = true;
    options_.configurationKnown = true;
    for (const char* type : {"di", "do", "gi", "go", "ai", "ao"})
        for (const char* number : {"1", "2"})
            options_.signals.push_back({std::string(type) + number, std::string("signal") + type});
    diag::Sink sink;
    library_ = sema::check({}, options_, sink);
}

std::vector<sema::TaskInput> ProgramRunner::inputsOf(const TaskTexts& tasks, size_t robots) {
    std::vector<sema::TaskInput> inputs;
    for (size_t i = 0; i < tasks.size(); ++i) {
        sema::TaskInput& input = inputs.emplace_back();
        if (i > 0) input.name = (i < robots ? "T_ROB" : "T_") + std::to_string(i + 1);
        for (const std::string& text : tasks[i])
            input.files.push_back(std::make_shared<const SourceFile>(
                input.name + "_" + std::to_string(input.files.size()) + ".modx", text));
    }
    return inputs;
}

bool ProgramRunner::check(const TaskTexts& tasks, size_t robots) {
    const std::vector<sema::TaskInput> inputs = inputsOf(tasks, robots);
    sources_.clear();
    for (const sema::TaskInput& input : inputs)
        for (const auto& file : input.files)
            sources_ += "! ---- " + file->path() + "\n" + std::string(file->text());
    diag::Sink sink;
    program_ = sema::check(inputs, options_, sink);
    errors_ = show(sink);
    const auto& all = sink.all();
    refusable_ = std::any_of(all.begin(), all.end(), [](const diag::Diagnostic& d) {
        return d.code == diag::say::MechanicalUnitUnknown.code; // the controller has none of this name
    });
    return !sink.hasErrors();
}

namespace {

/// Runs a compiled program, for two or twenty seconds of virtual time.
RunResult execute(const rt::ProgramDesc& program, const Way& way) {
    rt::RunOptions runOptions;
    runOptions.hasMaxTime = true;
    runOptions.maxTime = 2;
    runOptions.stackBytes = 1u << 20;
    const MemoryFile events, signals, errors;
    if (way.records) {
        runOptions.maxTime = 20;
        runOptions.outputs.events = events.path();
        runOptions.outputs.signals = signals.path();
        runOptions.outputs.errors = errors.path();
    }
    RunResult result;
    {
        const Capture out(STDOUT_FILENO), err(STDERR_FILENO);
        {
            rt::Controller controller(runOptions);
            rt::setUpStandardLibrary(controller);
            result.status = static_cast<int>(controller.prepare(program));
            if (result.status == 0) result.status = static_cast<int>(controller.run());
        }
        std::fflush(stdout);
        std::fflush(stderr);
        result.output = out.text();
        result.events = events.text();
        result.signals = signals.text();
        result.errors = errors.text();
    }
    return result;
}

} // namespace

RunResult ProgramRunner::run(Way way) {
    const auto demand = [&](bool condition, const std::string& what) {
        if (!condition)
            std::fprintf(stderr, "%s\nin the %s profile: ", sources_.c_str(),
                         way.stepping ? "stepping" : "release");
        require(condition, what.c_str());
    };
    lower::Options options;
    options.stepping = way.stepping;
    options.configNames = {"EIO.cfg"};
    options.configTexts = {kSignals};
    options.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    if (way.optimise) options.evaluate = rapidc::constantCalls(); // the other ways execute these calls
    ir::Module module;
    diag::Sink sink;
    demand(lower::lowerProgram(*program_, options, sink, module), "checked, but not lowered:\n" + show(sink));
    ir::PassOptions passes;
    passes.profile = way.stepping ? ir::Profile::Stepping : ir::Profile::Release;
    std::string findings;
    for (const std::string& finding : ir::runPasses(module, passes))
        findings += finding + "\n";
    demand(findings.empty(), "checked, but the IR is wrong:\n" + findings);
    codegen::CodegenOptions codegenOptions = rapidc::codegenOptions(way.optimise);
    codegenOptions.debugInfo = false;
    codegenOptions.interpretsAll = way.interpreted;
    if (way.inParts) codegenOptions.partsAbove = 0;
    static const std::vector<codegen::NativeSymbol> symbols = rapidc::nativeSymbols();
    std::string error;
    const auto code = codegen::jit(module, codegenOptions, symbols, error);
    demand(code != nullptr, "checked, but no machine code: " + error);
    const RunResult result = execute(*code->program(), way);
    demand(result.status == 0 || result.status == 1 || result.status == 4 ||
               (result.status == 2 && refusable_),
           "exit status " + std::to_string(result.status));
    return result;
}

Tally& tally() {
    static Tally counted;
    static const bool shown = [] {
        std::atexit([] {
            std::fprintf(stderr, "%zu programs, %zu accepted, %zu compared, %zu ended\n", counted.all,
                         counted.accepted, counted.compared, counted.ended);
        });
        return true;
    }();
    static_cast<void>(shown);
    return counted;
}

namespace {

/// Checks the program, counts it, and shows it where RAPIDC_FUZZ_SHOW asks for that.
bool accepts(ProgramRunner& runner, const TaskTexts& tasks, size_t robots = 1) {
    ++tally().all;
    const bool accepted = runner.check(tasks, robots);
    if (std::getenv("RAPIDC_FUZZ_SHOW") != nullptr) {
        for (const auto& task : tasks)
            for (const std::string& text : task)
                std::fprintf(stderr, "%s", text.c_str());
        std::fprintf(stderr, "%s", runner.errors().c_str());
    }
    tally().accepted += accepted ? 1u : 0u;
    return accepted;
}

} // namespace

bool tryProgram(ProgramRunner& runner, const TaskTexts& tasks, bool hasTime, bool optimise) {
    if (!accepts(runner, tasks)) return false;
    const RunResult release = runner.run({.stepping = false, .optimise = optimise});
    const RunResult stepping = runner.run({.stepping = true, .optimise = false});
    constexpr int kMaxTime = 4;
    const bool comparable = !hasTime && release.status != kMaxTime && stepping.status != kMaxTime;
    tally().compared += comparable ? 1u : 0u;
    tally().ended += release.status == 0 ? 1u : 0u;
    if (optimise) {
        const RunResult parts = runner.run({.stepping = false, .optimise = true, .inParts = true});
        if (!hasTime && (parts.status != release.status || parts.output != release.output)) {
            std::fprintf(stderr, "---- release, status %d:\n%s---- in parts, status %d:\n%s", release.status,
                         release.output.c_str(), parts.status, parts.output.c_str());
            require(false, "a program compiled in parts differs");
        }
    }
    if (comparable && (release.status != stepping.status || release.output != stepping.output)) {
        for (const auto& task : tasks)
            for (const std::string& text : task)
                std::fprintf(stderr, "%s\n", text.c_str());
        std::fprintf(stderr, "---- release, status %d:\n%s---- stepping, status %d:\n%s", release.status,
                     release.output.c_str(), stepping.status, stepping.output.c_str());
        require(false, "the profiles differ");
    }
    return true;
}

namespace {

/// Removes `"name":` and its number from a line of the event log. Returns the number as it is written; empty without one.
std::string takeNumber(std::string& line, const std::string& name) {
    const std::string key = "\"" + name + "\":";
    const size_t begin = line.find(key);
    if (begin == std::string::npos) return {};
    const size_t end = line.find(',', begin);
    const std::string number = line.substr(begin + key.size(), end - begin - key.size());
    line.erase(begin, end + 1 - begin);
    return number;
}

/// An event and its repetitions, which the log counts until another event lies between them.
struct Repeated {
    std::string line;        ///< without times and count
    std::string first, last; ///< times
    size_t count = 0;
};

/// Leaves out what may differ between the profiles: the warning of a handled error, whose time depends on when it is known that the
/// handler has not called SkipWarn (RunResult::errors has these errors with their own times), and the line of an endless program at
/// its time limit, which is the statement before or after the look. A warning left out may have split the count of another event, so
/// all repetitions of an event are counted together.
std::string comparableEvents(const std::string& events) {
    std::vector<Repeated> all;
    std::istringstream lines(events);
    for (std::string line; std::getline(lines, line);) {
        if (line.find("\"number\":40901,") != std::string::npos) continue;
        line.erase(0, line.find("\"number\"")); // its number in the log counts the warnings
        if (line.find("\"number\":20901,") != std::string::npos) line.erase(line.find("\"text\""));
        const std::string time = takeNumber(line, "time"), count = takeNumber(line, "count");
        takeNumber(line, "since");
        auto found =
            std::find_if(all.begin(), all.end(), [&](const Repeated& known) { return known.line == line; });
        if (found == all.end()) found = all.insert(found, {line, time, time, 0});
        found->last = time;
        found->count += count.empty() ? 1 : std::stoul(count);
    }
    std::string kept;
    for (const Repeated& event : all)
        kept += event.line + " " + event.first + " to " + event.last + ", " + std::to_string(event.count) +
                " times\n";
    return kept;
}

/// The stack is exhausted, at another depth in each profile; or an interrupt raises an error, in its trap routine or for lack of
/// one (40907), which may belong to the interrupted statement.
bool mayDiffer(const sema::CheckedProgram& program, const RunResult& result) {
    for (const char* event : {"is exhausted: routines are nested", "\"number\":40907,"})
        if (result.events.find(event) != std::string::npos) return true;
    for (const auto& module : program.moduleStore)
        for (const sema::RoutineSymbol* routine : module->routines)
            if (routine->routineKind == syntax::RoutineKind::Trap &&
                result.errors.find("," + module->name + "," + routine->name + ",") != std::string::npos)
                return true;
    return false;
}

} // namespace

bool tryTasks(ProgramRunner& runner, const TaskTexts& tasks, size_t robots, bool optimise) {
    if (!accepts(runner, tasks, robots)) return false;
    const RunResult plain = runner.run({.optimise = false, .records = true});
    tally().ended += plain.status == 0 ? 1u : 0u;
    const auto compare = [&](const char* name, const RunResult& other) {
        if (mayDiffer(runner.program(), plain) || mayDiffer(runner.program(), other)) return;
        const auto same = [&](const char* what, const std::string& expected, const std::string& found) {
            if (expected == found) return;
            std::fprintf(stderr, "%s---- %s of the release profile:\n%s---- %s:\n%s",
                         runner.sources().c_str(), what, expected.c_str(), name, found.c_str());
            require(false, "the profiles differ");
        };
        same("output", plain.output, other.output);
        same("signals", plain.signals, other.signals);
        same("errors", plain.errors, other.errors);
        same("events", comparableEvents(plain.events), comparableEvents(other.events));
        same("status", std::to_string(plain.status), std::to_string(other.status));
    };
    compare("stepping", runner.run({.stepping = true, .optimise = false, .records = true}));
    compare("interpreted", runner.run({.optimise = false, .interpreted = true, .records = true}));
    if (optimise) {
        compare("optimised", runner.run({.records = true}));
        compare("in parts", runner.run({.records = true, .inParts = true}));
    }
    ++tally().compared;
    return true;
}

} // namespace rapid::fuzz
