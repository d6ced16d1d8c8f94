// Names that nothing declares: modules that are missing, RobotWare options, what was probably meant.

#include "sema_testing.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;
using namespace rapid::sema;
using Messages = std::vector<std::string>;

/// Checks one module as the readable part of a task.
std::unique_ptr<testing::Checked> checkBeside(std::vector<std::string> missing, const std::string& text,
                                              bool binary = false, bool configuration = false) {
    auto checked = std::make_unique<testing::Checked>();
    TaskInput task;
    task.files.push_back(std::make_shared<const SourceFile>("work.modx", text));
    if (binary) task.files.push_back(std::make_shared<const SourceFile>("lib/secret.modx", "\xFC\x01\x02"));
    task.missingModules = std::move(missing);
    task.incomplete = !task.missingModules.empty();
    CheckOptions options;
    options.library = testing::library();
    options.configurationKnown = configuration;
    checked->program = check({task}, options, checked->sink);
    return checked;
}

const std::string kUnknown = "MODULE work\n"
                             "  VAR part p;\n"
                             "  VAR intnum irq;\n"
                             "  VAR num counter;\n"
                             "  PROC run()\n"
                             "    pick;\n"
                             "    counter := weight(1);\n"
                             "    IF limit > 1 limit := 2;\n"
                             "    CONNECT irq WITH stopped;\n"
                             "    pick;\n"
                             "  ENDPROC\n"
                             "  PROC run2()\n"
                             "    limit := 3;\n"
                             "    countr := 1;\n"
                             "    MoveL 5;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";

} // namespace

TEST_CASE("what a missing module may declare is a warning that names the module, once a name", "[sema]") {
    const auto checked = checkBeside({"secret.sys"}, kUnknown);
    Messages expected;
    const auto add = [&](const char* place, const char* name, const char* hint = "") {
        expected.push_back(std::string("RAP2009 at ") + place + ": '" + name +
                           "' is not declared here but may be declared in 'secret.sys'" + hint);
    };
    add("2:7", "part");
    add("6:5", "pick");
    add("7:16", "weight");
    add("8:8", "limit");
    add("9:22", "stopped");
    add("14:5", "countr", "; did you mean 'counter'?");
    expected.push_back("RAP4002 at 15:5: missing arguments 'Speed', 'Zone', 'Tool' in call to 'MoveL'");
    Messages found = checked->messages();
    REQUIRE(found.size() == expected.size() + 1); // the 5 is not a robtarget
    for (size_t i = 0; i < expected.size(); ++i) {
        INFO(found[i]);
        CHECK(std::find(found.begin(), found.end(), expected[i]) != found.end());
    }
}

TEST_CASE("several missing modules are listed, many are counted", "[sema]") {
    const std::string text = "MODULE work\n  PROC run()\n    pick;\n  ENDPROC\nENDMODULE\n";
    CHECK(checkBeside({"a.sys", "b.mod"}, text)->messages() ==
          Messages{"RAP2009 at 3:5: 'pick' is not declared here but may be declared in 'a.sys' or 'b.mod'"});
    CHECK(checkBeside({"a", "b", "c", "d", "e"}, text)->messages() ==
          Messages{
              "RAP2009 at 3:5: 'pick' is not declared here but may be declared in 'a', 'b', 'c' or one of 2 "
              "other modules"});
}

TEST_CASE("an encrypted module among the files counts as missing", "[sema]") {
    const auto checked =
        checkBeside({}, "MODULE work\n  PROC run()\n    pick;\n  ENDPROC\nENDMODULE\n", true);
    const Messages found = checked->messages();
    CHECK(std::find(found.begin(), found.end(),
                    "RAP2009 at 3:5: 'pick' is not declared here but may be declared in 'secret.modx'") !=
          found.end());
}

TEST_CASE("a signal that the configuration lacks may be a variable of a missing module", "[sema]") {
    const auto checked = checkBeside(
        {"io.sys"}, "MODULE work\n  PROC run()\n    Set doGrip;\n  ENDPROC\nENDMODULE\n", false, true);
    CHECK(checked->messages() ==
          Messages{"RAP2009 at 3:9: 'doGrip' is not declared here but may be declared in 'io.sys'; if it "
                   "is a signal, define it in EIO.cfg and pass that file with --config"});
}

TEST_CASE("nothing is missing: an unknown name is an error", "[sema]") {
    const auto checked = checkBeside({}, "MODULE work\n  PROC run()\n    pick;\n  ENDPROC\nENDMODULE\n");
    CHECK(checked->codes() == Messages{"RAP2003"});
}

TEST_CASE("a line of unknown words lacks its semicolon, or an exclamation mark before it", "[sema]") {
    const std::string text = "MODULE m\n  PROC main()\n    see below\n    Stop;\n  ENDPROC\nENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    REQUIRE(checked->messages() == Messages{"RAP1201 at 3:14: missing ';' after 'below'"});
    REQUIRE(checked->sink.all()[0].notes.size() == 1);
    CHECK(checked->sink.all()[0].notes[0].message == "if this is a remark, put '!' before it");
}

TEST_CASE("an interrupt variable that is not declared is one mistake", "[sema]") {
    const std::string text = "MODULE m\n  PROC main()\n    CONNECT missed WITH onEvent;\n  ENDPROC\n  TRAP "
                             "onEvent\n    Stop;\n  ENDTRAP\nENDMODULE\n";
    CHECK(testing::checkTexts({text})->messages() == Messages{"RAP2001 at 3:13: 'missed' is not declared"});
}

TEST_CASE("a built-in names the RobotWare option that the controller lacks", "[sema]") {
    const std::string text = "MODULE work\n"
                             "  VAR wztemporary zone;\n"
                             "  PROC run()\n"
                             "    WZDisable zone;\n"
                             "    WZEnable zone;\n"
                             "    WZDisable zone;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto codesWith = [&](std::optional<std::vector<std::string>> installed) {
        CheckOptions options;
        options.robotWareOptions = std::move(installed);
        return testing::checkTexts({text}, options)->messages();
    };
    CHECK(codesWith(std::nullopt).empty()); // nothing is known about the controller
    CHECK(codesWith(std::vector<std::string>{"608-1 World Zones", "623-1 Multitasking"}).empty());
    CHECK(codesWith(std::vector<std::string>{"608-1 world zone"}).empty());
    CHECK(
        codesWith(std::vector<std::string>{"623-1 Multitasking"}) ==
        Messages{
            "RAP4025 at 4:5: 'WZDisable' needs the RobotWare option 'World Zones', which this controller "
            "does "
            "not have",
            "RAP4025 at 5:5: 'WZEnable' needs the RobotWare option 'World Zones', which this controller does "
            "not have"});
}

TEST_CASE("one of several options is enough", "[sema]") {
    const std::string text = "MODULE work\n"
                             "  VAR rmqslot slot;\n"
                             "  PROC run()\n"
                             "    RMQFindSlot slot, \"RMQ_T_ROB2\";\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto count = [&](const char* installed) {
        CheckOptions options;
        options.robotWareOptions = {installed};
        return testing::checkTexts({text}, options)->messages().size();
    };
    CHECK(count("616-1 RobotStudio Connect") == 0);
    CHECK(count("623-1 Multitasking") == 0);
    CHECK(count("608-1 World Zones") == 1);
}

TEST_CASE("an option brings others along", "[sema]") {
    const auto count = [&](const char* installed, const std::string& line) {
        CheckOptions options;
        options.robotWareOptions = {installed};
        const std::string text = "MODULE work\n  PERS sensor mate := [2, [0,0], 0];\n  PROC run()\n    " +
                                 line + "\n  ENDPROC\nENDMODULE\n";
        const Messages codes = testing::checkTexts({text}, options)->codes();
        return std::count(codes.begin(), codes.end(), "RAP4025");
    };
    // Externally Guided Motion includes the Robot Reference Interface.
    CHECK(count("689-1 Externally Guided Motion (EGM)", "SiConnect mate;") == 0);
    CHECK(count("3124-1 Externally Guided Motion", "SiClose mate;") == 0);
    CHECK(count("608-1 World Zones", "SiConnect mate;") == 1);
    // MultiMove has several tasks.
    CHECK(count("604-1 MultiMove Coordinated", "RMQEmptyQueue;") == 0);
    CHECK(count("616-1 PC Interface", "RMQEmptyQueue;") == 0);
    CHECK(count("608-1 World Zones", "RMQEmptyQueue;") == 1);
    CHECK(count("612-1 Path Offset", "CorrClear;") == 0);
    CHECK(count("689-1 Externally Guided Motion (EGM)", "CorrClear;") == 1);
}

TEST_CASE("a persistent that tasks share has one type: records are compared by their components", "[sema]") {
    const auto module = [](const char* components, const char* scope = "") {
        return std::string("MODULE work\n  RECORD part\n") + components + "  ENDRECORD\n  " + scope +
               "PERS part shared := [1,2];\nENDMODULE\n";
    };
    const auto codes = [&](const std::string& a, const std::string& b) {
        return testing::checkTasks({{a}, {b}})->codes();
    };
    const std::string xy = module("    num x;\n    num y;\n");
    CHECK(codes(xy, xy).empty());
    CHECK(codes(xy, module("    num X;\n    num Y;\n")).empty());
    CHECK(codes(xy, module("    num x;\n    dnum y;\n")) == Messages{"RAP6004"});
    CHECK(codes(xy, module("    num x;\n    num z;\n")) == Messages{"RAP6004"});
    CHECK(codes(xy, module("    num x;\n    dnum y;\n", "TASK ")).empty());
    CHECK(codes(xy, module("    num x;\n    dnum y;\n", "LOCAL ")).empty());
}

TEST_CASE("names of well-known add-ins are distinguished from mistakes", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  TASK PERS menudata md:=[\"\",1];\n"
                             "  CONST be_device dev:=[TRUE];\n"
                             "  PROC main()\n"
                             "    Hand_Xylophones\\holdForce:=10,\\NoWait;\n"
                             "    Hand_Xylophones;\n"
                             "    BESetupToolJ dev;\n"
                             "    hand_openn;\n"
                             "    BESetup;\n"
                             "    md.x:=1;\n"
                             "  ENDPROC\n"
                             "  PROC hand_open()\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    const auto message = [](const char* place, const char* name, const char* addIn) {
        return std::string("RAP2009 at ") + place + ": '" + name +
               "' is not declared here but may be declared in the add-in " + addIn;
    };
    CHECK(
        checked->messages() ==
        Messages{
            message("2:13", "menudata", "Production Manager"), message("3:9", "be_device", "BullsEye"),
            message("5:5", "Hand_Xylophones", "SmartGripper (YuMi)"),
            message("7:5", "BESetupToolJ", "BullsEye"),
            "RAP2003 at 8:5: 'hand_openn' is not a known procedure or instruction; did you mean 'hand_open'?",
            "RAP2003 at 9:5: 'BESetup' is not a known procedure or instruction"});
}

TEST_CASE("data that an add-in's template modules declare may be declared there", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  PROC main()\n"
                             "    FOR i FROM 1 TO MaxNoSources DO\n"
                             "      IF ItmSrcData{i}.Used PickPlaceRunning:=TRUE;\n"
                             "    ENDFOR\n"
                             "    MaxNoSource:=1;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    const auto addIn = [](const char* place, const char* name) {
        return std::string("RAP2009 at ") + place + ": '" + name +
               "' is not declared here but may be declared in the add-in PickMaster";
    };
    CHECK(checked->messages() == Messages{addIn("3:21", "MaxNoSources"), addIn("4:10", "ItmSrcData"),
                                          addIn("4:29", "PickPlaceRunning"),
                                          "RAP2001 at 6:5: 'MaxNoSource' is not declared"});
}

TEST_CASE("data types, constants and errors of options are distinguished from mistakes", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  VAR pm_targetdata goal;\n"
                             "  PROC main()\n"
                             "    CSSAct CSS_Z;\n"
                             "    PmGetGoal goal;\n"
                             "    CyclicBrakeCheck;\n"
                             "  ERROR\n"
                             "    IF ERRNO = AW_TRACK_ERR OR ERRNO = CAP_TRACK_ERR RETRY;\n"
                             "    IF ERRNO = ERR_MT_HOME TRYNEXT;\n"
                             "    IF ERRNO = SMEQDATA OR ERRNO = PAINT_ERR TRYNEXT;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto addIn = [](const char* place, const char* name, const char* declaredIn) {
        return std::string("RAP2009 at ") + place + ": '" + name +
               "' is not declared here but may be declared in the add-in " + declaredIn;
    };
    const char* const palletizing = "PickMaster palletizing (Palletizing PowerPac)";
    CHECK(testing::checkTexts({text})->messages() ==
          Messages{addIn("2:7", "pm_targetdata", palletizing), addIn("4:5", "CSSAct", "SoftMove"),
                   addIn("4:12", "CSS_Z", "SoftMove"), addIn("5:5", "PmGetGoal", palletizing),
                   addIn("6:5", "CyclicBrakeCheck", "Brake Check and SafeMove (service routines)"),
                   addIn("8:16", "AW_TRACK_ERR", "RobotWare Arc"),
                   addIn("8:40", "CAP_TRACK_ERR", "Continuous Application Platform"),
                   addIn("9:16", "ERR_MT_HOME", "RobotWare Machine Tending"),
                   addIn("10:16", "SMEQDATA", "RobotWare Spot"),
                   addIn("10:36", "PAINT_ERR", "RobotWare Paint")});
}

TEST_CASE("results of BullsEye, names of other releases, data types only where one is expected", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  VAR toolno tool_no;\n"
                             "  VAR bool found;\n"
                             "  VAR num result;\n"
                             "  PROC main()\n"
                             "    DitherAct \\MechUnit:=ROB_1, 1;\n"
                             "    DitherDeact;\n"
                             "    found:=ASFMu_Clear();\n"
                             "    IF result = BESuccess OR result = BEBeamOriFail result:=BECheckErr;\n"
                             "    MoveLIN_FB 1;\n"
                             "    toolno:=1;\n"
                             "    result:=BESucces;\n"
                             "    DitherActive;\n"
                             "  ERROR\n"
                             "    IF ERRNO = ERR_CSV_INDEX TRYNEXT;\n"
                             "    IF ERRNO = ERR_MOD_NOTLOADED TRYNEXT;\n"
                             "    IF ERRNO = ERR_DIVZRO TRYNEXT;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto declaredIn = [](const char* place, const char* name, const char* where) {
        return std::string("RAP2009 at ") + place + ": '" + name +
               "' is not declared here but may be declared in " + where;
    };
    const char* const release = "another release of RobotWare";
    const char* const seams = "the add-in of the Servo-Robot seam finder";
    CHECK(testing::checkTexts({text})->messages() ==
          Messages{declaredIn("2:7", "toolno", "the add-in Tool Changing"),
                   declaredIn("6:5", "DitherAct", release), declaredIn("7:5", "DitherDeact", release),
                   declaredIn("8:12", "ASFMu_Clear", seams),
                   declaredIn("9:17", "BESuccess", "the add-in BullsEye"),
                   declaredIn("9:39", "BEBeamOriFail", "the add-in BullsEye"),
                   declaredIn("9:61", "BECheckErr", "the add-in BullsEye"),
                   declaredIn("10:5", "MoveLIN_FB", "the modules of the Volkswagen standard"),
                   "RAP2001 at 11:5: 'toolno' is not declared; did you mean 'tool_no'?",
                   "RAP2001 at 12:13: 'BESucces' is not declared",
                   "RAP2003 at 13:5: 'DitherActive' is not a known procedure or instruction",
                   declaredIn("15:16", "ERR_CSV_INDEX", release),
                   declaredIn("16:16", "ERR_MOD_NOTLOADED", release),
                   "RAP2001 at 17:16: 'ERR_DIVZRO' is not declared; did you mean 'ERR_DIVZERO'?"});
}

TEST_CASE("AliasIO takes a configured signal of the type of its partner", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  VAR signaldo alias_do;\n"
                             "  PROC main()\n"
                             "    AliasIO doLock, alias_do;\n"
                             "    SetDO doLock, 1;\n"
                             "    WaitDI doLock, 1;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    CHECK(testing::checkTexts({text})->codes() == Messages{"RAP4021", "RAP4011"});
}

// Manual 1.1.5: only the parentheses of a procedure can be taken away and leave an instruction.
TEST_CASE("a call with parentheses is one message, about what is called", "[sema]") {
    const auto checked = testing::checkTexts(
        {"MODULE m\n  VAR num n;\n  PROC main()\n    CRobT();\n    onChange();\n    n();\n    own(1, 2);\n"
         "    two(1, 2);\n    two(\"1\", 2);\n    missing(1, 2);\n  ENDPROC\n  TRAP onChange\n  ENDTRAP\n"
         "  FUNC num own(num a, num b)\n    RETURN a + b;\n  ENDFUNC\n"
         "  PROC two(num a, num b)\n  ENDPROC\nENDMODULE\n"});
    CHECK(checked->codes() == std::vector<std::string>{"RAP2023", "RAP2026", "RAP2021", "RAP2023", "RAP1110",
                                                       "RAP1110", "RAP4011", "RAP2003", "RAP1110"});
}

// Manual 1.3.1: the range of num. An unknown name is looked for in all files, and what they compare it with is evaluated.
TEST_CASE("a number beyond num is reported once, in its own file, when constants of others are evaluated in between",
          "[sema]") {
    const auto checked = testing::checkTexts({"MODULE one\n"
                                              "  PROC first()\n"
                                              "    TPWrite \"\" \\Num:=5e40;\n"
                                              "    TPWrite \"\" \\Num:=unknown;\n"
                                              "  ENDPROC\n"
                                              "ENDMODULE\n",
                                              "MODULE two\n"
                                              "  CONST num slots := 2;\n"
                                              "  VAR num wide{slots};\n"
                                              "ENDMODULE\n",
                                              "MODULE three\n"
                                              "  PROC third(num count)\n"
                                              "    IF other = slots RETURN;\n"
                                              "    IF other = wide{1} RETURN;\n"
                                              "  ENDPROC\n"
                                              "ENDMODULE\n"});
    size_t found = 0;
    for (const diag::Diagnostic& d : checked->sink.sorted()) {
        if (diag::codeName(d.code) != "RAP3036") continue;
        ++found;
        CHECK(d.message == "number 5e40 is out of range for num: use dnum");
        REQUIRE(d.file);
        CHECK(d.file->text().substr(d.range.begin, d.range.end - d.range.begin) == "5e40");
    }
    CHECK(found == 1);
}
