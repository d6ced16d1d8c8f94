// Temporary files and folders: who removes which.

#include "config/temporary.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using rapid::config::removeLeftovers;
using rapid::config::removeLeftoversBelow;
using rapid::config::removeLeftoversBeside;

namespace fs = std::filesystem;

namespace {

std::vector<std::string> entriesOf(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

TEST_CASE("a temporary file takes the place of its target or goes", "[edit]") {
    const ::TemporaryFolder folder;
    {
        rapid::config::TemporaryFile file;
        REQUIRE(file.make(folder.path, "x.mod") == 0);
        CHECK(entriesOf(folder.path).size() == 1);
        removeLeftovers(folder.path); // this process lives
        CHECK(entriesOf(folder.path).size() == 1);
        REQUIRE(file.renameTo(folder.path / "x.mod") == 0);
    }
    CHECK(entriesOf(folder.path) == std::vector<std::string>{"x.mod"});
    {
        rapid::config::TemporaryFile file;
        REQUIRE(file.make(folder.path, "y.mod") == 0);
        rapid::config::TemporaryFolder inside;
        REQUIRE(inside.makeBeside(folder.path, std::string(255, 'n')) == 0); // a name has at most 255 bytes
        CHECK(entriesOf(folder.path).size() == 3);
    }
    CHECK(entriesOf(folder.path) == std::vector<std::string>{"x.mod"});
}

TEST_CASE("what a killed process leaves is removed, files of other programs stay", "[edit][crash]") {
    const ::TemporaryFolder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        rapid::config::TemporaryFile file;
        rapid::config::TemporaryFolder inside;
        if (file.make(folder.path, "x.mod") != 0 || inside.makeBeside(folder.path, "x") != 0) ::_exit(1);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(entriesOf(folder.path).size() == 2);
    for (const char* name : {".x.mod.aB3dE6.tmp", ".x.mod.swp", "rapidc-notes.tmp", "x.mod",
                             ".rapidc-1-abcdef.tmp", ".x.rapidc-1-abc.tmp", ".x.rapidc-a-abcdef.tmp"})
        folder.write(name, "");
    const auto before = entriesOf(folder.path).size();
    removeLeftoversBeside({(folder.path / "x.mod").string(), (folder.path / "y.mod").string()});
    CHECK(entriesOf(folder.path).size() == before - 2);
}

TEST_CASE("leftovers are removed in all folders below, as far as it is allowed to look", "[edit][crash]") {
    const ::TemporaryFolder folder;
    const auto inner = folder.path / "a" / "b";
    REQUIRE(std::filesystem::create_directories(inner));
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        rapid::config::TemporaryFile top, deep;
        rapid::config::TemporaryFolder half;
        if (top.make(folder.path, "x.mod") != 0 || deep.make(inner, "y.mod") != 0 ||
            half.makeBeside(inner, "backup") != 0)
            ::_exit(1);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(entriesOf(inner).size() == 2);
    removeLeftoversBelow(folder.path, 1); // the folder itself
    CHECK(entriesOf(folder.path) == std::vector<std::string>{"a"});
    CHECK(entriesOf(inner).size() == 2);
    removeLeftoversBelow(folder.path, 100);
    CHECK(entriesOf(inner).empty());
    removeLeftoversBelow(folder.path / "none", 100);
}
