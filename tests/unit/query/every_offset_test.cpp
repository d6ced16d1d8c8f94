// Every query over programs of the tests, correct and broken ones: no crash, and ranges within the texts.

#include "every_query.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

std::vector<std::string> programs(const char* folder) {
    std::vector<std::string> paths;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(RAPIDC_SOURCE_DIR "/tests/") + folder))
        if (entry.path().extension() == ".modx") paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// Some offsets of the text: they are spread over it, and differ from file to file.
void askAll(const std::string& path, const std::string& text, size_t places) {
    INFO(path);
    const auto checked = sema::testing::checkTexts({text});
    const Snapshot snapshot(*checked->program);
    const FileView* file = snapshot.file("t1_1.modx");
    REQUIRE(file);
    EveryQuery query(snapshot, *file);
    CHECK(query.whole() == nullptr);
    const size_t step = std::max<size_t>(1, file->text().size() / places);
    for (size_t offset = path.size() % step; offset <= file->text().size() + 1; offset += step) {
        INFO(offset);
        CHECK(query.at(static_cast<uint32_t>(offset)) == nullptr);
    }
}

} // namespace

TEST_CASE("query: every query in correct and broken programs", "[query][every]") {
    size_t number = 0;
    for (const char* folder : {"golden", "diag"})
        for (const std::string& path : programs(folder))
            if (++number % 23 == 0) askAll(path, sema::testing::readFile(path), 20);
    REQUIRE(number > 500);
}

TEST_CASE("query: every query in a text that is cut off", "[query][every]") {
    const std::string text =
        "MODULE m\nRECORD r\nnum a;\nENDRECORD\nVAR r x{2};\nPROC report(string t\\num n|switch "
        "s)\nx{1}.a:=Abs(-1)+n;\n"
        "IF Present(n) AND x{1}.a>2 MoveL "
        "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100\\T:=1,fine,tool0;\n"
        "FOR i FROM 1 TO 2 DO\nTEST i\nCASE 1:\nCONNECT i WITH t;\nDEFAULT:\nENDTEST\nENDFOR\n%\"re\"+\"x\"% "
        "\\n:=1;\nERROR (ERR_DIVZERO)\nRETRY;\nENDPROC\nENDMODULE\n";
    for (size_t length = 0; length < text.size(); length += 7)
        askAll("cut off at " + std::to_string(length), text.substr(0, length), 4);
}
