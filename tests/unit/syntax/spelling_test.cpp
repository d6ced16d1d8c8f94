// Distance between words: the measure of "did you mean".

#include "frontend/source/spelling.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

using rapid::editDistance;

namespace {

/// The same by the definition: insert, delete, replace, swap neighbours (none of them touched again).
unsigned byDefinition(const std::string& a, const std::string& b) {
    std::vector<std::vector<unsigned>> d(a.size() + 1, std::vector<unsigned>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) {
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = static_cast<unsigned>(i + j);
                continue;
            }
            d[i][j] = std::min(
                {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

/// All words of up to five letters from "ab", and some longer ones.
std::vector<std::string> words() {
    std::vector<std::string> all{""};
    for (size_t i = 0; all[i].size() < 5; ++i)
        for (const char c : {'a', 'b'})
            all.push_back(all[i] + c);
    for (const char* word :
         {"velocity", "veloctiy", "velcity", "velocities", "vleoicty", "city", "xvelocity"})
        all.emplace_back(word);
    return all;
}

} // namespace

TEST_CASE("the distance of two words is given up to the limit", "[source]") {
    const std::vector<std::string> all = words();
    for (const std::string& a : all) {
        for (const std::string& b : all) {
            const unsigned exact = byDefinition(a, b);
            for (unsigned limit = 1; limit <= 3; ++limit) {
                const unsigned given = editDistance(a, b, limit);
                if (given == std::min(exact, limit + 1)) continue;
                INFO(a << " " << b << " limit " << limit);
                CHECK(given == std::min(exact, limit + 1));
            }
        }
    }
    CHECK(editDistance(std::string(63, 'a'), std::string(62, 'a'), 2) == 1);
    CHECK(editDistance(std::string(64, 'a'), std::string(64, 'a'), 2) == 3); // too long to measure
}

TEST_CASE("the shapes of two words rule out only what is far", "[source]") {
    std::vector<std::string> all = words();
    for (const char* word : {"v100", "v1000", "z50", "a_b", "ab_", "p10_x", "\xC3\xA4nd", "veloc1ty"})
        all.emplace_back(word);
    for (const std::string& a : all)
        for (const std::string& b : all)
            for (unsigned limit = 1; limit <= 3; ++limit) {
                if (byDefinition(a, b) > limit) continue;
                INFO(a << " " << b << " limit " << limit);
                CHECK(rapid::mayBeNear(rapid::shapeOf(a), rapid::shapeOf(b), limit));
            }
    CHECK_FALSE(rapid::mayBeNear(rapid::shapeOf("velocity"), rapid::shapeOf("distance"), 2));
    CHECK_FALSE(rapid::mayBeNear(rapid::shapeOf("ab"), rapid::shapeOf("abbbb"), 2));
}
