// Resources of symbols and their values, without HTTP: what serve-contract.md (lines named) and controller.md chapter 2 say of them.

#include "unit/rws/served_controller.h"

#include <catch2/catch.hpp>

using namespace rapidc::rws;

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
