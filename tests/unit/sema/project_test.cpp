// Inputs of the command line become tasks: files, folders, program files, backups, and what is wrong with them.

#include "frontend/project/program_file.h"
#include "frontend/project/project.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace rapid;
using namespace rapid::project;
namespace fs = std::filesystem;

/// A folder that is gone after the test.
class Folder {
  public:
    Folder() : path_(fs::temp_directory_path() / ("rapidc_project_" + std::to_string(::getpid()))) {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { fs::remove_all(path_); }
    std::string write(const std::string& name, const std::string& text) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return (path_ / name).string();
    }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }

  private:
    fs::path path_;
};

struct Loaded {
    ProjectInput project;
    diag::Sink sink;
    bool ok = false;
    std::vector<std::string> codes() const {
        std::vector<std::string> out;
        for (const diag::Diagnostic& d : sink.all())
            out.push_back(diag::codeName(d.code));
        return out;
    }
    std::vector<std::string> files(size_t task) const {
        std::vector<std::string> out;
        for (const auto& file : project.tasks.at(task).files)
            out.push_back(fs::path(file->path()).filename().string());
        return out;
    }
};

std::unique_ptr<Loaded> load(const std::vector<std::string>& inputs,
                             const std::vector<TaskSpec>& tasks = {}) {
    auto loaded = std::make_unique<Loaded>();
    loaded->ok = loadProject(inputs, tasks, loaded->project, loaded->sink);
    return loaded;
}

using Names = std::vector<std::string>;
const char* const kEmptyModule = "MODULE m\nENDMODULE\n";

} // namespace

TEST_CASE("files and folders make up the main task", "[project]") {
    const Folder folder;
    folder.write("b.modx", kEmptyModule);
    folder.write("A.SYS", kEmptyModule);
    folder.write("c.prg", kEmptyModule);
    folder.write("notes.txt", "nothing");
    folder.write("EIO.cfg", "EIO:CFG_1.0:6:0::\n");
    folder.write("SYSPAR/SYS.cfg", "SYS:CFG_1.0:6:0::\n");
    const auto all = load({folder.path()});
    CHECK(all->ok);
    REQUIRE(all->project.tasks.size() == 1);
    CHECK(all->project.tasks[0].name == "T_ROB1");
    CHECK(all->files(0) == Names{"A.SYS", "b.modx", "c.prg"});
    CHECK(all->project.configFiles == Names{folder / "EIO.cfg", folder / "SYSPAR/SYS.cfg"});

    const auto two = load({folder / "c.prg", folder / "b.modx", folder / "EIO.cfg"});
    CHECK(two->files(0) == Names{"c.prg", "b.modx"});
    CHECK(two->project.configFiles == Names{folder / "EIO.cfg"});
}

TEST_CASE("a file that is named twice is read once", "[project]") {
    const Folder folder;
    folder.write("main.modx", kEmptyModule);
    const auto loaded =
        load({folder.path(), folder / "../" + fs::path(folder.path()).filename().string() + "/main.modx"});
    CHECK(loaded->ok);
    CHECK(loaded->codes() == Names{"RAP6010"});
    CHECK(loaded->files(0) == Names{"main.modx"});
}

TEST_CASE("a folder without modules of its own means those of its subfolders", "[project]") {
    const Folder folder;
    folder.write("PROGMOD/main.mod", kEmptyModule);
    folder.write("SYSMOD/user.sys", kEmptyModule);
    const auto loaded = load({folder.path()});
    CHECK(loaded->ok);
    CHECK(loaded->files(0) == Names{"main.mod", "user.sys"});
}

TEST_CASE("more tasks are named with their type", "[project]") {
    const Folder folder;
    folder.write("main.modx", kEmptyModule);
    folder.write("side.modx", kEmptyModule);
    const auto loaded = load({folder / "main.modx"}, {{"T_SIDE", "STATIC", {folder / "side.modx"}}});
    CHECK(loaded->ok);
    REQUIRE(loaded->project.tasks.size() == 2);
    CHECK(loaded->project.tasks[1].name == "T_SIDE");
    CHECK(loaded->project.tasks[1].type == "STATIC");
    CHECK(loaded->files(1) == Names{"side.modx"});
}

TEST_CASE("a program file lists its modules", "[project]") {
    const Folder folder;
    const std::string program = folder.write(
        "job.pgf", "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\r\n<Program>\r\n"
                   "\t<Module>Main.MOD</Module>\r\n\t<Module> A&amp;B.mod </Module>\r\n</Program>");
    folder.write("main.mod", kEmptyModule);
    folder.write("A&B.mod", kEmptyModule);
    const auto loaded = load({program});
    CHECK(loaded->ok);
    CHECK(loaded->files(0) == Names{"main.mod", "A&B.mod"});

    const std::string moved = folder.write("moved.pgf", "<Program><Module>C:\\Cell\\MAIN.mod</Module>"
                                                        "<Module>HOME:A&amp;B.mod</Module>"
                                                        "<Module>pr\xFC"
                                                        "f.mod</Module></Program>");
    folder.write("Pr\xFC"
                 "f.mod",
                 kEmptyModule); // ISO 8859-1
    CHECK(load({moved})->codes().empty());
    CHECK(load({moved})->files(0) == Names{"main.mod", "A&B.mod",
                                           "Pr\xFC"
                                           "f.mod"});

    const std::string missing = folder.write("bad.pgf", "<Program><Module>none.mod</Module></Program>");
    CHECK(load({missing})->codes() == Names{"RAP6025"});
    const std::string junk = folder.write("junk.pgf", "hello");
    CHECK(load({junk})->codes() == Names{"RAP6024"});
    const std::string empty = folder.write("empty.pgf", "<Program></Program>");
    CHECK(load({empty})->codes() == Names{"RAP6024"});
}

TEST_CASE("a pipe among the modules of a folder is reported and not waited for", "[project]") {
    const Folder folder;
    folder.write("a.modx", "MODULE a\nENDMODULE\n");
    REQUIRE(::mkfifo((folder / "b.modx").c_str(), 0600) == 0);
    const auto loaded = load({folder.path()});
    CHECK(loaded->codes() == std::vector<std::string>{"RAP6021"});
    CHECK(loaded->files(0) == std::vector<std::string>{"a.modx"});
}

TEST_CASE("what cannot be used is named with its remedy", "[project]") {
    const Folder folder;
    folder.write("empty/readme.txt", "x");
    CHECK(load({folder / "none.modx"})->codes() == Names{"RAP6020"});
    CHECK(load({folder / "empty"})->codes() == Names{"RAP6022"});
    folder.write("deep/a/b/c.modx", kEmptyModule);
    CHECK(load({folder / "deep"})->codes() == Names{"RAP6022"}); // which says where they are
    CHECK(load({folder / "empty/readme.txt"})->codes() == Names{"RAP6023"});
    CHECK(load({})->codes() == Names{"RAP6026"});
    CHECK_FALSE(load({folder / "none.modx"})->ok);
    const std::string config = folder.write("EIO.cfg", "EIO:CFG_1.0:6:0::\n");
    CHECK(load({config})->codes() == Names{"RAP6026"});
    folder.write("bare/SYS.cfg",
                 "SYS:CFG_1.0:6:0::\n#\nCAB_TASK_MODULES:\n\n      -File \"HOME:/a.mod\" -AllTask\n");
    const auto bare =
        load({folder / "bare"}); // the modules are not given: the message says where they belong
    REQUIRE(bare->codes() == Names{"RAP6054", "RAP6026"});
    CHECK(bare->sink.all().back().message.find("bare/HOME") != std::string::npos);
    CHECK(load({}, {{"T_A", "NORMAL", {folder.write("one.modx", kEmptyModule)}}})->ok);
    if (::geteuid() != 0) { // root reads everything
        const std::string secret = folder.write("secret.modx", kEmptyModule);
        fs::permissions(secret, fs::perms::none);
        CHECK(load({secret})->codes() == Names{"RAP6021"});
    }
    fs::create_directories(folder / "dir.modx");
    CHECK(load({folder / "dir.modx"})->codes() == Names{"RAP6022"});
    const std::string nothing = folder.write("zero.modx", "");
    CHECK(load({nothing})->ok);
}

TEST_CASE("a folder that cannot be listed is reported, not taken for an empty one", "[project]") {
    const Folder folder;
    folder.write("PROGMOD/a.mod", "MODULE a\nENDMODULE\n");
    folder.write("SYSMOD/b.sys", "MODULE b\nENDMODULE\n");
    // Nothing is closed to the superuser.
    const bool super = ::geteuid() == 0;
    REQUIRE(::chmod((folder / "SYSMOD").c_str(), 0) == 0);
    if (super) REQUIRE(::seteuid(65534) == 0);
    const auto whole = load({folder.path()});
    const auto closed = load({folder / "SYSMOD"});
    if (super) REQUIRE(::seteuid(0) == 0);
    REQUIRE(::chmod((folder / "SYSMOD").c_str(), 0700) == 0);
    CHECK(whole->codes() == std::vector<std::string>{"RAP6021"});
    CHECK(whole->files(0) == std::vector<std::string>{"a.mod"});
    CHECK(closed->codes() == std::vector<std::string>{"RAP6021"});
}
