// The resources around RAPID, without HTTP: what serve-contract.md (lines named) and controller.md chapter 2 say of them.

#include "unit/rws/served_controller.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace rapidc::rws;

namespace {

constexpr const char* kProgram = R"(MODULE Main1
   RECORD part
      string name;
      pos place;
   ENDRECORD
   CONST num size := 3;
   PERS num count := 5;
   PERS string text := "abc";
   VAR bool flag := TRUE;
   LOCAL VAR num list{size} := [1,2,3];
   VAR num grid{2,3} := [[1,2,3],[4,5,6]];
   VAR part one := ["x",[1,2,3]];
   PERS robtarget p10 := [[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
   PROC main()
      VAR num inner;
      inner := 1;
      count := inner + 4;
      work;
      Stop;
   ENDPROC
   PROC work()
      flag := FALSE;
      flag := TRUE;
   ENDPROC
   FUNC num twice(num value)
      RETURN 2 * value;
   ENDFUNC
ENDMODULE
)";

const FieldList kModules{{"Main1.mod", kProgram}};
constexpr Dialect kOld = Dialect::V1, kNew = Dialect::V2;

std::string dataPath(Dialect dialect, const std::string& symbol) {
    return dialect == kOld ? "/rw/rapid/symbol/data/RAPID/" + symbol
                           : "/rw/rapid/symbol/RAPID/" + symbol + "/data";
}
std::string propertiesPath(Dialect dialect, const std::string& symbol) {
    return dialect == kOld ? "/rw/rapid/symbol/properties/RAPID/" + symbol
                           : "/rw/rapid/symbol/RAPID/" + symbol + "/properties";
}

} // namespace

TEST_CASE("Values of data, elements and components (serve-contract 28, 35)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto value = [&](const std::string& symbol) {
        const std::string old = served.read(kOld, dataPath(kOld, symbol), "value", "rap-data");
        CHECK(served.read(kNew, dataPath(kNew, symbol), "value", "rap-data") == old);
        return old;
    };
    CHECK(value("T_ROB1/Main1/count") == "5");
    CHECK(value("T_ROB1/count") == "5");
    CHECK(value("T_ROB1/Main1/text") == "\"abc\"");
    CHECK(value("T_ROB1/Main1/flag") == "TRUE");
    CHECK(value("T_ROB1/Main1/size") == "3");
    CHECK(value("T_ROB1/Main1/list") == "[1,2,3]");
    CHECK(value("T_ROB1/Main1/list{3}") == "3");
    CHECK(value("T_ROB1/Main1/grid{2,3}") == "6");
    CHECK(value("T_ROB1/Main1/grid{2}") == "[4,5,6]");
    CHECK(value("T_ROB1/Main1/one.place.y") == "2");
    CHECK(value("T_ROB1/Main1/one{2,3}") == "3");
    CHECK(value("T_ROB1/Main1/p10") ==
          "[[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]");
    CHECK(served.get(kOld, dataPath(kOld, "T_ROB1/NoMod/x")).status == 400);
    CHECK(served.get(kOld, dataPath(kOld, "T_ROB1/NoMod/x")).failure->code == ReturnCode::NotFound);
    CHECK(served.get(kNew, dataPath(kNew, "T_ROB1/Main1/x")).failure->code == ReturnCode::UnknownSymbol);
    CHECK(served.get(kOld, dataPath(kOld, "T_ROB1/Main1/list{4}")).status == 400);
}

TEST_CASE("Writing data: all or nothing (serve-contract 35)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto write = [&](const std::string& symbol, const std::string& value) {
        return served.post(kOld, dataPath(kOld, symbol) + "?action=set", {{"value", value}}).status;
    };
    const auto value = [&](const std::string& symbol) {
        return served.read(kOld, dataPath(kOld, symbol), "value");
    };
    CHECK(write("T_ROB1/Main1/count", "7") == 204);
    CHECK(value("T_ROB1/Main1/count") == "7");
    CHECK(write("T_ROB1/Main1/list{2}", "-1.5") == 204);
    CHECK(write("T_ROB1/Main1/one.place", "[7,8,9]") == 204);
    CHECK(write("T_ROB1/Main1/grid", "[[1,1,1],[2,2,2]]") == 204);
    CHECK(value("T_ROB1/Main1/list") == "[1,-1.5,3]");
    CHECK(value("T_ROB1/Main1/one") == "[\"x\",[7,8,9]]");
    CHECK(value("T_ROB1/Main1/grid{2,1}") == "2");
    CHECK(write("T_ROB1/Main1/count", "\"a\"") == 400);
    CHECK(write("T_ROB1/Main1/flag", "1") == 400);
    CHECK(write("T_ROB1/Main1/list", "[1,2,3,4]") == 400);
    CHECK(write("T_ROB1/Main1/list", "[1,2]") == 400);
    CHECK(write("T_ROB1/Main1/text", '"' + std::string(80, 'a') + '"') == 204);
    CHECK(write("T_ROB1/Main1/text", '"' + std::string(81, 'b') + '"') == 400);
    CHECK(value("T_ROB1/Main1/text") == '"' + std::string(80, 'a') + '"');
    CHECK(write("T_ROB1/Main1/size", "4") == 403);
    CHECK(value("T_ROB1/Main1/size") == "3");
    CHECK(value("T_ROB1/Main1/list") == "[1,-1.5,3]");
}

TEST_CASE("Properties, types and components (serve-contract 28, 29)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto span = [&](Dialect dialect, const std::string& symbol, const std::string& name,
                          const std::string& type) {
        return served.read(dialect, propertiesPath(dialect, symbol), name, type);
    };
    CHECK(span(kOld, "T_ROB1/Main1/count", "symtyp", "rap-symproppers") == "per");
    CHECK(span(kOld, "T_ROB1/Main1/flag", "symtyp", "rap-sympropvar") == "var");
    CHECK(span(kOld, "T_ROB1/Main1/size", "symtyp", "rap-sympropconst") == "con");
    CHECK(span(kNew, "T_ROB1/Main1/size", "symtyp", "rap-sympropconstant") == "con");
    CHECK(span(kNew, "T_ROB1/Main1/twice", "symtyp", "rap-sympropfunc") == "fun");
    CHECK(span(kNew, "T_ROB1/Main1/main", "symtyp", "rap-sympropproc") == "prc");
    CHECK(span(kNew, "T_ROB1/Main1/list", "dim", "") == "3");
    CHECK(span(kNew, "T_ROB1/Main1/list", "ndim", "") == "1");
    CHECK(span(kNew, "T_ROB1/Main1/list", "local", "") == "true");
    CHECK(span(kNew, "T_ROB1/Main1/size", "rdonly", "") == "true");
    CHECK(span(kNew, "T_ROB1/Main1/grid", "dim", "") == "2 3");
    CHECK(span(kNew, "T_ROB1/Main1/count", "typurl", "") == "RAPID/num");
    CHECK(span(kNew, "T_ROB1/Main1/one", "typurl", "") == "RAPID/T_ROB1/Main1/part");
    CHECK(span(kNew, "num", "symtyp", "rap-sympropatomic") == "atm");
    CHECK(span(kNew, "robtarget", "ncom", "rap-symproprecord") == "4");
    CHECK(span(kNew, "errnum", "typurl", "rap-sympropalias") == "RAPID/num");
    CHECK(span(kNew, "T_ROB1/Main1/part", "ncom", "rap-symproprecord") == "2");
    // the components of a type by search, as the SDK looks for them
    const Reply reply =
        served.post(kNew, "/rw/rapid/symbols/search",
                    {{"view", "block"}, {"blockurl", "RAPID/T_ROB1/Main1/part"}, {"symtyp", "rcp"}});
    REQUIRE(reply.document);
    REQUIRE(reply.document->entries.size() == 2);
    CHECK(reply.document->entries[0].type == "rap-sympropreccomp-li");
    CHECK(reply.document->entries[1].title == "RAPID/T_ROB1/Main1/part/place");
    CHECK(ServedController::spanOf(reply, "typurl") == "RAPID/string");
}

TEST_CASE("Searching symbols (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto names = [&](FieldList form) {
        form.insert(form.begin(), {"view", "block"});
        const Reply reply = served.post(kOld, "/rw/rapid/symbols?action=search-symbols", form);
        std::string all;
        if (!reply.document) return std::string("?");
        for (const Entry& entry : reply.document->entries)
            all += entry.values[1].second + " ";
        return all;
    };
    CHECK(names({{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "per"}}) == "count text p10 ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "per"}, {"dattyp", "num"}}) == "count ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1/Main1"}, {"symtyp", "var"}, {"recursive", "FALSE"}}) ==
          "flag list grid one ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "any"}, {"regexp", "c.*"}}) == "count ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "prc"}, {"symtyp", "fun"}}) == "main work twice ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1/Main1/main"}, {"symtyp", "any"}}) == "inner ");
    CHECK(names({{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "wrong"}}) == "?");
    CHECK(names({{"blockurl", "RAPID/T_ROB1/None"}}) == "?");
    const Reply page = served.post(kNew, "/rw/rapid/symbols/search?limit=2",
                                   {{"blockurl", "RAPID/T_ROB1"}, {"symtyp", "per"}});
    CHECK(page.document->entries.size() == 2);
    CHECK(page.document->next == "symbols/search?start=2&limit=2");
}

TEST_CASE("Execution, tasks and pointers (controller.md 2.3, serve-contract 25)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.read(kOld, "/rw/rapid/execution", "ctrlexecstate", "rap-execution") == "stopped");
    CHECK(served.read(kOld, "/rw/rapid/tasks", "type", "rap-task-li") == "norm");
    CHECK(served.read(kOld, "/rw/rapid/tasks", "excstate", "rap-task-li") == "read");
    CHECK(served.read(kNew, "/rw/rapid/tasks", "type", "rap-task-li") == "normal");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1", "motiontask", "rap-task") == "TRUE");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "pcp-info") == "16,7");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "endposition", "pcp-info") == "16,17");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "modulemame", "pcp-info") == "Main1");
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {}).failure->code ==
          ReturnCode::StartRefused);
    CHECK(served.post(kOld, "/rw/panel/ctrlstate?action=setctrlstate", {{"ctrl-state", "motoron"}}).status ==
          204);
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "wrong"}}).status == 400);
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "continue"}, {"cycle", "once"}})
              .status == 204);
    REQUIRE(served.waitFor(kOld, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.read(kOld, "/rw/rapid/execution", "cycle") == "once");
    CHECK(served.read(kNew, "/rw/rapid/tasks", "excstate") == "stopped");
    CHECK(served.post(kOld, "/rw/rapid/execution?action=resetpp").status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "16,7"));
    CHECK(served
              .post(kOld, "/rw/rapid/tasks/T_ROB1/pcp?action=set-pp-routine",
                    {{"module", "Main1"}, {"routine", "work"}})
              .status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "routinename", "work"));
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition") == "22,7");
    CHECK(served
              .post(kOld, "/rw/rapid/tasks/T_ROB1/pcp?action=set-pp-cursor",
                    {{"module", "Main1"}, {"line", "18"}})
              .status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "18,7"));
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "stepin"}}).status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "22,7"));
}

TEST_CASE("Mastership: one table for both dialects (serve-contract 37, 38)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const std::string speed = "/rw/panel/speedratio?action=setspeedratio";
    const auto set = [&](Dialect dialect, uint64_t session) {
        return served.post(dialect, speed, {{"speed-ratio", "50"}}, session);
    };
    CHECK(set(kOld, 1).status == 204);
    CHECK(set(kNew, 2).failure->code == ReturnCode::NoMastership);
    CHECK(set(kNew, 2).status == 403);
    CHECK(served.read(kNew, "/rw/mastership/edit", "mastership", "msh-resource") == "nomaster");
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 204);
    CHECK(set(kNew, 2).status == 204);
    CHECK(served.read(kOld, "/rw/mastership/cfg", "mastership") == "remote");
    CHECK(served.read(kOld, "/rw/mastership/rapid", "mastership") == "remote");
    CHECK(served.read(kOld, "/rw/mastership/motion", "mastership") == "nomaster");
    CHECK(set(kOld, 1).failure->code == ReturnCode::HeldByOther);
    CHECK(served.post(kOld, "/rw/mastership/rapid?action=request", {}, 1).failure->code ==
          ReturnCode::HeldByOther);
    CHECK(served.post(kOld, "/rw/mastership?action=request", {}, 1).status == 403);
    served.onController([&] { served.services().sessionEnded(2); });
    CHECK(served.post(kOld, "/rw/mastership/rapid?action=request", {}, 1).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 403);
    served.onController([&] { served.services().connectionClosed(1); }); // RWS 1.0: ends with the connection
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/release", {}, 2).status == 204);
    const std::string id = ServedController::spanOf(
        served.post(kNew, "/rw/mastership/edit/request-with-id", {}, 2), "mastership-id");
    served.onController([&] { served.services().sessionEnded(2); });
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 3).status == 403);
    CHECK(served.post(kNew, "/rw/mastership/edit/release-with-id", {{"mastershipid", "1"}}, 3).status == 400);
    CHECK(served.post(kNew, "/rw/mastership/edit/release-with-id", {{"mastershipid", id}}, 3).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 3).status == 204);
}

TEST_CASE("Manual mode: changes need the privilege (serve-contract 39)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto write = [&] {
        return served.post(kOld, dataPath(kOld, "T_ROB1/count") + "?action=set", {{"value", "1"}}).status;
    };
    CHECK(served.post(kOld, "/rw/panel/opmode", {{"opmode", "man"}}).status == 204);
    CHECK(served.read(kOld, "/rw/panel/opmode", "opmode", "pnl-opmode") == "MANR");
    CHECK(served.read(kNew, "/rw/panel/ctrl-state", "ctrlstate") == "motoroff");
    CHECK(write() == 403);
    CHECK(served.post(kOld, "/users/rmmp", {{"privilege", "modify"}}).status == 202);
    CHECK(served.read(kOld, "/users/rmmp/poll", "status", "user-rmmp-poll") == "GRANTED");
    CHECK(served.read(kOld, "/users/rmmp", "privilege") == "modify");
    CHECK(write() == 204);
    CHECK(served.post(kOld, "/users/rmmp?action=cancel").status == 204);
    CHECK(write() == 403);
    CHECK(served.post(kOld, "/rw/panel/opmode", {{"opmode", "auto"}}).status == 204);
    CHECK(write() == 204);
}

TEST_CASE("Control stations of RobotWare 8 (serve-contract 40)", "[rws]") {
    ServedController served(kModules, false, 8);
    REQUIRE(served.opened());
    CHECK(served.get(kNew, "/rw/mastership").status == 410);
    CHECK(served.post(kNew, "/rw/mastership/edit/request").status == 410);
    const auto write = [&](uint64_t session) {
        return served.post(kNew, dataPath(kNew, "T_ROB1/count"), {{"value", "1"}}, session);
    };
    const std::string request = "/rw/controlstation/writeaccess/request";
    const auto registered = [&](uint64_t session, const std::string& id) {
        return served
            .post(kNew, "/rw/controlstation/register/remote",
                  {{"control-station-name", "PC"}, {"control-station-id", id}, {"pincode", "1234"}}, session)
            .status;
    };
    CHECK(write(1).failure->code == ReturnCode::StationUnknown);
    CHECK(served.post(kNew, request).status == 403);
    CHECK(registered(1, "1234") == 400);
    CHECK(registered(1, "{01234567-89ab-cdef-0123-456789abcdef}") == 204);
    CHECK(write(1).failure->code == ReturnCode::NoWriteAccess);
    CHECK(served.post(kNew, request).status == 204);
    CHECK(write(1).status == 204);
    CHECK(registered(2, "{01234567-89ab-cdef-0123-456789abcde0}") == 204);
    CHECK(served.post(kNew, request, {}, 2).status == 403);
    CHECK(served.read(kNew, "/rw/controlstation/writeaccess/status", "held-by-control-station-name") == "PC");
    CHECK(served.post(kNew, "/rw/controlstation/writeaccess/release").status == 204);
    CHECK(served.post(kNew, request, {}, 2).status == 204);
}

TEST_CASE("Control stations do not exist below RobotWare 8 (serve-contract 40)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.get(kNew, "/rw/controlstation/writeaccess/status").status == 404);
}

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

TEST_CASE("Changes of persistents are reported one by one (serve-contract 42)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   PERS num count := 0;
   PROC main()
      FOR i FROM 1 TO 20 DO
         count := i;
      ENDFOR
      Stop;
   ENDPROC
ENDMODULE
)"}});
    REQUIRE(served.opened());
    std::vector<std::string> seen;
    Subscription subscription;
    served.onController([&] {
        Request request = served.requestOf(kOld, Method::Get, "/", 1);
        const std::string text = "/rw/rapid/symbol/data/RAPID/T_ROB1/Main1/count;value";
        const Subscribable* found = served.subscribables().find(text, request);
        REQUIRE(found != nullptr);
        CHECK(found->highPriority);
        CHECK_FALSE(
            found->open(request, [&](Entry entry) { seen.push_back(entry.values[0].second); }, subscription));
    });
    REQUIRE(subscription.initial.size() == 1);
    CHECK(subscription.initial[0].values[0].second == "0");
    CHECK(served.post(kOld, "/rw/panel/ctrlstate?action=setctrlstate", {{"ctrl-state", "motoron"}}).status ==
          204);
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start").status == 204);
    REQUIRE(served.waitFor(kOld, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.post(kOld, dataPath(kOld, "T_ROB1/count") + "?action=set", {{"value", "50"}}).status == 204);
    served.onController([&] { subscription.watch.reset(); });
    std::vector<std::string> wanted;
    for (int i = 1; i <= 20; ++i)
        wanted.push_back(std::to_string(i));
    wanted.emplace_back("50");
    CHECK(seen == wanted);
}

TEST_CASE("Dialogs are read and answered (serve-contract 22, 31)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   PERS num answer := 0;
   PERS num entered := 0;
   PROC main()
      VAR btnres button;
      UIMsgBox "Continue?" \Buttons:=btnYesNo \Result:=button;
      answer := button;
      entered := UINumEntry(\Header:="Number" \Message:="Enter it");
      Stop;
   ENDPROC
ENDMODULE
)"}},
                            true);
    REQUIRE(served.opened());
    const std::string active = "/rw/rapid/uiinstr/active";
    REQUIRE(served.waitFor(kOld, active, "instr", "UIMsgBox"));
    CHECK(served.read(kOld, active, "msg") == "Continue?");
    CHECK(served.read(kNew, active, "event") == "SEND");
    std::string stack = served.read(kOld, active, "stack");
    CHECK(stack.starts_with("RAPID/T_ROB1/%$"));
    CHECK(served.post(kOld, active + "/param/" + stack + "/Result", {{"value", "3"}}).status == 400);
    CHECK(served.post(kOld, active + "/param/" + stack + "/Result", {{"value", "1"}}).status == 204);
    REQUIRE(served.waitFor(kOld, active, "instr", "UINumEntry"));
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/answer"), "value") == "6"); // resYes
    stack = served.read(kOld, active, "stack");
    CHECK(served.post(kNew, active + "/param/" + stack + "/Result", {{"value", "text"}}).status == 400);
    CHECK(served.post(kNew, active + "/param/" + stack + "/Result", {{"value", "12.5"}}).status == 204);
    REQUIRE(served.waitFor(kOld, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/entered"), "value") == "12.5");
    CHECK(served.get(kOld, active).status == 404);
}

TEST_CASE("Queues carry messages between clients and tasks (controller.md 2.3)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   PROC main()
      VAR rmqslot slot;
      VAR rmqmessage message;
      VAR rmqheader header;
      VAR num value;
      RMQReadWait message \TimeOut:=60;
      RMQGetMsgData message, value;
      RMQFindSlot slot, "PC";
      value := value + 1;
      RMQSendMessage slot, value;
      Stop;
   ENDPROC
ENDMODULE
)"}},
                            true);
    REQUIRE(served.opened());
    const FieldList create{
        {"dipc-queue-name", "PC"}, {"dipc-queue-size", "4440"}, {"dipc-max-msg-size", "444"}};
    CHECK(served.post(kOld, "/rw/dipc?action=dipc-create", create).status == 201);
    CHECK(served.post(kOld, "/rw/dipc?action=dipc-create", create).failure->code == ReturnCode::BadParameter);
    const FieldList message{{"dipc-src-queue-name", "PC"},
                            {"dipc-cmd", "111"},
                            {"dipc-userdef", "1"},
                            {"dipc-msgtype", "1"},
                            {"dipc-data", "num;41"}};
    CHECK(served.post(kOld, "/rw/dipc/RMQ_T_ROB1?action=dipc-send", message).status == 204);
    const Reply reply = served.get(kOld, "/rw/dipc/PC?action=dipc-read&timeout=10");
    CHECK(ServedController::spanOf(reply, "dipc-data", "dipc-read-li") == "num;42");
    CHECK(ServedController::spanOf(reply, "queue-name") == "RMQ_T_ROB1");
    CHECK(served.get(kNew, "/rw/dipc/PC").document->entries.empty());
    CHECK(served.post(kOld, "/rw/dipc/None?action=dipc-send", message).status == 404);
    CHECK(served.call(kOld, Method::Delete, "/rw/dipc/PC").status == 204);
    CHECK(served.get(kOld, "/rw/dipc/PC").status == 404);
}

TEST_CASE("Users, grants and login (serve-contract 8, 22)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served
              .post(kOld, "/users",
                    {{"username", "me"}, {"application", "app"}, {"location", "here"}, {"ulocale", "local"}})
              .status == 200);
    CHECK(served.read(kNew, "/users/login-info", "user-alias", "user-login-info") == "me");
    CHECK(served.read(kOld, "/users/grants", "grantname", "user-grant") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/uas/grants", "grant-name", "grant-info") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/uas/user/grants", "grantname", "uas-grant") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/users/grant-exists?grant=UAS_BACKUP", "status") == "true");
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

TEST_CASE("Activation of tasks (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=deactivate").status == 204);
    CHECK(served.read(kOld, "/rw/rapid/tasks", "active") == "Off");
    CHECK(served.read(kNew, "/rw/rapid/taskselection", "state", "rap-taskselection") == "OFF");
    CHECK(served.post(kNew, "/rw/rapid/tasks/activate", {{"task", "T_ROB1"}}).status == 403);
    CHECK(served.post(kNew, "/rw/rapid/tasks/activate?mastership=implicit", {{"task", "T_ROB1"}}).status ==
          204);
    CHECK(served.read(kOld, "/rw/rapid/tasks", "active") == "On");
    CHECK(served.post(kOld, "/rw/rapid/tasks/None?action=activate").status == 404);
}

TEST_CASE("The stops of the panel and the lock of the mode (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto state = [&] {
        return served.read(kNew, "/rw/panel/ctrl-state", "ctrlstate", "pnl-ctrlstate");
    };
    const auto motors = [&](const char* to) {
        return served.post(kNew, "/rw/panel/ctrl-state", {{"ctrl-state", to}}).status;
    };
    CHECK(motors("motoron") == 204);
    CHECK(state() == "motoron");
    CHECK(served.post(kNew, "/rw/panel/emergency-stop", {{"state", "off"}}).status == 204);
    CHECK(state() == "emergencystop");
    CHECK(motors("motoron") == 403);
    CHECK(served.post(kNew, "/rw/panel/emergency-stop", {{"state", "on"}}).status == 204);
    CHECK(state() == "motoroff");
    CHECK(served.post(kNew, "/rw/panel/general-stop", {{"state", "off"}}).status == 204);
    CHECK(state() == "guardstop");
    CHECK(served.post(kNew, "/rw/panel/general-stop", {{"state", "on"}}).status == 204);
    CHECK(motors("motoron") == 204);
    CHECK(motors("on") == 400);
    CHECK(served.post(kNew, "/rw/panel/opmode/lock", {{"pin", "1234"}, {"permanent", "false"}}).status ==
          204);
    CHECK(served.read(kNew, "/rw/panel/opmode/lock-state", "lockstate") == "locked");
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "man"}}).status == 403);
    CHECK(served.post(kNew, "/rw/panel/opmode/unlock").status == 204);
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "MAN"}}).status == 400);
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "manf"}}).status == 204);
    CHECK(served.read(kNew, "/rw/panel/opmode", "opmode") == "MANF");
}

TEST_CASE("Predefined data are found, whether the program uses them or not (controller.md 2.3, 6.3)",
          "[rws]") {
    ServedController served(
        {{"Main1.mod", "MODULE Main1\n   PROC main()\n      Stop;\n   ENDPROC\nENDMODULE\n"}});
    REQUIRE(served.opened());
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/user/reg1"), "value") == "0");
    CHECK(served.post(kOld, dataPath(kOld, "T_ROB1/user/reg1") + "?action=set", {{"value", "3"}}).status ==
          204);
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/reg1"), "value") == "3");
    CHECK(served.read(kNew, dataPath(kNew, "T_ROB1/BASE/tool0"), "value") ==
          "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]");
    CHECK(served.post(kOld, dataPath(kOld, "T_ROB1/tool0/robhold") + "?action=set", {{"value", "FALSE"}})
              .status == 400);
    CHECK(served.post(kOld, dataPath(kOld, "T_ROB1/tool0.robhold") + "?action=set", {{"value", "FALSE"}})
              .status == 403);
    CHECK(served.read(kNew, propertiesPath(kNew, "T_ROB1/BASE/tool0"), "typurl", "rap-symproppers") ==
          "RAPID/tooldata");
    CHECK(served.read(kNew, propertiesPath(kNew, "tooldata/tframe"), "typurl", "rap-sympropreccomp") ==
          "RAPID/pose");
    CHECK(served.get(kOld, dataPath(kOld, "T_ROB1/clock1")).status == 400); // a clock has no value
}
