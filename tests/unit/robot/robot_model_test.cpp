// Robot models as data: every shipped file is sound, names are found the way people spell them, bad files are
// refused.

#include "runtime/robot/embedded_models.h"
#include "runtime/robot/robot_model.h"
#include "tests/unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

using namespace robot;

namespace {

std::string textOf(const std::string& name) {
    for (std::string_view text : embeddedModelTexts()) {
        if (text.find("\"name\": \"" + name + "\"") != std::string_view::npos) return std::string(text);
    }
    return {};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::string nameFor(const std::string& query) {
    const auto model = loadRobotModel(query);
    return model ? model->name : "error: " + model.error().message;
}

/// Distance in mm from axis 1 of the point that the reach in the name speaks of.
double stretchedReach(const RobotModel& model) {
    switch (model.kinematics) {
    case KinematicsKind::SphericalWrist:
    case KinematicsKind::OffsetWrist:
        return model.geometry.a1 + model.geometry.c2 + std::hypot(model.geometry.c3, model.geometry.a2);
    case KinematicsKind::SevenAxes: // shoulder to wrist centre, all axes in their best places
        return std::hypot(model.sevenAxes.upperArm, model.sevenAxes.elbowOut) +
               std::hypot(model.sevenAxes.forearm, model.sevenAxes.elbowUp) +
               std::fabs(model.sevenAxes.shoulder);
    case KinematicsKind::
        ParallelRods: { // the rods do not let the arms come in line: axis 2 at its forward limit
        const ParallelRodGeometry& g = model.parallelRods;
        const double angle = model.upperDeg[1] * std::numbers::pi / 180;
        return g.a1 + g.c2 * std::sin(angle) + g.c3 + g.out;
    }
    case KinematicsKind::Scara: return model.scara.upperArm + model.scara.forearm;
    case KinematicsKind::Delta: return 1000 * model.reachM; // a chosen cylinder, not the whole reach
    case KinematicsKind::NoArm: break;
    }
    return 0;
}

} // namespace

TEST_CASE("every shipped model is readable and its stretched reach fits its name", "[robot][model]") {
    REQUIRE(embeddedModelTexts().size() >= 60);
    // Published reach that is not the stretched wrist centre.
    const std::string exceptions =
        "IRB 6700-245/3.0 IRB 7600-325/3.1 IRB 6650S-200/3.0 IRB 6650S-90/3.9 IRB 4400L-30/2.43";
    for (std::string_view text : embeddedModelTexts()) {
        const auto model = parseRobotModel(text, "shipped");
        INFO(text);
        if (!model) FAIL(model.error().message);
        CHECK(model->payloadKg > 0);
        if (exceptions.find(model->name) == std::string::npos) {
            // The rods hold axis 2 back from its limit when axis 3 is level, which the model does not know.
            const double tolerance = model->kinematics == KinematicsKind::ParallelRods ? 60 : 26;
            CHECK(std::fabs(stretchedReach(*model) - 1000 * model->reachM) <= tolerance);
        }
        REQUIRE(model->maxSpeed.size() == model->lowerDeg.size());
        for (std::size_t i = 0; i < model->lowerDeg.size(); ++i) {
            CHECK(model->lowerDeg[i] < 0);
            const bool isLinear = model->kinematics == KinematicsKind::Scara && i == 2;
            CHECK((isLinear ? model->upperDeg[i] == 0 : model->upperDeg[i] > 0)); // a SCARA moves down from 0
        }
        CHECK(nameFor(model->name) == model->name);
    }
}

TEST_CASE("the figures of the IRB 120 are in the model", "[robot][model]") {
    const auto model = loadRobotModel("IRB 120-3/0.58");
    REQUIRE(model.hasValue());
    CHECK(model->payloadKg == 3);
    CHECK(model->reachM == 0.58);
    CHECK(model->geometry.a2 == -70);
    CHECK(model->geometry.c4 == 72);
    CHECK(model->upperDeg == Joints{165, 110, 70, 160, 120, 400});
    CHECK(model->maxSpeed == Joints{250, 250, 250, 320, 320, 420});
    CHECK(model->kinematics == KinematicsKind::SphericalWrist);
    CHECK_FALSE(model->provisional.empty()); // accelerations are nowhere published
}

TEST_CASE("arms of four and seven axes are data as well", "[robot][model]") {
    const auto yumi = loadRobotModel("IRB 14050");
    REQUIRE(yumi.hasValue());
    CHECK(yumi->kinematics == KinematicsKind::SevenAxes);
    CHECK(yumi->lowerDeg.size() == 7);
    CHECK(yumi->upperDeg[6] == 168.5); // axis 7 comes last, as in a jointtarget
    const auto palletizer = loadRobotModel("IRB 460");
    REQUIRE(palletizer.hasValue());
    CHECK(palletizer->lowerDeg.size() == 4);
    CHECK(palletizer->axisNumbers[3] == 6); // there are no axes 4 and 5
    const std::string text = textOf("IRB 460-110/2.4");
    const auto complaint = [&](const std::string& from, const std::string& to) {
        const auto model = parseRobotModel(replaced(text, from, to), "test.json");
        return model ? std::string("accepted") : model.error().message;
    };
    using Catch::Contains;
    CHECK_THAT(complaint("[1, 2, 3, 6]", "[1, 2, 3, 8]"), Contains("axis_numbers"));
    CHECK_THAT(complaint("[1, 2, 3, 6]", "[1, 2, 2, 6]"), Contains("axis_numbers"));
    CHECK_THAT(complaint("[0, 0, 1, 0]", "[1, 0, 0, 0]"), Contains("flange_rot"));
    CHECK_THAT(complaint("\"c3\": 1025", "\"c3\": 0"), Contains("c3"));
    CHECK_THAT(complaint("[-165, 165], ", ""), Contains("4 pairs"));
    CHECK(loadRobotModel("IRB 14000").error().message.find("IRB 14000-0.5/0.559-L") != std::string::npos);
}

TEST_CASE("names are found in the spellings people and controllers use", "[robot][model]") {
    CHECK(nameFor("IRB 120-3/0.58") == "IRB 120-3/0.58");
    CHECK(nameFor("irb 120-3/0.58") == "IRB 120-3/0.58");
    CHECK(nameFor("IRB120") == "IRB 120-3/0.58");
    CHECK(nameFor("IRB 120") == "IRB 120-3/0.58");
    CHECK(nameFor("irb120t") == "IRB 120T-3/0.58");
    CHECK(nameFor("120-3/0.58") == "IRB 120-3/0.58");
    CHECK(nameFor("IRB_120_3_0.58") == "IRB 120-3/0.58");
    CHECK(nameFor("ROB1_120_0.58_3") == "IRB 120-3/0.58");
    CHECK(nameFor("ROB1_1660ID_1.55_4") == "IRB 1660ID-4/1.55");
    CHECK(nameFor("ROB1_1200_0.9_5_TypeB") == "IRB 1200-5/0.9"); // an edition with the same axes
    CHECK(nameFor("IRB 4600-40/2.55 Type B") == "IRB 4600-40/2.55");
    CHECK(nameFor("ROB_1_6700_3.20_150") == "IRB 6700-150/3.2");
    CHECK(nameFor("IRB 1200-5") == "IRB 1200-5/0.9");
    CHECK(nameFor("IRB 1200/0.7") == "IRB 1200-7/0.7");
    CHECK(nameFor("IRB 5710-90/2.3") == "IRB 5710-90/2.3-LID");
    CHECK(nameFor("ROB_R_14000_05_05_TYPEA") == "IRB 14000-0.5/0.559-R"); // 0.5 kg, 0.5 m, the right arm
    CHECK(nameFor("ROB_L_14000_05_05_TYPEA") == "IRB 14000-0.5/0.559-L");
    CHECK(nameFor("ROB_L_14000_0.5_0.5") == "IRB 14000-0.5/0.559-L");
    CHECK(nameFor("IRB 14050-0.5/0.5") == "IRB 14050-0.5/0.559");
    CHECK(loadRobotModel("CRB 15000-5/0.95")->kinematics == KinematicsKind::OffsetWrist);
}

TEST_CASE("an ambiguous name lists what it may mean, an unknown one what is near", "[robot][model]") {
    const auto ambiguous = loadRobotModel("IRB 1200");
    REQUIRE_FALSE(ambiguous.hasValue());
    CHECK(ambiguous.error().message.find("ambiguous") != std::string::npos);
    CHECK(ambiguous.error().message.find("IRB 1200-5/0.9") != std::string::npos);
    CHECK(ambiguous.error().message.find("IRB 1200-7/0.7") != std::string::npos);

    const auto unknown = loadRobotModel("IRB 121-3/0.58");
    REQUIRE_FALSE(unknown.hasValue());
    CHECK(unknown.error().message.find("IRB 120-3/0.58") != std::string::npos);
    for (const char* bad : {"", " ", "ROB1", "irb", "-/-", "KUKA KR 6"}) {
        CHECK_FALSE(loadRobotModel(bad).hasValue());
    }
    CHECK_FALSE(loadRobotModel("IRB 120-5/0.58").hasValue()); // no such payload
}

TEST_CASE("a model is data: a new file needs no new build", "[robot][model]") {
    TemporaryFolder folder;
    folder.write("mine.json", replaced(textOf("IRB 120-3/0.58"), "IRB 120-3/0.58", "IRB 99-1/0.5"));
    folder.write("faster.json", replaced(textOf("IRB 140-6/0.81"), "[200, 200, 260,", "[222, 200, 260,"));
    const std::string folders[] = {folder.path.string()};
    REQUIRE(loadRobotModel("IRB99", folders).hasValue());
    CHECK(loadRobotModel("IRB 140", folders)->maxSpeed[0] == 222); // a folder overrides a shipped model
    CHECK(loadRobotModel("IRB 140")->maxSpeed[0] == 200);
    CHECK(loadRobotModel((folder.path / "mine.json").string())->name == "IRB 99-1/0.5");
    CHECK_FALSE(loadRobotModel((folder.path / "none.json").string()).hasValue());
    CHECK_FALSE(loadRobotModel("IRB99").hasValue());

    folder.write("broken.json", "{");
    CHECK(loadRobotModel("IRB 140", folders).hasValue()); // an unused file does no harm
    const auto missing = loadRobotModel("IRB 77", folders);
    REQUIRE_FALSE(missing.hasValue());
    CHECK(missing.error().message.find("broken.json") != std::string::npos);
}

TEST_CASE("a data file that is wrong is refused with the field at fault", "[robot][model]") {
    const std::string good = textOf("IRB 120-3/0.58");
    REQUIRE(parseRobotModel(good, "test").hasValue());
    const auto complaint = [&](const std::string& from, const std::string& to) {
        const auto model = parseRobotModel(replaced(good, from, to), "test.json");
        return model ? std::string("accepted") : model.error().message;
    };
    using Catch::Contains;
    CHECK_THAT(complaint("\"payload_kg\"", "\"payload\""), Contains("payload"));
    CHECK_THAT(complaint("\"format\": 1", "\"format\": 2"), Contains("format"));
    CHECK_THAT(complaint("\"c2\": 270", "\"c2\": 0"), Contains("c2"));
    CHECK_THAT(complaint("\"c2\": 270", "\"c2\": \"270\""), Contains("c2"));
    CHECK_THAT(complaint("[-165, 165]", "[165, -165]"), Contains("joint_limits_deg"));
    CHECK_THAT(complaint("[-165, 165]", "[-165]"), Contains("joint_limits_deg"));
    CHECK_THAT(complaint("[250, 250,", "[0, 250,"), Contains("max_speed_deg_s"));
    CHECK_THAT(complaint("[250, 250,", "[250,"), Contains("max_speed_deg_s"));
    CHECK_THAT(complaint("[1, 1, 1, 1, 1, 1]", "[1, 1, 2, 1, 1, 1]"), Contains("joint_signs"));
    CHECK_THAT(complaint("spherical-wrist", "magic"), Contains("kinematics"));
    CHECK_THAT(complaint("spherical-wrist", "seven-axes"), Contains("base"));
    CHECK_THAT(complaint("spherical-wrist", "scara"), Contains("height"));
    CHECK_THAT(complaint("\"sources\"", "\"source\""), Contains("not known"));
    CHECK_THAT(complaint("{\n", "{\n,"), Contains("not JSON"));
    CHECK_THAT(complaint("{\n", "[{\n"), Contains("not JSON"));
    CHECK_THAT(complaint("\"name\": \"IRB 120-3/0.58\"", "\"name\": \"\""), Contains("name"));
    CHECK_FALSE(parseRobotModel("", "empty").hasValue());
    CHECK_FALSE(parseRobotModel("[]", "array").hasValue());
    CHECK_FALSE(parseRobotModel("null", "null").hasValue());
}

TEST_CASE("a robot that is not in the catalogue is like one of its family, reach and payload", "[robot]") {
    CHECK(robot::similarRobotModel("ROB1_121_0.60_3") == "IRB 120-3/0.58");
    CHECK(robot::similarRobotModel("ROB1_360_1.6_6") == "IRB 360-1/1600");
    CHECK(robot::similarRobotModel("IRB 1200-5/0.95") == "IRB 1200-5/0.9");
    CHECK(robot::similarRobotModel("ROB1_99999_9.9_9").empty());
    CHECK(robot::similarRobotModel("").empty());
}
