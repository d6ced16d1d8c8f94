// One rule for upper and lower case: ASCII, and the letters of ISO 8859-1 in UTF-8 (manual 1.1.2).

#include "config/letter_case.h"

#include <catch2/catch.hpp>

using namespace rapid::config;

TEST_CASE("letters of ASCII and of ISO 8859-1 change their case, other bytes do not", "[config]") {
    CHECK(lowerCase("PosA_1") == "posa_1");
    CHECK(upperCase("PosA_1") == "POSA_1");
    CHECK(lowerCase("\u00C9tape\u00DE") == "\u00E9tape\u00FE");
    CHECK(upperCase("\u00E9tape\u00FE") == "\u00C9TAPE\u00DE");
    // The multiplication and division signs are between the letters; sharp s and y with dots have no partner there.
    CHECK(lowerCase("\u00D7\u00F7\u00DF") == "\u00D7\u00F7\u00DF");
    CHECK(upperCase("\u00D7\u00F7\u00DF\u00FF") == "\u00D7\u00F7\u00DF\u00FF");
    // The same second bytes after another first byte belong to other letters.
    CHECK(lowerCase("\u0109\u0149") == "\u0109\u0149");
    CHECK(lowerCase("\x89") == "\x89");
}

TEST_CASE("names are compared without regard to case", "[config]") {
    CHECK(sameName("Gr\u00D6sse", "GR\u00F6SSE"));
    CHECK(sameName("", ""));
    CHECK_FALSE(sameName("a", "ab"));
    CHECK_FALSE(sameName("\u00D7", "\u00F7"));
    CHECK_FALSE(sameName("[", "{")); // they differ in the bit of the case
    CHECK(compareNames("Alpha", "alpHA") == 0);
    CHECK(compareNames("a", "B") < 0);
    CHECK(compareNames("Z1", "a1") > 0);
    CHECK(compareNames("ab", "A") > 0); // the longer one comes later
    CHECK(compareNames("", "a") < 0);
    CHECK(compareNames("\u00C9", "\u00E9") == 0);
    CHECK(compareNames("z", "\u00E4") < 0); // letters beyond ASCII come last, as bytes
    CHECK(beginsWithName("T_Rob1", "t_"));
    CHECK_FALSE(beginsWithName("T", "t_"));
    CHECK(endsWithName("main.MODX", ".modx"));
    CHECK(containsName("nUnusedPart", "unused"));
}
