// Resources of modules, programs, breakpoints, without HTTP: what serve-contract.md (lines named) and controller.md chapter 2 say of them.

#include "unit/rws/served_controller.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace rapidc::rws;

TEST_CASE("Modules: list, text, changes (controller.md 2.3, serve-contract 36)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.read(kOld, "/rw/rapid/modules?task=T_ROB1", "name", "rap-module-info-li") == "Main1");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/modules", "type", "rap-module-info-li") == "ProgMod");
    const std::string text = "/rw/rapid/modules/Main1?task=T_ROB1&resource=module-text";
    CHECK(served.read(kOld, text, "module-text", "rap-module-text") == kProgram);
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/modules/Main1/text", "module-text") == kProgram);
    CHECK(served.read(
              kNew, "/rw/rapid/tasks/T_ROB1/modules/Main1/text/range?startrow=1&startcol=1&endrow=1&endcol=6",
              "text") == "MODULE");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/modules/Main1/text/search?text=PROC main", "Row") ==
          "14");
    CHECK(served.get(kNew, "/rw/rapid/tasks/T_ROB1/modules/None").failure->code == ReturnCode::NoModule);
    CHECK(served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=unloadmod", {{"module", "None"}}).status == 400);
    CHECK(served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=loadmod", {{"modulepath", "$HOME/none.mod"}})
              .failure->code == ReturnCode::NoLoadPath);
    std::string changed = kProgram;
    changed.replace(changed.find("count := 5"), 10, "count := 9");
    const FieldList body{{"text", changed}};
    CHECK(served
              .post(kOld, "/rw/rapid/modules/Main1?task=T_ROB1&action=set-module-text",
                    {{"text", "MODULE Main1"}})
              .status == 400);
    CHECK(served.read(kOld, text, "module-text") == kProgram);
    CHECK(served.post(kOld, "/rw/rapid/modules/Main1?task=T_ROB1&action=set-module-text", body).status ==
          204);
    CHECK(served.read(kOld, text, "module-text") == changed);
}

TEST_CASE("Loading and unloading modules (serve-contract 36)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    served.writeHome(
        "Extra.mod",
        "MODULE Extra\n   RECORD pair\n      num a;\n      num b;\n   ENDRECORD\n"
        "   PERS pair both := [1,2];\n   LOCAL VAR num table{4};\n   PROC helper()\n   ENDPROC\nENDMODULE\n");
    served.writeHome("Wrong.mod",
                     "MODULE Wrong\n   PROC wrong()\n      unknown := 1;\n   ENDPROC\nENDMODULE\n");
    const auto load = [&](const std::string& path, const std::string& replace) {
        FieldList form{{"modulepath", path}};
        if (!replace.empty()) form.emplace_back("replace", replace);
        return served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=loadmod", form).status;
    };
    const auto modules = [&] {
        const Reply reply = served.get(kOld, "/rw/rapid/modules?task=T_ROB1");
        std::string all;
        for (const Entry& entry : reply.document->entries)
            all += entry.title + " ";
        return all;
    };
    CHECK(load("$HOME/Wrong.mod", "") == 400);
    CHECK(modules() == "Main1 ");
    const Reply first =
        served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=loadmod", {{"modulepath", "$HOME/Extra.mod"}});
    INFO((first.failure ? first.failure->message : ""));
    CHECK(first.status == 204);
    CHECK(modules() == "Main1 Extra ");
    CHECK(load("$HOME/Extra.mod", "") == 400);
    CHECK(load("$HOME/Extra.mod", "true") == 204);
    CHECK(load("HOME:/Extra.mod", "maybe") == 400);
    CHECK(load("$HOME/../Extra.mod", "") == 400);
    // what was loaded is seen like everything else
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/Extra/both.b"), "value") == "2");
    CHECK(served.read(kNew, propertiesPath(kNew, "T_ROB1/Extra/both"), "typurl") ==
          "RAPID/T_ROB1/Extra/pair");
    CHECK(served.read(kNew, propertiesPath(kNew, "T_ROB1/Extra/pair"), "ncom") == "2");
    CHECK(served.read(kNew, propertiesPath(kNew, "T_ROB1/Extra/table"), "dim") == "4");
    CHECK(served.read(kNew, propertiesPath(kNew, "T_ROB1/Extra/helper"), "symtyp") == "prc");
    CHECK(
        served.post(kOld, dataPath(kOld, "T_ROB1/Extra/both") + "?action=set", {{"value", "[3,4]"}}).status ==
        204);
    CHECK(served
              .post(kOld, "/rw/rapid/modules/Extra?task=T_ROB1&action=save",
                    {{"name", "Saved"}, {"path", "$HOME"}})
              .status == 204);
    std::ifstream saved(served.home() / "Saved.mod");
    const std::string text((std::istreambuf_iterator<char>(saved)), {});
    CHECK(text.find("PERS pair both := [3,4];") != std::string::npos);
    CHECK(served
              .post(kOld, "/rw/rapid/modules/Extra?task=T_ROB1&action=save",
                    {{"name", "a/b"}, {"path", "$HOME"}})
              .status == 400);
    CHECK(served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=unloadmod", {{"module", "Extra"}}).status == 204);
    CHECK(modules() == "Main1 ");
}

TEST_CASE("Whole programs are saved and loaded (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const std::string program = "/rw/rapid/tasks/T_ROB1/program";
    CHECK(served.read(kOld, program, "entrypoint", "rap-program") == "main");
    CHECK(served.read(kNew, program, "name") == "Main1");
    CHECK(served.post(kNew, "/rw/mastership/edit/request").status == 204);
    CHECK(served.post(kNew, program + "/name", {{"name", "Shop"}}).status == 204);
    CHECK(served.post(kNew, program + "/save", {{"path", "HOME:/shop"}}).status == 204);
    CHECK(std::filesystem::exists(served.home() / "shop" / "Shop.pgf"));
    CHECK(std::filesystem::exists(served.home() / "shop" / "Main1.modx"));
    served.writeHome(
        "Other.mod",
        "MODULE Other\n   VAR num only := 4;\n   PROC main()\n      Stop;\n   ENDPROC\nENDMODULE\n");
    served.writeHome("Other.pgf", "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" "
                                  "?>\n<Program>\n\t<Module>Other.mod</Module>\n</Program>\n");
    served.writeHome("Bad.pgf", "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" "
                                "?>\n<Program>\n\t<Module>None.mod</Module>\n</Program>\n");
    CHECK(served.post(kNew, program + "/load", {{"progpath", "HOME:/Bad.pgf"}}).status == 400);
    CHECK(served.post(kNew, program + "/load", {{"progpath", "HOME:/Other.pgf"}, {"loadmode", "replace"}})
              .status == 204);
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/modules", "name") == "Other");
    CHECK(served.read(kNew, program, "name") == "Other");
    CHECK(served.read(kNew, dataPath(kNew, "T_ROB1/Other/only"), "value") == "4");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition") == "4,7");
    CHECK(served.post(kNew, program + "/load", {{"progpath", "HOME:/shop/Shop.pgf"}}).status == 204);
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/modules", "name") == "Main1");
}

TEST_CASE("Breakpoints stop the program and stay when it is replaced (serve-contract 31)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const std::string breakpoints = "/rw/rapid/tasks/T_ROB1/program/breakpoints";
    CHECK(served.post(kNew, breakpoints, {{"module", "Main1"}, {"row", "18"}, {"column", "1"}}).status ==
          403);
    CHECK(served.post(kNew, "/rw/mastership/edit/request").status == 204);
    CHECK(served.post(kNew, breakpoints, {{"module", "Main1"}, {"row", "18"}, {"column", "1"}}).status ==
          204);
    CHECK(served.post(kNew, breakpoints, {{"module", "Main1"}, {"row", "1"}, {"column", "1"}}).status == 400);
    CHECK(served.read(kNew, breakpoints, "row", "rap-breakpoint-li") == "18");
    CHECK(served.post(kNew, "/rw/panel/ctrl-state", {{"ctrl-state", "motoron"}}).status == 204);
    CHECK(served.post(kNew, "/rw/rapid/execution/start", {{"stopatbp", "enabled"}}).status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "18,7"));
    REQUIRE(served.waitFor(kNew, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.read(kNew, dataPath(kNew, "T_ROB1/Main1/main/inner"), "value") == "1");
    CHECK(served.call(kNew, Method::Delete, breakpoints + "?module=Main1&row=18&column=1").status == 204);
    CHECK(served.get(kNew, breakpoints).document->entries.empty());
}

TEST_CASE("Positions are modified in memory and in constants (controller.md 2.3)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   CONST robtarget p10 := [[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
   PERS robtarget p20 := [[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
   PROC main()
      MoveJ p10, v100, fine, tool0;
      MoveJ p20, v100, fine, tool0;
      Stop;
   ENDPROC
ENDMODULE
)"}});
    REQUIRE(served.opened());
    const std::string modify = "/rw/rapid/modules/Main1?task=T_ROB1&action=modify-position";
    const std::string before = served.read(kOld, dataPath(kOld, "T_ROB1/p20"), "value");
    CHECK(served.post(kOld, modify, {{"startrow", "7"}}).status == 400);
    CHECK(served.post(kOld, modify, {{"startrow", "6"}}).status == 204);
    const std::string after = served.read(kOld, dataPath(kOld, "T_ROB1/p20"), "value");
    CHECK(after != before);
    CHECK(served.post(kOld, modify, {{"startrow", "5"}}).status == 204);
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/p10"), "value") == after);
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/p20"), "value") ==
          after); // the data survive the new program
}
