// Quantities of simulated devices: names, values, listeners, and their lines in a stimulus.

#include "runtime/sim/stimulus.h"
#include "runtime/sim/surroundings.h"

#include <catch2/catch.hpp>

using namespace rt;

TEST_CASE("a quantity has a unit and a name", "[surroundings]") {
    const auto name = Surroundings::split("ROB_1.external_torque_2");
    REQUIRE(name);
    CHECK(name->unit == "ROB_1");
    CHECK(name->quantity == "external_torque_2");
    CHECK_FALSE(Surroundings::split("diStart"));
    CHECK_FALSE(Surroundings::split(".part"));
    CHECK_FALSE(Surroundings::split("ROB_1."));
}

TEST_CASE("only known quantities with numbers in range are accepted", "[surroundings]") {
    CHECK(Surroundings::problemOf("part").empty());
    CHECK(Surroundings::problemOf("PART").empty());
    CHECK(Surroundings::problemOf("external_torque_7").empty());
    CHECK(Surroundings::problemOf("variable_65535").empty());
    CHECK_FALSE(Surroundings::problemOf("external_torque").empty());
    CHECK_FALSE(Surroundings::problemOf("external_torque_8").empty());
    CHECK_FALSE(Surroundings::problemOf("part_1").empty());
    CHECK_FALSE(Surroundings::problemOf("variable_65536").empty());
    CHECK(Surroundings::problemOf("colour").find("expected external_torque_N") != std::string::npos);
}

TEST_CASE("the latest value counts, without regard to case, and listeners hear of it", "[surroundings]") {
    Surroundings around;
    CHECK_FALSE(around.find("GUN1", "thickness"));
    CHECK(around.value("GUN1", "thickness", 7) == 7);
    double heard = 0;
    const uint64_t token =
        around.addListener([&](const Surroundings::Name&, double value) { heard = value; });
    around.set({"gun1", "Thickness"}, 3);
    CHECK(around.value("GUN1", "thickness") == 3);
    CHECK(heard == 3);
    around.removeListener(token);
    around.set({"GUN1", "variable_12"}, 5);
    CHECK(heard == 3);
    CHECK(around.value("GUN1", "variable", 12, 0) == 5);
}

TEST_CASE("a stimulus sets quantities", "[surroundings]") {
    std::vector<StimulusProblem> problems;
    const auto items = parseStimulus("1,ROB_1.part,8.5\n2,ROB_1.colour,3\n3,ROB_1.part,red\n", problems);
    REQUIRE(items.size() == 1);
    CHECK(items[0].kind == StimulusKind::Quantity);
    CHECK(items[0].target == "ROB_1.part");
    CHECK(items[0].value == 8.5);
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].line == 2);
    CHECK(problems[1].message == "'red' is not a value for ROB_1.part");
}
