// Warnings found file by file, while what is inside the routines is forgotten, against those found at the end.

#include "lint_testing.h"

#include "unit/sema/sema_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

namespace {

using namespace rapid;
namespace fs = std::filesystem;

using Files = std::vector<std::shared_ptr<const SourceFile>>;

std::string shown(const diag::Sink& sink) {
    std::string out;
    for (const diag::Diagnostic& d : sink.sorted())
        out += diag::renderText(d, false);
    return out;
}

std::vector<sema::TaskInput> tasksOf(const Files& files, size_t count) {
    std::vector<sema::TaskInput> tasks(count);
    for (size_t i = 0; i < count; ++i) {
        tasks[i].name = "T_" + std::to_string(i + 1);
        tasks[i].files = files;
    }
    return tasks;
}

std::string atTheEnd(const std::vector<sema::TaskInput>& tasks) {
    diag::Sink sink;
    sema::CheckOptions options;
    options.library = sema::testing::library();
    const auto program = sema::check(tasks, options, sink);
    lint::lint(*program, {}, sink);
    return shown(sink);
}

std::string fileByFile(const std::vector<sema::TaskInput>& tasks, size_t& files) {
    diag::Sink sink;
    const lint::WarningLevels levels;
    lint::Lint steps(levels, sink, tasks.size() > 1);
    sema::CheckOptions options;
    options.library = sema::testing::library();
    options.onlyDiagnostics = true;
    options.onFile = [&](const sema::CheckedProgram& program, const sema::Task& task,
                         std::span<sema::Module* const> modules) {
        steps.file(program, task, modules);
        ++files;
    };
    const auto program = sema::check(tasks, options, sink);
    steps.finish(*program);
    for (const auto& task : program->tasks)
        for (const sema::Module* module : task->modules)
            CHECK(module->facts->calls.size() == 0);
    return shown(sink);
}

Files warningPrograms() {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(fs::path(RAPIDC_SOURCE_DIR) / "tests" / "diag" / "8xxx"))
        if (entry.path().extension() == ".modx" || entry.path().extension() == ".sysx")
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    Files files;
    for (const fs::path& path : paths)
        files.push_back(std::make_shared<const SourceFile>(path.filename().string(),
                                                           sema::testing::readFile(path.string())));
    return files;
}

} // namespace

TEST_CASE("warnings are the same file by file as at the end", "[lint]") {
    const Files files = warningPrograms();
    REQUIRE(files.size() > 20);
    for (size_t i = 0; i < files.size(); ++i) {
        // Two at a time: what one file says of the other is judged when both are through.
        const Files two = {files[i], files[(i + 1) % files.size()]};
        INFO(two[0]->path() << " " << two[1]->path());
        const auto tasks = tasksOf(two, 1);
        size_t seen = 0;
        CHECK(fileByFile(tasks, seen) == atTheEnd(tasks));
        CHECK(seen == 2);
    }
    const auto several = tasksOf({files[0], files[1]}, 2);
    size_t seen = 0;
    CHECK(fileByFile(several, seen) == atTheEnd(several));
    CHECK(seen == 4);
}

TEST_CASE("mistakes are the same for who only wants diagnostics", "[lint][slow]") {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RAPIDC_SOURCE_DIR) / "tests" / "diag"))
        if (SourceFile::isLegacyFileType(entry.path().string()) || entry.path().extension() == ".modx")
            paths.push_back(entry.path());
    REQUIRE(paths.size() > 200);
    std::sort(paths.begin(), paths.end());
    for (const fs::path& path : paths) {
        INFO(path);
        const auto tasks = tasksOf({std::make_shared<const SourceFile>(
                                       path.filename().string(), sema::testing::readFile(path.string()))},
                                   1);
        size_t seen = 0;
        CHECK(fileByFile(tasks, seen) == atTheEnd(tasks));
    }
}

TEST_CASE("mistakes in lists of literals are the same for who only wants diagnostics", "[lint]") {
    for (const char* value : {"[1,2,3]", "[1,2]", "[1,2,3,4]", "[1,\"a\",3]", "[1,TRUE,[3]]",
                              "[[1,2,3],[4,5,6]]", "[1,2,-3.5E2]", "[1,\"a\",\"b\"]"}) {
        for (const char* type : {"pos", "num", "nothing", "socketdev", "pos{2}", "num{3}", "string"}) {
            const std::string full = type;
            const size_t brace = full.find('{');
            const std::string name = full.substr(0, brace);
            const std::string dims = brace == std::string::npos ? std::string() : full.substr(brace);
            std::string text = "MODULE m\n";
            for (const char* kind : {"CONST", "LOCAL PERS", "VAR"})
                text += std::string(kind) + " " + name + " d" + std::string(1, kind[0]) + dims +
                        ":=" + value + ";\n";
            text += "PROC main()\nVAR " + name + " local" + dims + ":=" + value + ";\nlocal:=" + value +
                    ";\nlocal:=dC;\nIF local=dC THEN\nlocal:=" + value + ";\nENDIF\nENDPROC\nENDMODULE\n";
            INFO(text);
            const auto tasks = tasksOf({std::make_shared<const SourceFile>("m.modx", text)}, 1);
            size_t seen = 0;
            CHECK(fileByFile(tasks, seen) == atTheEnd(tasks));
        }
    }
}
