// Outputs that would overwrite inputs, sources or each other.

#include "config/output_guard.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

using rapid::config::OutputGuard;

namespace fs = std::filesystem;

TEST_CASE("an output on an input is found under any name", "[edit]") {
    const TemporaryFolder folder;
    folder.write("m.txt", "text");
    const std::string input = (folder.path / "m.txt").string();
    fs::create_hard_link(input, folder.path / "hard");
    fs::create_symlink("m.txt", folder.path / "soft");
    fs::create_directory_symlink(folder.path, folder.path / "again");
    for (const char* name : {"m.txt", "./m.txt", "hard", "soft", "again/again/soft"}) {
        OutputGuard guard;
        guard.reads(input);
        guard.writes((folder.path / name).string(), "-o");
        INFO(name);
        CHECK_THAT(guard.conflict(), Catch::Contains("would overwrite the input"));
    }
    OutputGuard guard;
    guard.reads(input);
    guard.writes((folder.path / "new.txt").string(), "-o");
    guard.writes("", "--trace");
    CHECK(guard.conflict().empty());
}

TEST_CASE("two outputs on one file are found before it exists", "[edit]") {
    const TemporaryFolder folder;
    fs::create_symlink("a.csv", folder.path / "soft");
    for (const char* name : {"a.csv", "./a.csv", "soft", "A.csv"}) {
        OutputGuard guard;
        guard.writes((folder.path / "a.csv").string(), "--trace");
        guard.writes((folder.path / name).string(), "--events");
        INFO(name);
        CHECK_THAT(guard.conflict(), Catch::Contains("are one file"));
    }
    OutputGuard devices;
    devices.writes("/dev/null", "--trace");
    devices.writes("/dev/null", "--events");
    devices.reads("/dev/null");
    CHECK(devices.conflict().empty());
}

TEST_CASE("a source is refused as an output, whether or not it is read", "[edit]") {
    for (const char* name : {"x.mod", "X.MODX", "x.sys", "x.sysx", "x.prg", "x.pgf", "EIO.cfg"}) {
        OutputGuard guard;
        guard.writes(name, "--trace");
        INFO(name);
        CHECK_THAT(guard.conflict(),
                   Catch::Contains("has the name of a module, a program or a configuration"));
    }
}
