// The generator: what declarations become, and what it refuses.

#include "stdlib/gen/emit.h"
#include "tests/unit/stdlib/declaration_files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <unistd.h>

using namespace stdlibgen;

namespace {

/// The model of one declaration file with this body.
Model read(const std::string& body) {
    const auto path =
        std::filesystem::temp_directory_path() / ("stdlib_gen_test_" + std::to_string(getpid()) + ".sysx");
    std::ofstream(path) << "MODULE decl_test(SYSMODULE)\n" << body << "ENDMODULE\n";
    Model model = readDeclarations({path.string()});
    std::filesystem::remove(path);
    return model;
}

const char* const kTypes = R"(
!! A position.
RECORD pos
  num x;
  num y;
ENDRECORD

!! A place with a name; `register` is a word of C++.
RECORD place
  pos where;
  string register;
ENDRECORD

!! Digital output.
!@ class: semivalue   manual: 1.9
RECORD signaldo
ENDRECORD

!! Error number.
ALIAS num errnum;
)";

std::string prototypeOf(const std::string& declaration) {
    const Model model =
        read(std::string(kTypes) + "\n!! Does it.\n!@ manual: 1.15   effects: const\n" + declaration);
    for (const std::string& error : model.errors)
        UNSCOPED_INFO(error);
    CHECK(model.errors.empty());
    const std::string all = emitNatives(model, model.sources.at(0));
    const size_t name = all.find(" rt_");
    REQUIRE(name != std::string::npos);
    const size_t start = all.rfind('\n', name) + 1;
    return all.substr(start, all.find('\n', name) - start);
}

bool mentions(const std::vector<std::string>& errors, const std::string& text) {
    for (const std::string& error : errors)
        if (error.find(text) != std::string::npos) return true;
    return false;
}

} // namespace

TEST_CASE("natives of class Const take and give values", "[stdlib][gen]") {
    CHECK(prototypeOf("FUNC num Sin(num Angle)\n") == "float rt_Sin(float Angle);");
    CHECK(prototypeOf("FUNC bool Both(bool A, dnum B)\n") == "bool rt_Both(bool A, double B);");
    CHECK(prototypeOf("FUNC errnum Number(num N)\n") == "float rt_Number(float N);");
}

TEST_CASE("all other natives get the task and return a status", "[stdlib][gen]") {
    CHECK(prototypeOf("FUNC num Round(num Val \\num Dec)\n") ==
          "rt::Status rt_Round(rt::TaskCore* task, float* result, float Val, const float* Dec);");
    CHECK(
        prototypeOf("FUNC pos Shift(pos P, num By)\n") ==
        "rt::Status rt_Shift(rt::TaskCore* task, rt::data::Pos* result, const rt::data::Pos* P, float By);");
    CHECK(prototypeOf("FUNC string Name(string S)\n") ==
          "rt::Status rt_Name(rt::TaskCore* task, rt::String* result, const rt::String* S);");
    CHECK(prototypeOf("PROC Stop()\n") == "rt::Status rt_Stop(rt::TaskCore* task);");
    CHECK(prototypeOf("PROC Put(VAR signaldo Signal, num Value)\n") ==
          "rt::Status rt_Put(rt::TaskCore* task, rt::Handle* Signal, float Value);");
    CHECK(prototypeOf("PROC Write(string Text \\num Num | bool Bool \\switch NoNewLine)\n") ==
          "rt::Status rt_Write(rt::TaskCore* task, const rt::String* Text, const float* Num, const bool* "
          "Bool, bool "
          "NoNewLine);");
    CHECK(prototypeOf("PROC Incr(INOUT num Name | INOUT dnum Dname)\n") ==
          "rt::Status rt_Incr(rt::TaskCore* task, float* Name, double* Dname);");
    CHECK(prototypeOf("PROC Add(num A | dnum B)\n") ==
          "rt::Status rt_Add(rt::TaskCore* task, const float* A, const double* B);");
    CHECK(prototypeOf("PROC Sum(num A{*,*}, INOUT num B{*})\n") ==
          "rt::Status rt_Sum(rt::TaskCore* task, const float* A, int32_t ADim1, int32_t ADim2, float* B, "
          "int32_t BDim1);");
    CHECK(prototypeOf("PROC Any(anytype Val, INOUT anytype Out)\n") ==
          "rt::Status rt_Any(rt::TaskCore* task, const void* Val, const rt::TypeDesc* ValType, void* Out, "
          "const "
          "rt::TypeDesc* OutType);");
}

TEST_CASE("what the compiler makes itself has no prototype", "[stdlib][gen]") {
    const Model model = read("!! There?\n!@ role: present\nFUNC bool Present(REF anytype OptPar)\n");
    CHECK(emitNatives(model, model.sources.at(0)).find("rt_Present") == std::string::npos);
    CHECK(emitNativeTable(model).find("NativeForm::Compiler") != std::string::npos);
}

TEST_CASE("records become structures, contained ones first", "[stdlib][gen]") {
    const std::string types = emitTypes(read(kTypes));
    CHECK(types.find("struct Pos {\n    float x;\n    float y;\n};") != std::string::npos);
    CHECK(types.find("struct Place {\n    rt::data::Pos where;\n    rt::String register_;\n};") !=
          std::string::npos);
    CHECK(types.find("Signaldo") == std::string::npos);
}

TEST_CASE("numeric constants and errors", "[stdlib][gen]") {
    const Model model = read(std::string(kTypes) + R"(
  !! Division by zero.
  CONST errnum ERR_DIVZERO := 1003;
  CONST num LOW_VALUE := -1.5;
  CONST pos origin := [0, 0];
)");
    CHECK(model.errors.empty());
    const std::string constants = emitConstants(model);
    CHECK(constants.find("inline constexpr Status ERR_DIVZERO = 1003;") != std::string::npos);
    CHECK(constants.find("inline constexpr float LOW_VALUE = static_cast<float>(-1.5);") !=
          std::string::npos);
    CHECK(constants.find("origin") == std::string::npos);
    CHECK(emitErrorTable(model).find("{1003, \"ERR_DIVZERO\", \"Division by zero.\"}") != std::string::npos);
}

TEST_CASE("documentation and attributes, continued lines too", "[stdlib][gen]") {
    const Model model =
        read("!! Sends it. Waits for no answer.\n!! @param N  number\n"
             "!@ manual: 1.10   effects: waits\n!@ raises: ERR_A,\n!@    ERR_B   option: Big Option\n"
             "PROC Send(num N)\n");
    REQUIRE(model.routines.size() == 1);
    const Routine& send = model.routines[0];
    CHECK(send.doc.summary() == "Sends it.");
    CHECK(send.doc.get("manual") == "1.10");
    CHECK(send.doc.get("raises") == "ERR_A, ERR_B");
    CHECK(send.doc.get("option") == "Big Option");
    CHECK(send.signature == "PROC Send(num N)");
    CHECK(send.native);
    const std::string reference = emitReference(model).front().text;
    CHECK(reference.find("## Send\n\n```\nPROC Send(num N)\n```") != std::string::npos);
    CHECK(reference.find("- `N`: number") != std::string::npos);
    CHECK(reference.find("Chapter 1.10. Option: Big Option.") != std::string::npos);
}

TEST_CASE("the reference in docs/reference is what the declarations say", "[stdlib][gen]") {
    namespace fs = std::filesystem;
    const Model model = projectDeclarations();
    const fs::path reference = fs::path(RAPIDC_SOURCE_DIR) / "docs" / "reference";
    std::set<std::string> pages;
    for (const Page& page : emitReference(model)) {
        INFO(page.file << ": write it again with ./dev reference");
        pages.insert(page.file);
        std::ifstream in(reference / page.file, std::ios::binary);
        std::stringstream text;
        text << in.rdbuf();
        CHECK(text.str() == page.text);
    }
    CHECK(pages.size() > 30);
    for (const auto& entry : fs::directory_iterator(reference)) {
        INFO(entry.path() << " has no declarations any more");
        CHECK(pages.count(entry.path().filename().string()) == 1);
    }
}

TEST_CASE("a routine with a body is not native", "[stdlib][gen]") {
    const Model model = read("!! Adds.\nFUNC num Sum(num A, num B)\n  RETURN A + B;\nENDFUNC\n");
    REQUIRE(model.routines.size() == 1);
    CHECK_FALSE(model.routines[0].native);
    CHECK(emitNatives(model, model.sources.at(0)).find("rt_Sum") == std::string::npos);
}

TEST_CASE("an attribute with a word that is not in builtin_words.def is refused", "[stdlib][gen]") {
    const auto problem = [](const std::string& attribute) {
        const Model model = read("!! One.\n!@ " + attribute + "\nPROC Put(num N, anytype A)\n");
        return model.errors.empty() ? std::string() : model.errors.front();
    };
    CHECK(problem("class: nonvalue   bytes: 1024").empty());
    CHECK(problem("effects: writes   traits: names calls   where: A is value or signal").empty());
    CHECK(
        mentions({problem("effects: write")}, "effects: does not know 'write'; it takes const, pure, reads"));
    CHECK(mentions({problem("flow: ends")}, "flow: does not know 'ends'; it takes leaves, raises"));
    CHECK(mentions({problem("role: presents")}, "role: does not know 'presents'; it takes present, dim"));
    CHECK(
        mentions({problem("meaning: errors")}, "meaning: does not know 'errors'; it takes error, interrupt"));
    CHECK(mentions({problem("known: zones")}, "known: does not know 'zones'; it takes digital input"));
    CHECK(mentions({problem("traits: names named")}, "traits: does not know 'named'; it takes stoppoint"));
    CHECK(mentions({problem("confidence: very")}, "confidence: does not know 'very'"));
    CHECK(mentions({problem("where: A is vlaue")}, "where: does not know 'vlaue'; it takes value"));
    CHECK(mentions({problem("where: B is value")}, "where: 'B is value' is not 'Parameter is kind'"));
}

TEST_CASE("bad declarations are refused with file and line", "[stdlib][gen]") {
    const Model unknown = read("!! Does it.\nPROC Put(nothing N)\n");
    REQUIRE(unknown.errors.size() == 1);
    CHECK(mentions(unknown.errors, ".sysx:3: 'Put' uses the unknown type 'nothing'"));
    CHECK(mentions(read("!! One.\nPROC Put(num N)\n\n!! Two.\nPROC put(num N)\n").errors,
                   "'put' is declared twice, first at"));
    CHECK(mentions(read("!! One.\n!@ manuel: 1.2\nPROC Put(num N)\n").errors, "unknown attribute 'manuel:'"));
    CHECK(
        mentions(read("!! One.\n!@ what is this\nPROC Put(num N)\n").errors, "'what' follows no attribute"));
    CHECK(
        mentions(read("!! Empty.\nRECORD nothing\nENDRECORD\n").errors, "record 'nothing' has no component"));
    CHECK(mentions(read("!! One.\n!@ effects: pure   effects: reads\nPROC Put(num N)\n").errors,
                   "'!@ effects:' is written twice"));
    CHECK(mentions(read("!! One.\nPROC Put()\n\n!! Two.\nALIAS num two;\n").errors,
                   ".sysx:6: the order in a file is: types, data, routines"));
    CHECK_FALSE(read("!! One.\nPROC Put(num N\n").errors.empty()); // the parser's own message
    CHECK(mentions(readDeclarations({"/nowhere/x.sysx"}).errors, "cannot be read"));
}

TEST_CASE("rules of declarations: documentation, attributes, errors", "[stdlib][gen]") {
    const std::string errors = R"(!! Number of an error.
ALIAS num errnum;

!! The file is not there.
CONST errnum ERR_FILE := 1001;
)";
    const std::string attributes = "!@ manual: 1.1   effects: reads   confidence: high\n";
    const std::string complete = "!! Size of a file.\n!! @param File  its path\n!! @return size in bytes\n"
                                 "!! @error ERR_FILE  it is not there\n" +
                                 attributes + "!@ raises: ERR_FILE\nFUNC num Size(string File)\n";
    // The rules that `declaration` breaks, with `from` replaced by `to` in it.
    const auto broken = [&](const std::string& from, const std::string& to) {
        std::string declaration = complete;
        const size_t at = declaration.find(from);
        REQUIRE(at != std::string::npos);
        declaration.replace(at, from.size(), to);
        const Model model = read(errors + "\n" + declaration);
        REQUIRE(model.errors.empty());
        return brokenRules(model);
    };
    CHECK(broken("Size", "Size").empty());
    CHECK(mentions(broken("!! Size of a file.\n", ""), ".sysx:13: 'Size': has no summary"));
    CHECK(mentions(broken("!! Size of a file.\n", "!! Its size.\n"), "the summary says too little"));
    CHECK(mentions(broken("!! @param File  its path\n", ""), "lacks '!! @param File'"));
    CHECK(mentions(broken("!! @param File  its path", "!! @param File"), "lacks '!! @param File'"));
    CHECK(mentions(broken("@param File", "@param Path"), "'@param Path' names no parameter"));
    CHECK(mentions(broken("!! @return size in bytes\n", ""), "lacks '!! @return'"));
    CHECK(mentions(broken("size in bytes", "size of a file"), "'@return' repeats the summary"));
    CHECK(mentions(broken("effects: reads   ", ""), "lacks '!@ effects:'"));
    CHECK(mentions(broken("effects: reads", "effects: const"), "write 'effects: pure'"));
    CHECK(mentions(broken("!@ raises: ERR_FILE\n", ""),
                   "'!@ raises:' lists (), the lines '!! @error' describe (ERR_FILE)"));
    CHECK(mentions(broken("raises: ERR_FILE", "raises: ERR_FILES"),
                   "'ERR_FILES' is not a constant of type errnum"));
    CHECK(mentions(broken("raises: ERR_FILE", "raises: ERR_FILE   deferred: Path"),
                   "deferred: 'Path' is not a parameter"));
    CHECK(mentions(broken("string File", "string File, num file"), "has two parameters 'file'"));

    const auto ofData = [&](const std::string& data) { return brokenRules(read(errors + "\n" + data)); };
    CHECK(ofData("!! Another error.\nCONST errnum ERR_OTHER := 1002;\n").empty());
    CHECK(mentions(ofData("!! Another error.\nCONST errnum ERR_OTHER := 1001;\n"),
                   "has the error number of 'ERR_FILE'"));
    CHECK(mentions(ofData("!! Another error.\nCONST errnum ERR_OTHER := 90;\n"),
                   "an error number of programs (1 to 90)"));
    CHECK(mentions(ofData("!! The file is not there.\nCONST num other := 1;\n"),
                   "has the same summary as 'ERR_FILE'"));
    CHECK(mentions(ofData("VAR num other := 1;\n"), "'other': has no summary"));
}
