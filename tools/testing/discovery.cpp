#include "tools/testing/discovery.h"

#include "frontend/syntax/tree_walk.h"
#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>
#include <utility>

namespace testing {
namespace {

namespace fs = std::filesystem;
using rapid::sema::Module;
using rapid::sema::RoutineSymbol;
using rt::lowerCase;
using rt::sameName;
using rt::trimmed;

bool isProcedure(const RoutineSymbol& routine) {
    return routine.routineKind == rapid::syntax::RoutineKind::Proc && !routine.predefined;
}

bool isTestName(const std::string& name) {
    return lowerCase(name).starts_with(kTestPrefix);
}

const RoutineSymbol* findProcedure(const Module& module, const char* name) {
    for (const RoutineSymbol* routine : module.routines)
        if (isProcedure(*routine) && sameName(routine->name, name)) return routine;
    return nullptr;
}

/// "a number of seconds" or what else is wrong.
std::string readSeconds(const std::string& value, std::optional<double>& seconds) {
    double number = 0;
    if (!rt::parseNumber(value, number) || !(number > 0))
        return fmt::format("'{}' is not a number of seconds above 0", value);
    seconds = number;
    return {};
}

/// A line of the stimulus, with the number that it has in the module, so that a message about it names that one.
void addStimulusLine(TestCase& test, const std::string& text, std::ptrdiff_t line) {
    const auto before = std::count(test.stimulusLines.begin(), test.stimulusLines.end(), '\n');
    if (line - 1 > before) test.stimulusLines.append(static_cast<std::size_t>(line - 1 - before), '\n');
    test.stimulusLines += text + "\n";
}

/// Takes one directive, which is in this line of the module; "" or what is wrong with it.
std::string takeDirective(TestCase& test, const std::string& key, const std::string& value,
                          std::ptrdiff_t line) {
    if (key == "skip") {
        test.skip = value.empty() ? "skipped by its comment" : value;
        return {};
    }
    if (key == "max-time") return readSeconds(value, test.maxTime);
    if (key == "timeout") return readSeconds(value, test.timeout);
    if (key == "seed") {
        double number = 0;
        if (!rt::parseNumber(value, number) || number < 0 || number > UINT32_MAX ||
            number != std::floor(number))
            return fmt::format("'{}' is not a whole number from 0 to {}", value, UINT32_MAX);
        test.seed = static_cast<uint32_t>(number);
        return {};
    }
    if (key == "stimulus") {
        if (value.find(',') != std::string::npos)
            addStimulusLine(test, value, line);
        else
            test.stimulusFile = (fs::path(test.file).parent_path() / value).string();
        return {};
    }
    return fmt::format("'{}' is not a directive of tests: skip, max-time, timeout, seed or stimulus", key);
}

/// The comments `!@ key: value` above the routine.
void readDirectives(const Module& module, const RoutineSymbol& routine, TestCase& test) {
    std::string_view comment = rapid::syntax::leadingTrivia(*module.tree, *routine.routineDecl);
    while (!comment.empty()) {
        const std::ptrdiff_t number = test.line - std::count(comment.begin(), comment.end(), '\n');
        const std::size_t end = std::min(comment.find('\n'), comment.size());
        const std::string line(trimmed(comment.substr(0, end)));
        comment.remove_prefix(std::min(end + 1, comment.size()));
        if (!line.starts_with("!@")) continue;
        const std::size_t colon = line.find(':');
        const std::string key =
            lowerCase(std::string(trimmed(line.substr(2, colon == std::string::npos ? colon : colon - 2))));
        const std::string value(colon == std::string::npos
                                    ? std::string_view()
                                    : trimmed(std::string_view(line).substr(colon + 1)));
        if (const std::string problem = takeDirective(test, key, value, number);
            !problem.empty() && test.problem.empty())
            test.problem = fmt::format("the comment '{}': {}", line, problem);
    }
}

/// NAME.csv beside the module for a test of that name, else MODULEFILE.csv for all tests of the file.
void findStimulus(TestCase& test) {
    if (!test.stimulusFile.empty() || !test.stimulusLines.empty()) return;
    const fs::path folder = fs::path(test.file).parent_path();
    for (const std::string& name : {test.name, fs::path(test.file).stem().string()}) {
        const fs::path beside = folder / (name + ".csv");
        std::error_code ignored;
        if (!fs::is_regular_file(beside, ignored)) continue;
        test.stimulusFile = beside.string();
        return;
    }
}

std::string parameterProblem(const RoutineSymbol& routine, const char* kind) {
    if (routine.params.empty()) return {};
    return fmt::format(
        "{} has parameters, but {} is called without arguments: remove them, or choose another name",
        routine.name, kind);
}

TestCase describe(const Module& module, const RoutineSymbol& routine) {
    TestCase test;
    test.module = module.name;
    test.name = routine.name;
    const rapid::SourceFile& source = *module.tree->source;
    test.file = source.path();
    const rapid::LineColumn place = source.lineColumn(module.tree->range(routine.nameToken).begin);
    test.line = place.line;
    test.column = place.column;
    test.endLine = source.lineColumn(module.tree->range(*routine.routineDecl).end).line;
    test.problem = parameterProblem(routine, "a test");
    for (const auto& [name, has] : {std::pair{kSetUp, &test.hasSetUp}, {kTearDown, &test.hasTearDown}}) {
        const RoutineSymbol* fixture = findProcedure(module, name);
        *has = fixture != nullptr;
        if (fixture && test.problem.empty()) test.problem = parameterProblem(*fixture, name);
    }
    readDirectives(module, routine, test);
    findStimulus(test);
    return test;
}

/// '*' means any characters, '?' one; both texts in lower case.
bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
    while (t < text.size()) {
        if (p < pattern.size() && (pattern[p] == '?' || (pattern[p] == text[t] && pattern[p] != '*'))) {
            ++p, ++t;
        } else if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*')
        ++p;
    return p == pattern.size();
}

bool isMeant(const TestCase& test, std::string_view pattern) {
    const std::string id = lowerCase(test.id);
    if (pattern.find_first_of("*?") == std::string_view::npos) return id.find(pattern) != std::string::npos;
    return matches(pattern, id) || matches(pattern, lowerCase(test.module)) ||
           matches(pattern, lowerCase(test.name)) ||
           matches(pattern, lowerCase(test.module + "." + test.name));
}

} // namespace

bool isTestRoutine(const RoutineSymbol& routine) {
    return isProcedure(routine) &&
           (isTestName(routine.name) || sameName(routine.name, kSetUp) || sameName(routine.name, kTearDown));
}

std::vector<TestCase> findTests(const rapid::sema::CheckedProgram& program) {
    std::vector<TestCase> tests;
    std::set<std::pair<std::string, std::string>> seen; // file and module
    for (std::size_t index = 0; index < program.tasks.size(); ++index) {
        const rapid::sema::Task& task = *program.tasks[index];
        for (const Module* module : task.modules) {
            if (!seen.emplace(module->tree->source->path(), lowerCase(module->name)).second) continue;
            for (const RoutineSymbol* routine : module->routines) {
                if (!isProcedure(*routine) || !isTestName(routine->name)) continue;
                TestCase test = describe(*module, *routine);
                test.task = task.name;
                test.taskIndex = static_cast<uint32_t>(index);
                test.id = (program.tasks.size() > 1 ? task.name + ":" : "") + test.module + "." + test.name;
                tests.push_back(std::move(test));
            }
        }
    }
    return tests;
}

std::vector<TestCase> filterTests(const std::vector<TestCase>& tests,
                                  const std::vector<std::string>& patterns) {
    std::vector<std::string> wanted, unwanted;
    for (const std::string& pattern : patterns)
        (pattern.starts_with('!') ? unwanted : wanted)
            .push_back(lowerCase(pattern.substr(pattern.starts_with('!') ? 1 : 0)));
    const auto isIn = [](const TestCase& test, const std::vector<std::string>& list) {
        return std::any_of(list.begin(), list.end(),
                           [&](const std::string& one) { return isMeant(test, one); });
    };
    std::vector<TestCase> result;
    for (const TestCase& test : tests)
        if ((wanted.empty() || isIn(test, wanted)) && !isIn(test, unwanted)) result.push_back(test);
    return result;
}

void shuffleTests(std::vector<TestCase>& tests, uint32_t seed) {
    std::mt19937 random(seed); // std::shuffle is not the same everywhere
    for (std::size_t i = tests.size(); i > 1; --i)
        std::swap(tests[i - 1], tests[random() % i]);
}

} // namespace testing
