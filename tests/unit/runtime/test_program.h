#pragma once
// Hand-written programs for the virtual controller: what codegen emits, as C++ functions.

#include "runtime/abi/rt_abi.h"
#include "runtime/host/controller.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

namespace testing {

inline constexpr rt::StmtDesc kHandled{1, 1, 1, 2, 0, 1, 0, 0, -1};

/// A routine of `lines` statements on lines 1, 2, 3 ...; `handled` of them, from the first, are covered by a handler, to which the
/// others belong.
struct Routine {
    std::vector<rt::StmtDesc> statements;
    std::vector<int32_t> filter;
    rt::RoutineDesc desc{};

    Routine(const char* name, uint32_t lines, uint32_t handled = 0, std::vector<int32_t> errors = {})
        : filter(std::move(errors)) {
        for (uint32_t line = 1; line <= lines; ++line) {
            const bool covered = line <= handled;
            const uint8_t kind = handled > 0 && !covered ? rt::kStmtHandler : rt::kStmtPlain;
            statements.push_back({line, 3, line, 20, kind, static_cast<uint8_t>(covered), 0, 0, -1});
        }
        desc.name = name;
        desc.module = "TestModule";
        desc.file = "test.modx";
        desc.statements = statements.data();
        desc.statementCount = lines;
        desc.hasErrorHandler = handled > 0;
        desc.errorFilter = filter.empty() ? nullptr : filter.data();
        desc.errorFilterCount = static_cast<uint32_t>(filter.size());
    }
};

/// A folder that is gone after the test.
struct TempFolder {
    std::string path;
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "rapidc-test-XXXXXX").string();
        path = mkdtemp(pattern.data());
        path = std::filesystem::canonical(path).string();
    }
    ~TempFolder() { std::filesystem::remove_all(path); }
    std::string file(const std::string& name) const { return path + "/" + name; }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }
    std::string read(const std::string& name) const {
        std::ifstream in(file(name), std::ios::binary);
        std::stringstream text;
        text << in.rdbuf();
        return text.str();
    }
};

/// Runs tasks on a controller that shows nothing; keeps the log for questions.
struct Run {
    std::vector<rt::TaskDesc> tasks;
    std::vector<rt::ExternalDesc> externals;
    rt::RunOptions options;
    rt::ProgramDesc program{};
    std::unique_ptr<rt::Controller> controller;
    rt::ExitStatus status{};

    Run& task(const char* name, rt::EntryFunction entry, const char* type = "NORMAL",
              rt::EntryFunction reset = nullptr) {
        tasks.push_back({name, type, entry, reset, static_cast<uint8_t>(tasks.empty())});
        return *this;
    }
    bool prepare() {
        program.name = "test";
        program.tasks = tasks.data();
        program.taskCount = static_cast<uint32_t>(tasks.size());
        program.externals = externals.data();
        program.externalCount = static_cast<uint32_t>(externals.size());
        controller = std::make_unique<rt::Controller>(options);
        controller->log().setHumanOutput(nullptr);
        controller->panel().setOutput(std::fopen("/dev/null", "w"), std::fopen("/dev/null", "w"));
        controller->panel().setTerminal(false);
        status = controller->prepare(program);
        return status == rt::ExitStatus::Ended;
    }
    rt::ExitStatus run() {
        if (prepare()) status = controller->run();
        return status;
    }
    rt::Time now() const { return controller->scheduler().now(); }
    std::size_t count(rt::EventId id) const {
        std::size_t result = 0;
        for (const rt::Event& event : controller->log().events())
            result += event.number == static_cast<int>(id);
        return result;
    }
    const rt::Event* find(rt::EventId id) const {
        for (const rt::Event& event : controller->log().events()) {
            if (event.number == static_cast<int>(id)) return &event;
        }
        return nullptr;
    }
};

/// Charges instructions as compiled code does at a safepoint.
inline rt::Status charge(rt::TaskCore* task, rt::Frame* frame, int64_t cost) {
    task->budget -= cost;
    return task->budget < 0 ? rt_safepoint(task, frame) : rt::kOk;
}

} // namespace testing
