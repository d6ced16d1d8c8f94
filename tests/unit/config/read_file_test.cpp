// Reading whole files: what is no ordinary file is refused at once.

#include "config/read_file.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

using rapid::config::readFile;

TEST_CASE("a whole file is read, byte for byte", "[project]") {
    const TemporaryFolder folder;
    for (const size_t size : {size_t{0}, size_t{1}, size_t{65535}, size_t{200000}}) {
        std::string text(size, 'x');
        if (size > 1) text[size / 2] = '\0';
        folder.write("a.mod", text);
        std::string bytes = "old";
        CHECK(readFile((folder.path / "a.mod").string(), bytes).empty());
        CHECK(bytes == text);
    }
}

TEST_CASE("pipes, devices, folders and giants are refused", "[project]") {
    const TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder.path / name).string(); };
    std::string bytes;
    CHECK(readFile(at("nowhere.mod"), bytes) == "No such file or directory");
    REQUIRE(::mkfifo(at("pipe.mod").c_str(), 0600) == 0);
    CHECK(readFile(at("pipe.mod"), bytes) == "it is no ordinary file");
    REQUIRE(::symlink("/dev/zero", at("endless.mod").c_str()) == 0);
    CHECK(readFile(at("endless.mod"), bytes) == "it is no ordinary file");
    CHECK(readFile(folder.path.string(), bytes) == "it is a folder");
    folder.write("giant.mod", "MODULE m");
    std::filesystem::resize_file(folder.path / "giant.mod",
                                 rapid::config::kLargestFile + 1); // a hole, no disk space
    CHECK(readFile(at("giant.mod"), bytes) == "it is larger than 1 GB");
}
