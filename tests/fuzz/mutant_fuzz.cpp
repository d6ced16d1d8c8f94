// libFuzzer target: a program of the tests, changed by pieces of its syntax tree (tree_mutator.h). All profiles must do the same with
// it. The input is the text of the program: a file for each task, divided by a byte FE.

#include "config/letter_case.h"
#include "frontend/sema/session.h"
#include "frontend/syntax/lexer.h"
#include "fuzz_support.h"
#include "tests/fuzz/program_runner.h"
#include "tests/fuzz/tree_mutator.h"

#include <algorithm>
#include <map>

namespace {

using namespace rapid;
using fuzz::below;
using fuzz::Random;
namespace files = std::filesystem;

constexpr char kNextTask = '\xFE';

fuzz::ProgramRunner& runner() {
    static fuzz::ProgramRunner one;
    return one;
}

fuzz::TaskTexts tasksOf(const std::string& program) {
    fuzz::TaskTexts tasks;
    for (size_t from = 0; from <= program.size();) {
        const size_t end = std::min(program.find(kNextTask, from), program.size());
        tasks.push_back({program.substr(from, end - from)});
        from = end + 1;
    }
    return tasks;
}

std::string joined(const fuzz::TaskTexts& tasks) {
    std::string program;
    for (const auto& task : tasks)
        program += (program.empty() ? "" : std::string(1, kNextTask)) + task.front();
    return program;
}

/// Names of the signals of a configuration, in lower case, to those that the runner has of their type.
std::map<std::string, std::string> signalsOf(const std::string& configuration) {
    std::map<std::string, std::string> signals;
    const auto quoted = [&](std::string_view key, size_t from, size_t end) -> std::string {
        const size_t found = configuration.find(key, from);
        if (found >= end) return {};
        const size_t begin = configuration.find('"', found) + 1;
        return config::lowerCase(configuration.substr(begin, configuration.find('"', begin) - begin));
    };
    for (size_t at = configuration.find("-Name"); at != std::string::npos;) {
        const size_t next = configuration.find("-Name", at + 1);
        const std::string type = quoted("-SignalType", at, next);
        if (!type.empty()) signals[quoted("-Name", at, next)] = type + std::to_string(1 + signals.size() % 2);
        at = next;
    }
    return signals;
}

template <class Change> std::string withWords(const std::string& text, const Change& change) {
    std::string result;
    size_t from = 0;
    for (const syntax::Token& token : syntax::lex(text).tokens) {
        result += text.substr(from, token.offset - from) + change(text.substr(token.offset, token.length));
        from = token.offset + token.length;
    }
    return result + text.substr(from);
}

/// The program of these files, a task each, with signals that the runner has.
std::string seedOf(const std::vector<files::path>& modules) {
    std::map<std::string, std::string> signals;
    for (const auto& entry : files::directory_iterator(modules.front().parent_path()))
        if (entry.path().extension() == ".cfg") signals.merge(signalsOf(fuzz::readAll(entry.path())));
    fuzz::TaskTexts tasks;
    for (const files::path& module : modules)
        tasks.push_back({withWords(fuzz::readAll(module), [&](const std::string& word) {
            const auto found = signals.find(config::lowerCase(word));
            return found == signals.end() ? word : found->second;
        })});
    return joined(tasks);
}

/// The programs of the tests that consist of a module, or of a module for each task.
const std::vector<std::string>& seeds() {
    static const std::vector<std::string> programs = [] {
        std::vector<std::vector<files::path>> all;
        for (const files::path& path : fuzz::modulePaths({"/tests/golden", "/tests/tasks"})) {
            const bool isTask = path.string().find("/tasks/") != std::string::npos;
            if (fuzz::readAll(path).find("PROC main(") == std::string::npos) continue;
            if (isTask && !all.empty() && all.back().front().parent_path() == path.parent_path())
                // main.modx is the program of the first task
                all.back().insert(path.stem() == "main" ? all.back().begin() : all.back().end(), path);
            else
                all.push_back({path});
        }
        std::vector<std::string> texts;
        for (const auto& modules : all)
            texts.push_back(seedOf(modules));
        return texts;
    }();
    return programs;
}

/// Waits for people and other machines, or looks at the clock of the wall: nothing for runs that are compared.
bool isLeftOut(const std::string& text) {
    for (const syntax::Token& token : syntax::lex(text).tokens) {
        const std::string_view word = std::string_view(text).substr(token.offset, token.length);
        if (fuzz::dependsOnWallTime(word)) return true;
        for (const char* begin :
             {"socket", "egm", "uialpha", "uimsg", "uinum", "uidnum", "uilist", "uimess", "tpread", "spy"})
            if (config::beginsWithName(word, begin)) return true;
    }
    return false;
}

/// A program that is changed and stays valid.
class Mutant {
  public:
    /// False: check refuses the program.
    bool take(const std::string& program) {
        tasks_ = tasksOf(program);
        inputs_ = fuzz::ProgramRunner::inputsOf(tasks_, 1);
        session_.open(inputs_);
        return isValid();
    }
    /// Makes a change, unless check refuses it or the program becomes longer than `maxSize` bytes.
    void change(Random& random, size_t maxSize) {
        const std::optional<fuzz::Edit> edit = fuzz::TreeMutator(session_.program(), random).change();
        if (!edit || text().size() + edit->text.size() > maxSize) return;
        std::string& text = tasks_[edit->task].front();
        std::string changed = text;
        changed.replace(edit->begin, edit->end - edit->begin, edit->text);
        setText(edit->task, changed);
        if (isValid())
            text = changed;
        else
            setText(edit->task, text);
    }
    std::string text() const { return joined(tasks_); }

  private:
    void setText(size_t task, const std::string& text) {
        session_.change(std::make_shared<const SourceFile>(inputs_[task].files.front()->path(), text));
    }
    bool isValid() const {
        const auto all = session_.diagnostics();
        return std::none_of(all.begin(), all.end(), [](const diag::Diagnostic& diagnostic) {
            return diagnostic.severity == diag::Severity::Error;
        });
    }

    sema::Session session_{runner().options()};
    std::vector<sema::TaskInput> inputs_;
    fuzz::TaskTexts tasks_;
};

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned seed) {
    static Mutant mutant;
    Random random(seed);
    std::string program(reinterpret_cast<const char*>(data), size);
    while (below(random, 50) == 0 || program.size() < 20 || isLeftOut(program) || !mutant.take(program))
        program = seeds()[below(random, seeds().size())];
    for (size_t n = 1 + below(random, 16); n > 0; --n)
        mutant.change(random, maxSize);
    program = mutant.text().substr(0, maxSize);
    std::memcpy(data, program.data(), program.size());
    return program.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string program = fuzz::bytesOf(data, size);
    if (!isLeftOut(program)) fuzz::tryTasks(runner(), tasksOf(program), 1, size % 2 == 0);
    return 0;
}
