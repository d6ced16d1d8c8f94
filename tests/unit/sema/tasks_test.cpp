// Rules about whole tasks: entry routine, several modules and files, persistents shared by tasks, hard programs.

#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/projects.h"
#include "sema_testing.h"

#include <catch2/catch.hpp>
#include <set>

namespace {

using namespace rapid;
using namespace rapid::sema;
using namespace rapid::sema::testing;
using Messages = std::vector<std::string>;

std::unique_ptr<Checked> checkMain(const std::vector<std::string>& texts) {
    CheckOptions options;
    options.requireMain = true;
    return checkTexts(texts, options);
}

} // namespace

TEST_CASE("a program that is to run needs one global procedure main", "[sema]") {
    const auto missing = checkMain({"MODULE m\nENDMODULE\n"});
    REQUIRE(missing->messages() == Messages{"RAP6001 at 1:8: task 'T_ROB1' has no routine 'main': declare "
                                            "PROC main() in one of its modules"});
    CHECK(checkTexts({"MODULE m\nENDMODULE\n"})->messages().empty());

    const auto function = checkMain({"MODULE m\n  FUNC num Main()\n    RETURN 1;\n  ENDFUNC\nENDMODULE\n"});
    REQUIRE(function->codes() == Messages{"RAP6002"});
    // rapidc check does not require a main, but only a procedure can be the entry of a task.
    CHECK(checkTexts({"MODULE m\n  FUNC num Main()\n    RETURN 1;\n  ENDFUNC\nENDMODULE\n"})->codes() ==
          Messages{"RAP6002"});
    const std::string required = "MODULE m\n  PROC main(num a)\n  ENDPROC\nENDMODULE\n";
    const Messages wantsArguments = {
        "RAP6002 at 2:8: entry routine 'main' is a procedure with required parameters, expected a "
        "global procedure without required parameters"};
    CHECK(checkMain({required})->messages() == wantsArguments);
    CHECK(checkTexts({required})->messages() == wantsArguments);
    const auto local = checkMain({"MODULE m\n  LOCAL PROC main()\n  ENDPROC\nENDMODULE\n"});
    REQUIRE(local->codes() == Messages{"RAP6003"});
    const auto two = checkMain({"MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n",
                                "MODULE b\n  PROC MAIN()\n  ENDPROC\nENDMODULE\n"});
    REQUIRE(two->codes() == Messages{"RAP2011"});
    const auto good = checkMain({"MODULE m\n  PROC Main(\\num a)\n  ENDPROC\nENDMODULE\n"});
    CHECK(good->messages().empty());
    CHECK(good->program->tasks[0]->entryRoutine != nullptr);
}

TEST_CASE("a LOCAL main is reported where nothing else can be meant", "[sema]") {
    const auto codes = [](const std::string& body, const std::string& more = "") {
        return checkTexts({"MODULE m\n  LOCAL PROC main()\n" + body + "  ENDPROC\n" + more + "ENDMODULE\n"})
            ->codes();
    };
    CHECK(codes("    Stop;\n") == Messages{"RAP6003"});
    CHECK(codes("    RETURN;\n", "  PROC cycle()\n    main;\n  ENDPROC\n").empty()); // a helper of that name
    CHECK(codes("    setState;\n") == Messages{"RAP2003"}); // a part of a program, called from another one
    CHECK(codes("    Stop;\n", "  PROC next(string name)\n    %name%;\n  ENDPROC\n")
              .empty()); // perhaps by name
    // The entry of the task has another name.
    TaskInput task;
    task.entry = "watch";
    task.files.push_back(std::make_shared<const SourceFile>(
        "m.modx", "MODULE m\n  PROC watch()\n  ENDPROC\n  LOCAL PROC main(num a)\n  ENDPROC\nENDMODULE\n"));
    CheckOptions options;
    options.library = library();
    diag::Sink sink;
    check({task}, options, sink);
    CHECK(sink.all().empty());
}

TEST_CASE("placeholders are notes: a program with them can be loaded", "[sema]") {
    const std::string text = "MODULE m\n  PROC main()\n    <SMT>\n    reg1 := <EXP>;\n  ENDPROC\nENDMODULE\n";
    const auto checked = checkTexts({text});
    CHECK(checked->messages().empty());
    CHECK(checked->sink.all().size() == 2);
    CHECK(checked->sink.all()[0].code == diag::say::Placeholder.code);
    const auto run = checkMain({text});
    CHECK(run->messages().empty());
}

TEST_CASE("every placeholder is noted once", "[sema]") {
    const std::string text =
        "MODULE <ID>\n  VAR num <ID>;\n  VAR num list{<EXP>};\n  <DDN>\n  RECORD <ID>\n    num x;\n  "
        "ENDRECORD\n"
        "  PROC <ID>()\n    <SMT>\n  ENDPROC\n  PROC p(<PAR>)\n  ENDPROC\n"
        "  PROC main()\n    VAR pos place;\n    VAR num n := <EXP>;\n    n := place.<ID> + <ID>;\n"
        "    <ID> <ARG>;\n    FOR <ID> FROM 1 TO <EXP> DO\n    ENDFOR\n    IF TRUE THEN\n    <EIT>\n    "
        "ENDIF\n"
        "    TEST n\n    <CSE>\n    ENDTEST\n    GOTO <ID>;\n  ENDPROC\nENDMODULE\n";
    size_t expected = 0;
    for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1))
        ++expected;
    const auto checked = checkTexts({text});
    std::set<uint32_t> noted;
    for (const diag::Diagnostic& d : checked->sink.all()) {
        if (d.code != diag::say::Placeholder.code) continue;
        CHECK(text[d.range.begin] == '<');
        CHECK(noted.insert(d.range.begin).second);
    }
    CHECK(noted.size() == expected);
}

TEST_CASE("a file given twice is read once", "[sema]") {
    CheckOptions options;
    options.library = library();
    const auto file =
        std::make_shared<const SourceFile>("m.modx", "MODULE m\n  PROC main()\n  ENDPROC\nENDMODULE\n");
    TaskInput task;
    task.files = {file, file};
    diag::Sink sink;
    const auto program = check({task}, options, sink);
    REQUIRE(sink.all().size() == 1);
    CHECK(sink.all()[0].code == diag::say::SameFileTwice.code);
    CHECK(program->tasks[0]->modules.size() == 1);
}

TEST_CASE("tasks have names of their own but share global persistents", "[sema]") {
    const std::string first =
        "MODULE m\n  VAR num own;\n  PERS num shared := 1;\n  PERS bool same;\n"
        "  PERS num list{3};\n  LOCAL PERS num mine := 1;\n  RECORD part\n    num x;\n  "
        "ENDRECORD\n  PERS part record1;\nENDMODULE\n";
    const std::string second =
        "MODULE m\n  VAR bool own;\n  PERS bool shared := TRUE;\n  PERS bool SAME;\n"
        "  PERS num list{4};\n  LOCAL PERS bool mine := TRUE;\n  RECORD part\n    num x;\n  "
        "ENDRECORD\n  PERS part record1;\nENDMODULE\n";
    const auto checked = checkTasks({{first}, {second}});
    CHECK(checked->messages() ==
          Messages{"RAP6004 at 3:13: global persistent 'shared' is 'bool', but 'num' "
                   "in another task: declare both with the same type, or as TASK PERS",
                   "RAP6004 at 5:12: global persistent 'list' is 'num{4}', but "
                   "'num{3}' in another task: declare both with the same type, or as TASK PERS"});
    CHECK(checked->program->tasks.size() == 2);
}

TEST_CASE("records of one name that differ between tasks are reported with their difference, once",
          "[sema]") {
    const auto shared = [](const std::string& part, const std::string& value) {
        return "MODULE m\n  RECORD inner\n    " + part +
               "\n  ENDRECORD\n  RECORD whole\n    num id;\n    inner place;\n" +
               "  ENDRECORD\n  PERS whole a := [1, [" + value + "]];\n  PERS whole b := [1, [" + value +
               "]];\n  PERS inner c := [" + value + "];\nENDMODULE\n";
    };
    const auto check = [&](const std::string& part, const std::string& value) {
        return checkTasks({{shared("num x;", "1")}, {shared(part, value)}})->messages();
    };
    const std::string start = "RAP6004 at 9:14: global persistent 'a' is ",
                      end = " in another task: declare both with the same type, or as TASK PERS";
    CHECK(check("num X;", "1").empty());
    CHECK(check("dnum x;", "1") ==
          Messages{start + "'whole (place.x is dnum)', but 'whole (place.x is num)'" + end,
                   "RAP6004 at 11:14: global persistent 'c' is 'inner (x is dnum)', but 'inner (x is num)'" +
                       end});
    CHECK(check("num y;", "1").front() == start + "'whole (place is y)', but 'whole (place is x)'" + end);
    CHECK(check("num x; num y;", "1, 2").front() ==
          start + "'whole (place is x, y)', but 'whole (place is x)'" + end);
    const std::string many = "num x; num a; num b; num c; num d; num e; num f; num g; num h;";
    CHECK(check(many, "1, 2, 3, 4, 5, 6, 7, 8, 9").front() ==
          start + "'whole (place is ..., a, b, c, d, e, f, ...)', but 'whole (place is x)'" + end);
}

TEST_CASE("two tasks cannot have one name", "[sema]") {
    CheckOptions options;
    options.library = library();
    TaskInput a, b;
    a.files = {std::make_shared<const SourceFile>("a.modx", "MODULE a\nENDMODULE\n")};
    b.files = {std::make_shared<const SourceFile>("b.modx", "MODULE b\nENDMODULE\n")};
    b.name = "t_rob1";
    diag::Sink sink;
    check({a, b}, options, sink);
    REQUIRE(sink.all().size() == 1);
    CHECK(sink.all()[0].code == diag::say::DuplicateTask.code);
}

TEST_CASE("an incomplete task does not report names it cannot know", "[sema]") {
    CheckOptions options;
    options.library = library();
    TaskInput task;
    task.incomplete = true;
    task.files = {std::make_shared<const SourceFile>(
        "a.modx", "MODULE a\n  PROC main()\n    hidden 1;\n    reg1 := other + more(2);\n    reg1 := TRUE;\n"
                  "  ENDPROC\nENDMODULE\n")};
    diag::Sink sink;
    check({task}, options, sink);
    CHECK(sink.errorCount() == 1);
    for (const diag::Diagnostic& d : sink.all())
        CHECK(d.code == (d.severity == diag::Severity::Error ? diag::say::AssignType.code
                                                             : diag::say::MayBeDeclared.code));
}

TEST_CASE("one mistake in a declaration does not report every use", "[sema]") {
    const auto checked = checkTexts({"MODULE m\n"
                                     "  VAR unknowntype a;\n"
                                     "  CONST num b := missing;\n"
                                     "  PROC work(nosuch c)\n"
                                     "    a := c;\n"
                                     "    a.x := b + c;\n"
                                     "    IF a = c work a;\n"
                                     "    FOR i FROM a TO c DO\n"
                                     "      a{i} := [1, 2];\n"
                                     "    ENDFOR\n"
                                     "  ENDPROC\n"
                                     "ENDMODULE\n"});
    CHECK(checked->codes() == Messages{"RAP2002", "RAP2001", "RAP2002"});
}

TEST_CASE("letters of ISO 8859-1 are names without regard to case", "[sema]") {
    const auto checked = checkTexts({"MODULE m\n  VAR num größe;\n  VAR num ÅNGSTRÖM;\n  PROC main()\n"
                                     "    GRÖßE := ångström;\n  ENDPROC\nENDMODULE\n"});
    CHECK(checked->messages().empty());
}

TEST_CASE("long chains of operators and many names are checked", "[sema]") {
    std::string sum = "1";
    for (int i = 0; i < 900; ++i)
        sum += i % 100 == 99 ? "\n+1" : "+1";
    const auto chain = checkTexts({"MODULE m\n  VAR dnum d;\n  PROC main()\n    d := " + sum +
                                   ";\n    d := d + " + sum + ";\n  ENDPROC\nENDMODULE\n"});
    CHECK(chain->messages() == Messages{});

    const auto chainOf = [](int count) {
        std::string text = "MODULE m\n";
        for (int i = 0; i < count; ++i)
            text += "  CONST num c" + std::to_string(i) + " := c" + std::to_string(i + 1) + " + 1;\n";
        return text + "  CONST num c" + std::to_string(count) + " := 0;\nENDMODULE\n";
    };
    const auto constants = checkTexts({chainOf(400)});
    REQUIRE(constants->messages() == Messages{});
    CHECK(static_cast<const DataSymbol*>(findSymbol(*constants->program, "c0"))->value().number == 400);
    const auto tooDeep = checkTexts({chainOf(20000)});
    REQUIRE(!tooDeep->codes().empty());
    CHECK(tooDeep->codes()[0] == "RAP3039");

    std::string types = "MODULE m\n";
    for (int i = 0; i < 20000; ++i)
        types += "  ALIAS t" + std::to_string(i + 1) + " t" + std::to_string(i) + ";\n";
    const auto aliases = checkTexts({types + "  ALIAS num t20000;\nENDMODULE\n"});
    REQUIRE(!aliases->codes().empty());
    CHECK(aliases->codes()[0] == "RAP2047");
}

TEST_CASE("records that grow beyond any memory are refused", "[sema]") {
    std::string text = "MODULE m\n  RECORD t0\n    num a;\n    num b;\n  ENDRECORD\n";
    for (int i = 0; i < 60; ++i) {
        const std::string inner = "t" + std::to_string(i);
        text += "  RECORD t" + std::to_string(i + 1) + "\n    " + inner + " a;\n    " + inner +
                " b;\n  ENDRECORD\n";
    }
    const auto checked = checkTexts({text + "  VAR t60 huge;\n  VAR t10 fine{1000};\nENDMODULE\n"});
    CHECK(checked->messages() ==
          Messages{"RAP2045 at 246:11: 'huge' has too many elements for the memory of a controller"});
}

TEST_CASE("without a library the atomic types exist", "[sema]") {
    diag::Sink sink;
    TaskInput task;
    task.files = {std::make_shared<const SourceFile>(
        "a.modx", "MODULE a\n  VAR num n := 1;\n  VAR string s := \"x\";\n"
                  "  PROC main()\n    n := n + 1;\n  ENDPROC\nENDMODULE\n")};
    check({task}, {}, sink);
    CHECK(sink.all().empty());
}

TEST_CASE("a background task does not move the robot", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  PROC main()\n"
                             "    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\n"
                             "    StopMove;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto codesIn = [&](const char* type) {
        Checked checked;
        TaskInput task;
        task.name = "T_WATCH";
        task.type = type;
        task.files.push_back(std::make_shared<const SourceFile>("m.modx", text));
        CheckOptions options;
        options.library = library();
        checked.program = check({task}, options, checked.sink);
        return checked.codes();
    };
    CHECK(codesIn("NORMAL").empty());
    CHECK(codesIn("STATIC") == Messages{"RAP5025"});
    CHECK(codesIn("SEMISTATIC") == Messages{"RAP5025"});
}

TEST_CASE("a controller has at most 20 tasks", "[sema]") {
    const auto codesOf = [](size_t count) {
        Checked checked;
        std::vector<TaskInput> tasks(count);
        for (size_t i = 0; i < count; ++i)
            tasks[i].name = "T" + std::to_string(i);
        CheckOptions options;
        options.library = library();
        checked.program = check(tasks, options, checked.sink);
        return checked.codes();
    };
    CHECK(codesOf(20).empty());
    CHECK(codesOf(21) == Messages{"RAP6006"});
}
