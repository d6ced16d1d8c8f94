#include "config/cfg_writer.h"

#include <catch2/catch.hpp>

using namespace rapid::config;

namespace {

CfgFile parsed(const std::string& text) {
    std::vector<CfgProblem> problems;
    CfgFile file = parseCfg(text, "EIO.cfg", problems);
    REQUIRE(problems.empty());
    return file;
}

void checkSame(const CfgFile& a, const CfgFile& b) {
    CHECK(a.domain == b.domain);
    CHECK(a.version == b.version);
    REQUIRE(a.sections.size() == b.sections.size());
    for (std::size_t s = 0; s < a.sections.size(); ++s) {
        CHECK(a.sections[s].type == b.sections[s].type);
        CHECK(a.sections[s].baseType == b.sections[s].baseType);
        REQUIRE(a.sections[s].instances.size() == b.sections[s].instances.size());
        for (std::size_t i = 0; i < a.sections[s].instances.size(); ++i) {
            const auto &first = a.sections[s].instances[i].attributes,
                       &second = b.sections[s].instances[i].attributes;
            REQUIRE(first.size() == second.size());
            for (std::size_t n = 0; n < first.size(); ++n) {
                CHECK(first[n].name == second[n].name);
                CHECK(first[n].values == second[n].values);
                CHECK(first[n].quoted == second[n].quoted);
            }
        }
    }
}

} // namespace

TEST_CASE("a configuration reads back as it was written", "[config]") {
    const CfgFile file = parsed("EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n"
                                "      -Name \"doLamp\" -SignalType \"DO\" -Label \"text, with \\ # and - "
                                "signs\" -DeviceMap \"0-3,8\"\\\n"
                                "      -Default 1 -Negative -1 -FiltAct  -List 30,82\n\n"
                                "      -Name \"x\" -Empty \"\"\n#\nA = B:\n\n      -name \"one\"\n");
    const std::string text = writeCfg(file);
    checkSame(parsed(text), file);
    // a boolean by presence alone, with a blank after it; lines of at most 80 columns (facts 6.1)
    CHECK(text.find("-FiltAct ") != std::string::npos);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        CHECK(end - begin <= 81);
        begin = end + 1;
    }
    CHECK(text.find("#\nA = B:\n") != std::string::npos);
}

TEST_CASE("values that look like something else are quoted", "[config]") {
    CfgFile file{{}, "EIO", "CFG_1.0:7:0::", {{"T", {}, {{}}, 0}}};
    for (const char* value : {"-name", "two words", "a,b", "", "back\\", "#", "plain", "-1.5", "-"})
        file.sections[0].instances[0].attributes.push_back({"A", {value}, false, 0});
    const CfgFile back = parsed(writeCfg(file));
    const auto& written = file.sections[0].instances[0].attributes;
    const auto& found = back.sections[0].instances[0].attributes;
    REQUIRE(found.size() == written.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i].values == written[i].values);
}

TEST_CASE("what the format cannot hold is not a value", "[config]") {
    CHECK(isCfgValue("a b, c\\"));
    CHECK_FALSE(isCfgValue("say \"no\""));
    CHECK_FALSE(isCfgValue("two\nlines"));
    CHECK_FALSE(isCfgValue(std::string("nul\0", 4)));
    CHECK(isCfgName("Act1_invert"));
    CHECK_FALSE(isCfgName("1st"));
    CHECK_FALSE(isCfgName("a b"));
    CHECK_FALSE(isCfgName(""));
}

TEST_CASE("ISO 8859-1 only where it reads back", "[config]") {
    CHECK(toLatin1("f\xC3\xBCr") == "f\xFCr");
    CHECK(toLatin1("plain") == "plain");
    CHECK(toLatin1("\xE2\x82\xAC") == "\xE2\x82\xAC");         // a euro sign has no place
    CHECK(toLatin1("\xC3\x83\xC2\xA9") == "\xC3\x83\xC2\xA9"); // the bytes C3 A9 would be read as one letter
}
