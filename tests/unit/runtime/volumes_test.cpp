// Manual 1.16: whatever a path looks like and whatever links there are, a program reaches its volumes only.

#include "runtime/host/volumes.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>

#include <atomic>
#include <filesystem>
#include <random>
#include <string>
#include <thread>

using namespace rt;
namespace fs = std::filesystem;

namespace {

struct Disks {
    TemporaryFolder folder;
    Volumes volumes;

    Disks() {
        fs::create_directories(folder.path / "home" / "sub" / "deep");
        fs::create_directories(folder.path / "outside");
        folder.write("outside/secret", "secret");
        folder.write("home/file", "file");
        folder.write("home/sub/file", "file");
        std::string error;
        REQUIRE(volumes.open((folder.path / "home").string(), error));
    }

    void link(const std::string& target, const std::string& name) const {
        fs::create_symlink(target, folder.path / "home" / name);
    }

    /// Whether the file that a path leads to was opened, and whether it is the one outside.
    enum class Reached { Nothing, Inside, Outside };
    Reached reach(const std::string& path) {
        VolumePlace place;
        if (!volumes.locate(path, Volumes::LastLink::Follow, place).empty()) return Reached::Nothing;
        const Descriptor file(
            ::openat(place.folder.number(), place.name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
        struct stat status{}, secret{};
        if (!file.isOpen() || ::fstat(file.number(), &status) != 0) return Reached::Nothing;
        if (::stat((folder.path / "outside" / "secret").c_str(), &secret) != 0) return Reached::Nothing;
        const bool isOutside = status.st_ino == secret.st_ino || isFolderOutside(status);
        return isOutside ? Reached::Outside : Reached::Inside;
    }

    bool isFolderOutside(const struct stat& status) const {
        struct stat other{};
        for (const fs::path& path : {folder.path, folder.path / "outside"})
            if (::stat(path.c_str(), &other) == 0 && other.st_ino == status.st_ino) return true;
        return false;
    }
};

} // namespace

TEST_CASE("volumes: places are found, and what leads out of a volume is not", "[volumes]") {
    Disks disks;
    disks.link("sub", "inside");
    disks.link("../outside", "out");
    disks.link(fs::path("/").string(), "root");
    disks.link("inside/../../outside/secret", "twice");
    VolumePlace place;
    const auto find = [&](std::string_view path) {
        place = {};
        return disks.volumes.locate(path, Volumes::LastLink::Follow, place);
    };
    CHECK(find("HOME:/inside/file").empty());
    CHECK(place.name == "file");
    CHECK(find("HOME:").empty());
    CHECK(place.name == ".");
    CHECK(find("new").empty());
    CHECK(place.name == "new");
    for (const char* path : {"..", "out/secret", "root/etc/passwd", "twice", "sub/../../home/file"}) {
        INFO(path);
        CHECK_FALSE(find(path).empty());
        CHECK(place.leaves);
    }
    for (const std::string& path : {std::string("none/file"), std::string("file/x"), std::string("a\0b", 3),
                                    std::string(256, 'x'), std::string("USB1:file")}) {
        INFO(path);
        CHECK_FALSE(find(path).empty());
        CHECK_FALSE(place.leaves);
    }
}

TEST_CASE("volumes: the last link is kept for those who remove it", "[volumes]") {
    Disks disks;
    disks.link("../outside/secret", "link");
    VolumePlace place;
    CHECK(disks.volumes.locate("link", Volumes::LastLink::Keep, place).empty());
    CHECK(place.name == "link");
    CHECK_FALSE(disks.volumes.locate("link", Volumes::LastLink::Follow, place).empty());
}

TEST_CASE("volumes: TEMP: and its like are empty folders that are removed", "[volumes]") {
    std::string path;
    {
        Disks disks;
        for (const char* name : {"TEMP", "ramdisk", "Backup", "DATA"}) {
            INFO(name);
            CHECK(disks.volumes.has(name));
            REQUIRE(disks.volumes.resolve(std::string(name) + ":", path));
            CHECK(fs::is_empty(path));
        }
        CHECK_FALSE(disks.volumes.has("USB1"));
    }
    CHECK_FALSE(fs::exists(path));
}

TEST_CASE("volumes: devices are known by their names", "[volumes]") {
    Disks disks;
    std::string error;
    REQUIRE(disks.volumes.addDevice("com1=HOME:/in,HOME:/out", error));
    REQUIRE(disks.volumes.addDevice("lpt1:=paper", error));
    CHECK(disks.volumes.device("COM1:")->input == "HOME:/in");
    CHECK(disks.volumes.device("com1:")->output == "HOME:/out");
    CHECK(disks.volumes.device("LPT1:")->output == "paper");
    CHECK(disks.volumes.device("lpt1:")->input == "paper");
    CHECK(disks.volumes.device("com2:") == nullptr);
    CHECK(disks.volumes.device("com1") == nullptr);
    for (const char* wrong : {"com2", "=x", "com2=", "HOME=x", "com1=x", "com2=../x", "com2=none/x"}) {
        INFO(wrong);
        CHECK_FALSE(disks.volumes.addDevice(wrong, error));
    }
}

TEST_CASE("volumes: no path of random parts leaves", "[volumes]") {
    Disks disks;
    disks.link("..", "up");
    disks.link("../outside", "out");
    disks.link(disks.folder.path.string(), "absolute");
    disks.link((disks.folder.path / "home").string() + "/../outside", "tricky");
    disks.link("sub/deep", "fine");
    disks.link("up/outside", "chain");
    disks.link("loop", "loop");
    const std::string parts[] = {"..",       ".",       "",
                                 "/",        "\\",      "up",
                                 "out",      "fine",    "sub",
                                 "deep",     "file",    "secret",
                                 "absolute", "tricky",  "chain",
                                 "loop",     "home",    "HOME:",
                                 "TEMP:",    "outside", "...",
                                 "\xFF",     ".. ",     "%2e",
                                 "\xC0\xAE", "..\\",    std::string(1, '\0')};
    std::mt19937 random(17);
    int inside = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string path;
        for (auto count = random() % 8 + 1; count > 0; --count) {
            path += parts[random() % std::size(parts)];
            if (random() % 4 != 0) path += '/';
        }
        const Disks::Reached reached = disks.reach(path);
        INFO(path);
        REQUIRE(reached != Disks::Reached::Outside);
        inside += reached == Disks::Reached::Inside ? 1 : 0;
        std::string host;
        if (disks.volumes.resolve(path, host) && fs::exists(host)) {
            const std::string real = fs::canonical(host).string();
            const bool isHome = real.rfind(disks.volumes.path(), 0) == 0;
            std::string temporary;
            REQUIRE(disks.volumes.resolve("TEMP:", temporary));
            REQUIRE((isHome || real.rfind(temporary, 0) == 0));
        }
    }
    CHECK(inside > 100);
}

TEST_CASE("volumes: links that change while a path is followed lead nowhere outside", "[volumes]") {
    Disks disks;
    std::atomic<bool> done{false};
    // A folder that is a folder at one moment and a link to the outside at the next.
    std::thread changes([&] {
        const fs::path folder = disks.folder.path / "home" / "changes";
        const fs::path aside = disks.folder.path / "home" / "aside",
                       link = disks.folder.path / "home" / "link";
        std::error_code ignored;
        fs::create_directories(aside);
        disks.folder.write("home/aside/secret", "not the secret");
        while (!done) {
            fs::rename(aside, folder, ignored);
            fs::rename(folder, aside, ignored);
            fs::create_symlink("../outside", link, ignored);
            fs::rename(link, folder, ignored);
            fs::remove(folder, ignored);
        }
    });
    int outside = 0;
    for (int round = 0; round < 20000; ++round)
        outside += disks.reach("HOME:changes/secret") == Disks::Reached::Outside ? 1 : 0;
    done = true;
    changes.join();
    CHECK(outside == 0);
}
