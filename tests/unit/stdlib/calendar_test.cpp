#include "stdlib/impl/time/calendar.h"

#include <catch2/catch.hpp>

using namespace rt::lib;

TEST_CASE("the virtual epoch is the first second of 2026, a Thursday", "[stdlib][time]") {
    const DateTime start = dateTimeOf(kVirtualEpoch);
    CHECK((start.year == 2026 && start.month == 1 && start.day == 1));
    CHECK(start.weekday == 4);
    CHECK((start.hour == 0 && start.minute == 0 && start.second == 0));
}

TEST_CASE("dates follow the Gregorian calendar", "[stdlib][time]") {
    const DateTime leap = dateTimeOf(951868799); // one second before 2000-03-01
    CHECK((leap.year == 2000 && leap.month == 2 && leap.day == 29));
    CHECK((leap.hour == 23 && leap.minute == 59 && leap.second == 59));
    CHECK(leap.weekday == 2);
    CHECK(dateTimeOf(0).weekday == 4);
    CHECK(dateTimeOf(3 * 86400).weekday == 7); // Sunday is 7
}
