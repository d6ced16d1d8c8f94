#include "tools/service/file_volumes.h"
#include "tools/service/folder_work.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fcntl.h>

using namespace rapidc::service;
namespace fs = std::filesystem;

namespace {

struct Bench {
    TemporaryFolder folder;
    FileVolumes volumes;
    Bench() {
        fs::create_directory(folder.path / "home");
        folder.write("secret", "secret");
        REQUIRE(volumes.add("HOME", (folder.path / "home").string()));
    }
    FileProblem write(const std::string& path, const std::string& bytes = "x") const {
        bool isNew = false;
        return volumes.write(path, bytes, isNew).problem;
    }
    std::string read(const std::string& path) const {
        std::string bytes;
        return volumes.read(path, bytes).isDone() ? bytes : std::string("(nothing)");
    }
};

} // namespace

TEST_CASE("a file is replaced as a whole, under any spelling of its volume", "[files]") {
    const Bench bench;
    CHECK(bench.write("$HOME/a.txt", "one") == FileProblem::None);
    CHECK(bench.write("home/a.txt", "two") == FileProblem::None);
    CHECK(bench.read("$home/a.txt") == "two");
    CHECK(bench.write("OTHER/a.txt") == FileProblem::NoPath);
    CHECK(bench.write("$HOME") == FileProblem::Refused);
    CHECK(bench.write("$HOME/none/a.txt") == FileProblem::NoPath);
    std::vector<FileEntry> entries;
    REQUIRE(bench.volumes.list("$HOME", entries).isDone());
    REQUIRE(entries.size() == 1);
    CHECK(entries[0].size == 3);
}

TEST_CASE("no path leaves a volume", "[files]") {
    const Bench bench;
    fs::create_symlink(bench.folder.path / "secret", bench.folder.path / "home" / "file");
    fs::create_symlink(bench.folder.path, bench.folder.path / "home" / "folder");
    fs::create_symlink("..", bench.folder.path / "home" / "up");
    for (const std::string& path :
         {std::string("$HOME/../secret"), std::string("$HOME/file"), std::string("$HOME/folder/secret"),
          std::string("$HOME/up/secret"), std::string("$HOME/a/../../secret"),
          std::string("$HOME/..\\secret"), std::string("$HOME/\0/../../secret", 20)}) {
        INFO(path);
        CHECK(bench.read(path) == "(nothing)");
        CHECK(bench.write(path) != FileProblem::None);
        CHECK_FALSE(bench.volumes.copy(path, "copy", false).isDone());
    }
    for (const char* name : {"..", ".", "", "a/b", "a\\b", "/etc", "a\nb"}) {
        INFO(name);
        CHECK_FALSE(bench.volumes.makeFolder("$HOME", name).isDone());
    }
    std::vector<FileEntry> entries;
    REQUIRE(bench.volumes.list("$HOME", entries).isDone());
    CHECK(entries.empty());
    // a link itself may be removed, and what it leads to stays
    CHECK(bench.volumes.remove("$HOME/folder").isDone());
    CHECK(fs::exists(bench.folder.path / "secret"));
}

TEST_CASE("folders are removed and copied as a whole", "[files]") {
    const Bench bench;
    REQUIRE(bench.volumes.makeFolder("$HOME", "a").isDone());
    REQUIRE(bench.volumes.makeFolder("$HOME/a", "b").isDone());
    CHECK(bench.volumes.makeFolder("$HOME", "a").problem == FileProblem::Exists);
    CHECK(bench.write("$HOME/a/b/c", "deep") == FileProblem::None);
    fs::create_symlink(bench.folder.path / "secret", bench.folder.path / "home" / "a" / "link");
    CHECK(bench.volumes.copy("$HOME/a", "d", false).isDone());
    CHECK(bench.read("$HOME/d/b/c") == "deep");
    CHECK_FALSE(fs::exists(fs::symlink_status(bench.folder.path / "home" / "d" / "link")));
    CHECK(bench.volumes.copy("$HOME/a", "d", false).problem == FileProblem::Exists);
    CHECK(bench.volumes.rename("$HOME/d", "e").isDone());
    CHECK(bench.volumes.rename("$HOME/e", "a").problem == FileProblem::Exists);
    CHECK(bench.volumes.remove("$HOME/a").isDone());
    CHECK(fs::exists(bench.folder.path / "secret"));
    CHECK(bench.volumes.remove("$HOME").problem == FileProblem::Refused);
    CHECK(bench.volumes.remove("$HOME/a").problem == FileProblem::NoPath);
}
