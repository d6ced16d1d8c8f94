// Replacing a file: permissions, links, refusals, and a writer that is killed at random moments.

#include "config/atomic_file.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <iterator>
#include <random>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using rapid::config::replaceFile;

namespace {

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
}

mode_t modeOf(const std::filesystem::path& path) {
    struct stat status{};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

size_t entries(const std::filesystem::path& folder) {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// Writes one of two contents again and again until it is killed.
[[noreturn]] void writeForEver(const std::string& path, const std::string& a, const std::string& b) {
    for (;;)
        if (!replaceFile(path, a).empty() || !replaceFile(path, b).empty()) ::_exit(1);
}

} // namespace

TEST_CASE("a file is replaced and keeps its permissions", "[edit]") {
    const TemporaryFolder folder;
    folder.write("x.mod", "old");
    const std::string path = (folder.path / "x.mod").string();
    REQUIRE(::chmod(path.c_str(), 0640) == 0);
    CHECK(replaceFile(path, std::string("new\0bytes", 9)).empty());
    CHECK(contentOf(path) == std::string("new\0bytes", 9));
    CHECK(modeOf(path) == 0640);
    CHECK(replaceFile(path, "").empty());
    CHECK(contentOf(path).empty());
    CHECK(entries(folder.path) == 1);
}

TEST_CASE("a file that is not there yet is made", "[edit]") {
    const TemporaryFolder folder;
    const std::string path = (folder.path / "new.mod").string();
    CHECK(replaceFile(path, "text").empty());
    CHECK(contentOf(path) == "text");
    const mode_t mask = ::umask(0);
    ::umask(mask);
    CHECK(modeOf(path) == (0666 & ~mask));
}

TEST_CASE("a symbolic link stays and its file is replaced", "[edit]") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path / "far");
    folder.write("far/x.mod", "old");
    std::filesystem::create_symlink("far/x.mod", folder.path / "link.mod");
    CHECK(replaceFile((folder.path / "link.mod").string(), "new").empty());
    CHECK(std::filesystem::is_symlink(folder.path / "link.mod"));
    CHECK(contentOf(folder.path / "far/x.mod") == "new");
}

TEST_CASE("what cannot be replaced is reported and left alone", "[edit]") {
    const TemporaryFolder folder;
    CHECK_THAT(replaceFile(folder.path.string(), "x"), Catch::Contains("not a file"));
    CHECK_THAT(replaceFile((folder.path / "none" / "x.mod").string(), "x"), Catch::Contains("No such file"));
    CHECK(entries(folder.path) == 0);
}

TEST_CASE("a writer killed at any moment leaves old or new content", "[edit][crash]") {
    const TemporaryFolder folder;
    const std::string path = (folder.path / "x.mod").string();
    const std::string a(300000, 'a'), b(200000, 'b');
    REQUIRE(replaceFile(path, a).empty());
    std::mt19937 random(3);
    size_t sawB = 0;
    for (int round = 0; round < 40; ++round) {
        const pid_t writer = ::fork();
        REQUIRE(writer >= 0);
        if (writer == 0) writeForEver(path, a, b);
        ::usleep(static_cast<useconds_t>(random() % 8000));
        REQUIRE(::kill(writer, SIGKILL) == 0);
        int status = 0;
        REQUIRE(::waitpid(writer, &status, 0) == writer);
        REQUIRE(WIFSIGNALED(status)); // otherwise the writer had failed
        const std::string content = contentOf(path);
        REQUIRE((content == a || content == b));
        sawB += content == b;
    }
    INFO(sawB << " of 40 stopped after the second content");
    // The next writer works, whatever lies about.
    CHECK(replaceFile(path, "end").empty());
    CHECK(contentOf(path) == "end");
}
