// Backups of controllers and what real ones hold in store: one case for each of their traps.

#include "frontend/diag/messages/projects.h"
#include "frontend/project/backinfo.h"
#include "frontend/project/project.h"
#include "frontend/project/system_parameters.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

using namespace rapid;
using namespace rapid::project;
namespace fs = std::filesystem;

const char* const kModule = "MODULE m\nENDMODULE\n";
const char* const kSystem = "SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n"
                            "      -Name \"T_ROB1\" -Type \"NORMAL\" -MotionTask \n\n"
                            "      -Name \"T_BG\" -Entry \"bgmain\"\n";

/// A backup on disk and what the loader makes of it.
class Backup {
  public:
    void write(const std::string& name, const std::string& text) const {
        const fs::path path = folder_.path / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
    }
    void load(const std::string& part = "") {
        loadProject({(folder_.path / part).string()}, {}, project, sink);
    }
    std::string codes() const {
        std::vector<std::string> names;
        for (const diag::Diagnostic& d : sink.all())
            if (d.code != diag::say::BackupOverview.code && d.code != diag::say::TaskOverview.code)
                names.push_back(diag::codeName(d.code));
        std::sort(names.begin(), names.end());
        std::string out;
        for (const std::string& name : names)
            out += (out.empty() ? "" : " ") + name;
        return out;
    }
    /// Names of the files of a task, "?" before those that are missing.
    std::string modules(size_t task) const {
        std::string out;
        for (const auto& file : project.tasks.at(task).files)
            out += (out.empty() ? "" : " ") + fs::path(file->path()).filename().string();
        for (const std::string& name : project.tasks.at(task).missingModules)
            out += (out.empty() ? "?" : " ?") + name;
        return out;
    }
    std::string message(diag::Code code) const {
        for (const diag::Diagnostic& d : sink.all())
            if (d.code == code) return d.message;
        return "";
    }
    std::string path() const { return folder_.path.string(); }

    ProjectInput project;
    diag::Sink sink;

  private:
    TemporaryFolder folder_;
};

} // namespace

TEST_CASE("backinfo.txt of RobotWare 5 and 6 is understood", "[project][backup]") {
    const BackupInfo info =
        readBackupInfo("#\n# Generated backup file, do not edit.\n#\n>>SYSTEM_ID:\nCell 7\n\n"
                       ">>PRODUCTS_ID:\nRobotWare Version: 5.15.03\nTracker Version: 2.1\n\n"
                       "  616-1 PC Interface\n\tIRB 2600-20/1.65\n\n>>HOME:\nAll files\n\n"
                       ">>TASK1: (T_ROB1,Cell program,)\r\nSYSMOD/User.sys @ user.sys\r\n"
                       "PROGMOD\\Main 1.mod @ main 1.mod HIDDEN\r\n\r\n"
                       ">>task2: (T_BG,,)\n>>EOF:\nPROGMOD/x.mod @ \n");
    CHECK(info.systemId == "Cell 7");
    CHECK(info.robotWare == "5.15.03");
    CHECK(info.addIns == std::vector<std::string>{"Tracker 2.1"});
    CHECK(readBackupInfo(">>PRODUCTS_ID:\nRobotControl Version: 7.8.0\nRobotOS Version: 3.1\n").robotWare ==
          "7.8.0");
    CHECK(readBackupInfo(">>PRODUCTS_ID:\nRobotOS Version: 3.1\n").addIns.empty());
    CHECK(info.options == std::vector<std::string>{"616-1 PC Interface", "IRB 2600-20/1.65"});
    REQUIRE(info.tasks.size() == 2);
    CHECK(info.tasks[0].folder == "TASK1");
    CHECK(info.tasks[0].name == "T_ROB1");
    CHECK(info.tasks[0].program == "Cell program");
    REQUIRE(info.tasks[0].modules.size() == 2);
    CHECK(info.tasks[0].modules[0].file == "User.sys");
    CHECK(info.tasks[0].modules[1].folder == "PROGMOD");
    CHECK(info.tasks[0].modules[1].file == "Main 1.mod");
    CHECK(info.tasks[1].name == "T_BG");
    CHECK(info.tasks[1].modules.empty()); // what follows >>EOF: belongs to no task
}

TEST_CASE("anything at all may stand in backinfo.txt", "[project][backup]") {
    for (const char* text :
         {"", ">>", ">>TASK", ">>TASK1", ">>TASK1:", ">>TASK1: (", ">>TASK1: (,)", ">>TASKX: (a,)",
          "PROGMOD/a.mod @", ">>TASK1: (a,)\n@\n/\nPROGMOD/ @ x", "\r\r\n\xFF\xFE>>SYSTEM_ID:"}) {
        const BackupInfo info = readBackupInfo(text);
        for (const ListedTask& task : info.tasks)
            CHECK(task.modules.empty());
    }
}

TEST_CASE("SYS.cfg defines tasks and the modules loaded into them", "[project][backup]") {
    const TaskParameters parameters = readTaskParameters(
        "SYS:CFG_1.0:5:0::\r\n#\r\nCAB_TASKS:\r\n\r\n      -Name \"T_ROB1\" -Type \"normal\" "
        "-MotionTask \r\n      -Name \"T_UI\" -Type \"STATIC\" -Entry \"Main\"\\\r\n"
        "      -TrustLevel \"None\"\r\n#\r\nCAB_TASK_MODULES:\r\n\r\n"
        "      -File \"RELEASE:/options/Screen.sys\" -AllTask  -Hidden \r\n"
        "      -File \"HOME:/x.sys\" -ModName \"Other\" -Task \"T_UI\" -Shared \r\n");
    REQUIRE(parameters.tasks.size() == 2);
    CHECK(parameters.tasks[0].type == "NORMAL");
    CHECK(parameters.tasks[0].motion);
    CHECK(parameters.tasks[0].entry == "main");
    CHECK(parameters.tasks[1].type == "STATIC");
    CHECK(parameters.tasks[1].entry == "Main");
    CHECK_FALSE(parameters.tasks[1].motion);
    REQUIRE(parameters.modules.size() == 2);
    CHECK(parameters.modules[0].name == "Screen");
    CHECK(parameters.modules[0].allTasks);
    CHECK(parameters.modules[1].name == "Other");
    CHECK(parameters.modules[1].task == "T_UI");
    CHECK(parameters.modules[1].shared);
}

TEST_CASE("a backup brings its tasks", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt",
                 ">>SYSTEM_ID:\nx\n>>PRODUCTS_ID:\nRobotWare Version: 7.10\n\n"
                 "  623-1 Multitasking\n>>TASK1: (T_ROB1,Prog,)\nPROGMOD/main.mod @ \n"
                 "SYSMOD/user.sys @ \nSYSMOD/secret.sys @ \n>>TASK2: (T_BG,,)\n>>EOF:\n");
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK1/SYSMOD/user.sys", kModule);
    backup.write("RAPID/TASK1/SYSMOD/secret.sys", std::string("\xFC\x01\x00\x02", 4));
    backup.write("RAPID/TASK2/PROGMOD/bg.mod", kModule);
    backup.write("HOME/notes.txt", "x");
    backup.load();
    CHECK(backup.codes() == "RAP6027");
    REQUIRE(backup.project.tasks.size() == 2);
    CHECK(backup.project.tasks[0].name == "T_ROB1");
    CHECK(backup.project.tasks[0].type == "NORMAL");
    CHECK(backup.project.tasks[0].incomplete);
    CHECK(backup.modules(0) == "main.mod user.sys ?secret.sys");
    CHECK(backup.project.tasks[1].name == "T_BG");
    CHECK(backup.project.tasks[1].type == "SEMISTATIC");
    CHECK(backup.project.tasks[1].entry == "bgmain");
    CHECK_FALSE(backup.project.tasks[1].incomplete);
    CHECK_FALSE(backup.project.tasks[1].optional);
    CHECK(backup.project.configFiles == std::vector<std::string>{backup.path() + "/SYSPAR/SYS.cfg"});
    CHECK(backup.project.robotWareOptions == std::vector<std::string>{"623-1 Multitasking"});
    CHECK(backup.project.homeFolder == backup.path() + "/HOME");
    CHECK(backup.message(diag::say::BackupOverview.code) ==
          "backup of system 'x', RobotWare 7.10: 2 tasks, 0 signals; no SYSPAR/EIO.cfg: its signals are not "
          "known");
    CHECK(backup.message(diag::say::TaskOverview.code) ==
          "task 'T_ROB1': NORMAL, motion, entry 'main': 2 modules; 1 encrypted (secret.sys); names that no "
          "module "
          "declares may be declared there");
}

TEST_CASE("a task of an option is in backinfo.txt, but not in CAB_TASKS", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\n>>TASK2: (SC_CBC,,)\n");
    backup.write("SYSPAR/SYS.cfg",
                 "SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name \"T_ROB1\" -Type \"NORMAL\"\n");
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK2/SYSMOD/user.sys", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6052");
    CHECK(backup.project.tasks.at(1).name == "SC_CBC");
    CHECK(backup.project.tasks.at(1).type == "SEMISTATIC");
    CHECK(backup.project.tasks.at(1)
              .optional); // without an entry routine it does not stand in the way of a run
    CHECK_FALSE(backup.project.tasks.at(0).optional);
}

TEST_CASE("a task of an option without modules is one warning", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\n>>TASK2: (SC_CBC,,)\nSYSMOD/user.sys @ \n");
    backup.write("SYSPAR/SYS.cfg",
                 "SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name \"T_ROB1\" -Type \"NORMAL\"\n#\n"
                 "CAB_TASK_MODULES:\n\n      -File \"HOME:/user.sys\" -AllTask \n");
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK1/SYSMOD/user.sys", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6057");
    CHECK(
        backup.message(diag::say::TaskLeftOut.code) ==
        "task 'SC_CBC' is left out: the backup has no modules for it, an option of the controller makes it");
    CHECK(backup.project.tasks.size() == 1);
}

TEST_CASE("a task may live in HOME alone", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/main.mod @ \n");
    backup.write("SYSPAR/SYS.cfg", std::string(kSystem) + "\n      -Name \"T_LOST\"\n#\nCAB_TASK_MODULES:\n\n"
                                                          "      -File \"HOME:/bg.mod\" -Task \"T_BG\"\n\n"
                                                          "      -File \"HOME:/all.sys\" -AllTask \n");
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("HOME/bg.mod", kModule);
    backup.write("HOME/all.sys", kModule); // does not make a task of T_LOST
    backup.load();
    CHECK(backup.codes() == "RAP6053");
    REQUIRE(backup.project.tasks.size() == 2);
    CHECK(backup.project.tasks[1].name == "T_BG");
    CHECK(backup.project.tasks[1].entry == "bgmain");
    CHECK(backup.modules(1) == "bg.mod all.sys");
}

TEST_CASE("a missing module is reported once", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt",
                 ">>TASK1: (T_ROB1,,)\nPROGMOD\\main.mod @ \nSYSMOD\\USER.sys @ user.sys\n"
                 "SYSMOD\\LINKEDM.sys @ HIDDEN\n");
    backup.write("SYSPAR/SYS.cfg", "SYS:CFG_1.0:6:0::\n#\nCAB_TASK_MODULES:\n\n"
                                   "      -File \"HOME:/user.sys\" -ModName \"user\" -AllTask \n");
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6055 RAP6059"); // RAP6059: hidden modules cannot be copied
    CHECK(backup.message(diag::say::SystemModuleNotSaved.code).find("'LINKEDM' of task 'T_ROB1'") !=
          std::string::npos);
    CHECK(backup.modules(0) == "main.mod ?USER.sys ?LINKEDM.sys");
}

TEST_CASE("a listed module whose ending has changed is the same module", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/Main.mod @ \nSYSMOD/main.sys @ \n"
                                          "PROGMOD/Lost.mod @ \n");
    backup.write("RAPID/TASK1/PROGMOD/Main.modx", kModule);
    backup.write("RAPID/TASK1/PROGMOD/Lost.txt", "");
    backup.write("RAPID/TASK1/SYSMOD/Main.sysx", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6055");
    CHECK(backup.modules(0) == "Main.modx Main.sysx ?Lost.mod");
}

TEST_CASE("a backup that has lost its RAPID folder still says what was in it", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>SYSTEM_ID:\nCell 7\n>>TASK1: (T_ROB1,,)\nPROGMOD/a.mod @ \n");
    backup.write("SYSPAR/SYS.cfg",
                 "SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name \"T_ROB1\" -Type \"NORMAL\"\n");
    backup.load();
    CHECK(backup.codes() == "RAP6022 RAP6055 RAP6057");
    CHECK(backup.message(diag::say::BackupOverview.code) ==
          "backup of system 'Cell 7': 1 task, 0 signals; no SYSPAR/EIO.cfg: its signals are not known");
    CHECK(backup.project.tasks.empty());
}

TEST_CASE("the effect of missing system parameters is reported", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>SYSTEM_ID:\nCell 7\n>>TASK1: (T_ROB1,,)\nPROGMOD/a.mod @ \n");
    backup.write("RAPID/TASK1/PROGMOD/a.mod", kModule);
    backup.load();
    CHECK(backup.message(diag::say::BackupOverview.code) ==
          "backup of system 'Cell 7': 1 task, 0 signals; no SYSPAR/SYS.cfg: type, entry and start-up modules "
          "of the tasks are not known; no SYSPAR/EIO.cfg: its signals are not known");
}

TEST_CASE("the program of a backup alone is not asked for system parameters", "[project][backup]") {
    Backup backup;
    backup.write("RAPID/TASK1/PROGMOD/a.mod", kModule);
    backup.load();
    CHECK(backup.message(diag::say::BackupOverview.code) == "backup: 1 task, 0 signals");
}

TEST_CASE("of a folder with two backups each is named", "[project][backup]") {
    Backup backup;
    for (const char* name : {"monday", "tuesday"}) {
        const std::string one = name;
        backup.write(one + "/BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/a.mod @ \n");
        backup.write(one + "/RAPID/TASK1/PROGMOD/a.mod", kModule);
        backup.write(one + "/HOME/lib/b.mod", kModule);
    }
    backup.load();
    CHECK(backup.message(diag::say::FolderWithoutModules.code)
              .ends_with("there are some in '" + backup.path() + "/monday', '" + backup.path() +
                         "/tuesday': name one of these"));
}

TEST_CASE("names in a backup differ in case from the files", "[project][backup]") {
    Backup backup;
    backup.write("backinfo/BackInfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/MainModule.mod @ \n");
    backup.write("syspar/sys.CFG", kSystem);
    backup.write("Rapid/Task1/ProgMod/mainmodule.MOD", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6053"); // T_BG has no folder
    CHECK(backup.project.tasks.at(0).type == "NORMAL");
    CHECK(backup.modules(0) == "mainmodule.MOD");
}

TEST_CASE("modules of add-ins and of RobotWare are not saved", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\n");
    backup.write("SYSPAR/SYS.cfg",
                 "SYS:CFG_1.0:6:0::\n#\nCAB_TASK_MODULES:\n\n"
                 "      -File \"HOME:/USER.sys\" -AllTask \n\n"
                 "      -File \"HOME:/lib/tools.sys\" -Task \"t_rob1\"\n\n"
                 "      -File \"HOME:/../outside.sys\" -Task \"T_ROB1\"\n\n"
                 "      -File \"STATEMACHINE:/RAPID/Core.sysx\" -ModName \"TRobMain\" -AllMotionTask \n\n"
                 "      -File \"STATEMACHINE:/RAPID/Core.sysx\" -ModName \"TRobCore\" -AllTask \n\n"
                 "      -File \"RELEASE:/options/Screen.sys\" -AllTask  -Hidden \n");
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK1/SYSMOD/user.sys", kModule);
    backup.write("HOME/Lib/Tools.SYS", kModule);
    backup.write("outside.sys", kModule);
    backup.load();
    CHECK(backup.modules(0) == "main.mod user.sys Tools.SYS ?outside ?TRobCore ?Screen");
    CHECK(backup.codes() == "RAP6054 RAP6054 RAP6059");
    CHECK(backup.project.tasks.at(0).incomplete);
    CHECK(backup.message(diag::say::SystemModuleNotSaved.code).find("'Screen' of task 'T_ROB1'") !=
          std::string::npos);
}

TEST_CASE("what backinfo.txt lists and what is there are compared", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/a.mod @ \nPROGMOD/lost.mod @ \n");
    backup.write("RAPID/TASK1/PROGMOD/a.mod", kModule);
    backup.write("RAPID/TASK1/PROGMOD/b.mod", "MODULE b\nENDMODULE\n");
    backup.write("RAPID/TASK1/PROGMOD/old.mod",
                 "%%%\n VERSION:1\n%%%\nMODULE A\nENDMODULE\n"); // an older a.mod
    backup.load();
    CHECK(backup.codes() == "RAP6055 RAP6056 RAP6056");
    CHECK(backup.modules(0) == "a.mod b.mod ?lost.mod");
    CHECK(backup.project.tasks.at(0).type == "NORMAL"); // no SYS.cfg
}

TEST_CASE("modules that are installed for all tasks belong to each of them", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt",
                 ">>TASK0: (SHARED,,)\nSYSMOD/all.sys @ \n>>TASK1: (T_ROB1,,)\n>>TASK2: (T_BG,,)\n");
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK0/SYSMOD/all.sys", kModule);
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK2/PROGMOD/main.mod", kModule); // the same module in two tasks is two files
    backup.load();
    CHECK(backup.codes().empty());
    REQUIRE(backup.project.tasks.size() == 2);
    CHECK(backup.modules(0) == "main.mod all.sys");
    CHECK(backup.modules(1) == "main.mod all.sys");
    CHECK(backup.project.tasks[0].files[1] == backup.project.tasks[1].files[1]);
    CHECK(backup.project.tasks[0].files[0] != backup.project.tasks[1].files[0]);
}

TEST_CASE("a task of which nothing can be read is left out", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\n>>TASK2: (T_BG,,)\nPROGMOD/x.mod @ \n");
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK2/PROGMOD/x.mod", "\xFE\x01\x02\x03\x04\x05");
    backup.load();
    CHECK(backup.codes() == "RAP6027 RAP6057");
    CHECK(backup.message(diag::say::TaskLeftOut.code) ==
          "task 'T_BG' is left out: all its modules are encrypted");
    REQUIRE(backup.project.tasks.size() == 1);
}

TEST_CASE("a folder of a task without a module is one warning", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_ROB1,,)\nPROGMOD/main.mod @ \n");
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK7/PROGMOD/readme.txt", "");
    backup.load();
    CHECK(backup.codes() == "RAP6053 RAP6057"); // RAP6053: T_BG
    CHECK(backup.message(diag::say::TaskLeftOut.code) ==
          "task 'TASK7' is left out: the backup has no modules for it");
}

TEST_CASE("without backinfo.txt the folders are the tasks of CAB_TASKS", "[project][backup]") {
    Backup backup;
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK2/PROGMOD/bg.mod", kModule);
    backup.write("RAPID/TASK1/PROGMOD/main.mod", kModule);
    backup.write("RAPID/TASK10/PROGMOD/more.mod", kModule);
    backup.load();
    CHECK(backup.codes() == "RAP6052 RAP6058");
    REQUIRE(backup.project.tasks.size() == 3);
    CHECK(backup.project.tasks[0].name == "T_ROB1");
    CHECK(backup.project.tasks[1].name == "T_BG");
    CHECK(backup.project.tasks[1].entry == "bgmain");
    CHECK(backup.project.tasks[2].name == "TASK10");
    CHECK_FALSE(backup.project.robotWareOptions.has_value());

    Backup flat; // PROGMOD and SYSMOD without a folder of the task
    flat.write("RAPID/PROGMOD/main.mod", kModule);
    flat.write("RAPID/SYSMOD/user.sys", kModule);
    flat.load();
    CHECK(flat.codes() == "RAP6058");
    REQUIRE(flat.project.tasks.size() == 1);
    CHECK(flat.project.tasks[0].name == "T_ROB1");
    CHECK(flat.modules(0) == "main.mod user.sys");
}

TEST_CASE("the motion task comes first, and the robot may be known from the options only",
          "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt",
                 ">>PRODUCTS_ID:\nRobotWare Version: 6.08\n\n  Drive System IRB 120/140\n"
                 "  IRB 1660ID-4/1.55\n>>TASK1: (T_BG,,)\n>>TASK2: (T_ROB1,,)\n");
    backup.write("SYSPAR/SYS.cfg", kSystem);
    backup.write("RAPID/TASK1/PROGMOD/bg.mod", kModule);
    backup.write("RAPID/TASK2/PROGMOD/main.mod", kModule);
    backup.load();
    CHECK(backup.project.tasks.at(0).name == "T_ROB1");
    CHECK(backup.project.tasks.at(1).name == "T_BG");
    CHECK(backup.project.robot == "IRB 1660ID-4/1.55");
    backup.write(
        "SYSPAR/MOC.cfg",
        "MOC:CFG_1.0:6:0::\n#\nROBOT:\n\n      -name \"ROB_1\" -use_robot_type \"ROB1_1660ID_1.55_4\"\n");
    backup.project = {};
    backup.load();
    CHECK(backup.project.robot.empty()); // MOC.cfg names it
}

TEST_CASE("the RAPID folder of a backup means the backup, task folders alone are one", "[project][backup]") {
    Backup backup;
    backup.write("BACKINFO/backinfo.txt", ">>TASK1: (T_LEFT,,)\n>>TASK2: (T_RIGHT,,)\n");
    backup.write("RAPID/TASK1/PROGMOD/a.mod", kModule);
    backup.write("RAPID/TASK2/PROGMOD/b.mod", kModule);
    for (const char* part : {"RAPID", "RAPID/", "RAPID/.", "RAPID/TASK1/.."}) {
        backup.project = {};
        backup.load(part);
        REQUIRE(backup.project.tasks.size() == 2);
        CHECK(backup.project.tasks[1].name == "T_RIGHT");
    }
    Backup alone;
    alone.write("task1/ProgMod/a.mod", kModule);
    alone.write("task2/ProgMod/b.mod", kModule);
    alone.load();
    REQUIRE(alone.project.tasks.size() == 2); // not one task that has two modules of one name
    CHECK(alone.modules(1) == "b.mod");
}

TEST_CASE("a folder around one backup means the backup", "[project][backup]") {
    Backup around;
    around.write("Cell_Backup_2024-03-11/RAPID/TASK1/PROGMOD/main.mod", kModule);
    around.write("readme.txt", "x");
    around.load();
    CHECK(around.project.isBackup);
    CHECK(around.modules(0) == "main.mod");
}

TEST_CASE("an encrypted module is one note, and what it declares is not known", "[project][backup]") {
    Backup folder; // a plain folder
    folder.write("a.mod", kModule);
    folder.write("b.sys", "\xFC\x10\x11\x12\x13\x14\x15");
    folder.write("umlaut.mod", "\xFC"
                               "ber\nMODULE u\nENDMODULE\n"); // a Latin-1 text is none
    folder.load();
    CHECK(folder.codes() == "RAP6027");
    CHECK(folder.sink.all().at(0).severity == diag::Severity::Note);
    CHECK(folder.modules(0) == "a.mod umlaut.mod ?b.sys");
    CHECK(folder.project.tasks.at(0).incomplete);

    Backup only;
    only.write("b.sys", "\xFC\x10\x11\x12\x13\x14\x15");
    only.load();
    CHECK(only.codes() == "RAP6027"); // and not "no module is given"
}
