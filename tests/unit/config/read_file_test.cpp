// Reading whole files: anything but an ordinary file is refused at once.

#include "config/read_file.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using rapid::config::readFile;
using rapid::config::readStream;

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
    CHECK(readFile(at("pipe.mod"), bytes) == "it is a pipe, not an ordinary file");
    REQUIRE(::symlink("/dev/zero", at("endless.mod").c_str()) == 0);
    CHECK(readFile(at("endless.mod"), bytes) == "it is a device, not an ordinary file");
    CHECK(readFile(folder.path.string(), bytes) == "it is a folder");
    folder.write("giant.mod", "MODULE m");
    std::filesystem::resize_file(folder.path / "giant.mod",
                                 rapid::config::kLargestFile + 1); // a hole, no disk space
    CHECK(readFile(at("giant.mod"), bytes) == "it is larger than 1 GB");
}

TEST_CASE("a pipe is read until its writers are gone", "[project]") {
    const TemporaryFolder folder;
    const std::string pipe = (folder.path / "pipe").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const std::string text(200000, 'x'); // more than a pipe holds
    std::thread writer([&] {
        const int file = ::open(pipe.c_str(), O_WRONLY);
        size_t done = 0;
        while (done < text.size())
            done += static_cast<size_t>(::write(file, text.data() + done, text.size() - done));
        ::close(file);
    });
    std::string bytes = "old";
    CHECK(readStream(pipe, bytes).empty());
    writer.join();
    CHECK(bytes == text);
}

TEST_CASE("a pipe without a writer, and an endless device, are given up", "[project]") {
    const TemporaryFolder folder;
    const std::string pipe = (folder.path / "pipe").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    std::string bytes;
    CHECK(readStream(pipe, bytes, 0) == "no program has opened this pipe for writing within 0 s");
    CHECK(readStream("/dev/null", bytes).empty());
    CHECK(readStream(folder.path.string(), bytes) == "it is a folder");
    folder.write("a.csv", "text");
    CHECK(readStream((folder.path / "a.csv").string(), bytes).empty());
    CHECK(bytes == "text");
}
