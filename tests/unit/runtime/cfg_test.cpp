#include "runtime/base/text_util.h"
#include "runtime/io/cfg_parser.h"

#include <catch2/catch.hpp>

using namespace rt;
using Catch::Matchers::Contains;

namespace {

CfgFile read(const std::string& text, std::size_t expectedProblems = 0) {
    std::vector<CfgProblem> problems;
    CfgFile file = parseCfg(text, "X.cfg", problems);
    for (const CfgProblem& problem : problems)
        INFO(problem.text());
    REQUIRE(problems.size() == expectedProblems);
    return file;
}

const CfgInstance& only(const CfgFile& file) {
    REQUIRE(file.sections.size() == 1);
    REQUIRE(file.sections[0].instances.size() == 1);
    return file.sections[0].instances[0];
}

} // namespace

TEST_CASE("configuration: header, sections, instances", "[cfg]") {
    const CfgFile file =
        read("EIO:CFG_1.0:6:1::\n\n#\n\nEIO_SIGNAL:\n\n      -Name \"di1\" -SignalType \"DI\"\n\n"
             "      -Name \"di2\" -SignalType \"DI\"\n#\n\nEIO_CROSS:\n\n");
    CHECK(file.domain == "EIO");
    CHECK(file.version == "CFG_1.0:6:1::");
    REQUIRE(file.sections.size() == 2);
    REQUIRE(file.sections[0].instances.size() == 2);
    CHECK(file.sections[0].instances[1].text("name") == "di2"); // names without regard to case
    CHECK(file.sections[0].instances[1].line == 9);
    CHECK(file.sections[1].instances.empty());
}

TEST_CASE("configuration: line ends of every kind, mixed", "[cfg]") {
    const CfgFile file =
        read("EIO:CFG_1.0:7:0::\r\n#\r\nEIO_SIGNAL:\n\n      -Name \"a\"\\\r\n      -SignalType \"DO\" \\\n"
             "      -Default 1\r\n");
    CHECK(only(file).text("Name") == "a");
    CHECK(only(file).text("SignalType") == "DO");
    double value = 0;
    CHECK(only(file).number("Default", value));
    CHECK(value == 1);
}

TEST_CASE("configuration: values", "[cfg]") {
    const CfgFile file =
        read("MOC:CFG_1.0:7:0::\n#\nARM:\n   \n      -name \"x y\" -low -2.5 -list 30,82 -MotionTask \n");
    const CfgInstance& instance = only(file);
    double low = 0;
    CHECK(instance.number("low", low)); // a value may begin with a minus sign
    CHECK(low == -2.5);
    REQUIRE(instance.find("list") != nullptr);
    CHECK(instance.find("list")->values == std::vector<std::string>{"30", "82"});
    CHECK(instance.flag("MotionTask")); // by presence alone
    CHECK_FALSE(instance.flag("Other"));
    CHECK(instance.text("name") == "x y");
}

TEST_CASE("configuration: an attribute without value before another one", "[cfg]") {
    const CfgFile file = read("MOC:CFG_1.0:7:0::\n#\nT:\n\n      -type  -tuning_in_auto \n");
    CHECK(only(file).attributes.size() == 2);
    CHECK(only(file).flag("tuning_in_auto"));
}

TEST_CASE("configuration: a dash in a text does not begin an attribute, a backslash in it does not continue "
          "the line",
          "[cfg]") {
    const CfgFile file =
        read("SIO:CFG_1.0:7:0::\n#\nT:\n\n      -Name \"a -b c\" -Path \"C:\\dir\\\" -N 1\n");
    CHECK(only(file).text("Name") == "a -b c");
    CHECK(only(file).text("Path") == "C:\\dir\\");
    CHECK(only(file).attributes.size() == 3);
}

TEST_CASE("configuration: derived types", "[cfg]") {
    const CfgFile file = read("MMC:CFG_1.0:7:0::\n#\nMMC_MC1 = MMC_PALETTE:\n\n      -name \"Motion\"\n");
    CHECK(file.sections[0].type == "MMC_MC1");
    CHECK(file.find("MMC_PALETTE").size() == 1);
}

TEST_CASE("configuration: ISO 8859-1 labels become UTF-8, UTF-8 stays", "[cfg]") {
    CHECK(only(read("EIO:CFG_1.0:6:1::\n#\nT:\n\n      -Label \"Gr\xF6\xDF"
                    "e\"\n"))
              .text("Label") == "Gr\xC3\xB6\xC3\x9F"
                                "e");
    CHECK(only(read("\xEF\xBB\xBF"
                    "EIO:CFG_1.0:7:0::\n#\nT:\n\n      -Label \"\xC3\xB6\"\n"))
              .text("Label") == "\xC3\xB6");
}

TEST_CASE("configuration: problems name file and line, the rest is read", "[cfg]") {
    std::vector<CfgProblem> problems;
    const CfgFile file =
        parseCfg("EIO:CFG_1.0:7:0::\n      -Name a\n#\nT:\n\n      -Name \"open\n\n      oops\n\n"
                 "      -Name \"b\"\n\n      -Name c \\\n",
                 "bad.cfg", problems);
    REQUIRE(problems.size() == 4);
    CHECK_THAT(problems[0].text(), Contains("bad.cfg:2:") && Contains("outside of a section"));
    CHECK_THAT(problems[1].text(), Contains("bad.cfg:6:") && Contains("quotation mark"));
    CHECK_THAT(problems[2].text(), Contains("bad.cfg:8:") && Contains("oops"));
    CHECK_THAT(problems[3].text(), Contains("continuation"));
    REQUIRE(file.sections.size() == 1);
    CHECK(file.sections[0].instances.size() == 3);
}

TEST_CASE("configuration: other texts are not taken for configurations", "[cfg]") {
    read("", 1);
    read("MODULE m\nENDMODULE\n", 1);
    read(std::string("\0\x01\xFF", 3), 1);
    std::vector<CfgProblem> problems;
    readCfg("/nowhere/EIO.cfg", problems);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].line == 0);
}

TEST_CASE("numbers are shown in their shortest form", "[cfg]") {
    CHECK(shortestNumber(1) == "1");
    CHECK(shortestNumber(static_cast<double>(0.1f)) == "0.1");
    CHECK(shortestNumber(0.1) == "0.1");
    CHECK(shortestNumber(-0.0) == "0");
    CHECK(shortestNumber(4294967295.0) == "4294967295");
    double value = 5;
    CHECK_FALSE(parseNumber("1x", value));
    CHECK_FALSE(parseNumber("nan", value));
    CHECK_FALSE(parseNumber("", value));
    CHECK(parseNumber(" +2.5e3 ", value));
    CHECK(value == 2500);
}

TEST_CASE("a section without a type is a mistake", "[cfg]") {
    std::vector<CfgProblem> problems;
    const CfgFile file = parseCfg("SYS:CFG_1.0:6:0::\n#\n:\n = BASE:\n", "X.cfg", problems);
    CHECK(file.sections.empty());
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].line == 3);
    CHECK(problems[1].line == 4);
}

TEST_CASE("problems of a file stay within bounds", "[cfg]") {
    std::string text = "SYS:CFG_1.0:6:0::\n";
    for (int i = 0; i < 100000; ++i)
        text += "nonsense without end\n";
    text += std::string(100000, 'x');
    std::vector<CfgProblem> problems;
    parseCfg(text, "X.cfg", problems);
    REQUIRE(problems.size() == rapid::config::kMaxCfgProblems + 1);
    CHECK(problems.back().message ==
          "there are 99,951 more mistakes in this file; correct those above first");
    problems.push_back({"X.cfg", 7, "a signal without a name"}); // of another reader
    problems.push_back({"Y.cfg", 7, "a signal without a name"});
    rapid::config::limitProblems(problems);
    REQUIRE(problems.size() == rapid::config::kMaxCfgProblems + 2);
    CHECK(problems.back().message ==
          "there are 99,952 more mistakes in this file; correct those above first");
    for (const CfgProblem& problem : problems)
        CHECK(problem.message.size() < 200);
}
