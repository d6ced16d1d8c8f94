// The messages of EGM as bytes: what the published message definition says of fields, types and order.

#include "stdlib/impl/guided_motion/egm_messages.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using rt::lib::GuidanceMode;
using rt::lib::RobotData;
using rt::lib::SensorData;

namespace {

std::string real(unsigned field, double value) {
    std::string bytes(1, static_cast<char>(field << 3U | 1U));
    const auto bits = std::bit_cast<uint64_t>(value);
    for (unsigned i = 0; i < 8; ++i)
        bytes.push_back(static_cast<char>(bits >> (8 * i) & 0xFFU));
    return bytes;
}

std::string part(unsigned field, const std::string& content) {
    return std::string{static_cast<char>(field << 3U | 2U), static_cast<char>(content.size())} + content;
}

std::string record(const std::vector<double>& values) {
    std::string bytes;
    for (std::size_t i = 0; i < values.size(); ++i)
        bytes += real(static_cast<unsigned>(i + 1), values[i]);
    return bytes;
}

std::string list(const std::vector<double>& values) {
    std::string bytes;
    for (const double value : values)
        bytes += real(1, value);
    return bytes;
}

std::string header(int type) {
    return part(1, std::string{'\x18', static_cast<char>(type)});
}

std::string decode(const std::string& bytes, GuidanceMode mode, SensorData& data) {
    data = {};
    return rt::lib::decodeSensorMessage(bytes, mode, data);
}

const std::vector<double> kJoints{10, 20, 30, 40, 50, 60};

} // namespace

TEST_CASE("joints of a sensor message are taken, one by one and packed", "[egm]") {
    SensorData data;
    REQUIRE(decode(header(3) + part(2, part(1, list(kJoints))), GuidanceMode::Joint, data).empty());
    CHECK(data.joints[0] == 10);
    CHECK(data.joints[5] == 60);
    CHECK_FALSE(data.joints[6]);

    std::string packed;
    for (const double value : kJoints)
        packed += real(1, value).substr(1);
    const std::string external = part(3, list({7}));
    REQUIRE(
        decode(header(3) + part(2, part(1, part(1, packed)) + external), GuidanceMode::Joint, data).empty());
    CHECK(data.joints[1] == 20);
    CHECK(data.joints[6] == 7); // axis 7 is an external joint
}

TEST_CASE("poses need a position and an orientation; of two orientations the angles count", "[egm]") {
    SensorData data;
    const std::string place = part(1, record({1, 2, 3}));
    const std::string turn = part(2, record({1, 0, 0, 0}));
    const std::string angles = part(3, record({4, 5, 6}));
    const auto pose = [](const std::string& content) { return header(3) + part(2, part(2, content)); };
    REQUIRE(decode(pose(place + turn), GuidanceMode::Pose, data).empty());
    CHECK(data.pose[2] == 3);
    REQUIRE(data.orientation);
    CHECK(data.orientation->w == 1);
    REQUIRE(decode(pose(place + angles + turn), GuidanceMode::Pose, data).empty());
    CHECK_FALSE(data.orientation);
    CHECK(data.pose[5] == 6);
    CHECK_FALSE(decode(pose(place), GuidanceMode::Pose, data).empty());
    CHECK_FALSE(decode(pose(turn), GuidanceMode::Pose, data).empty());
    CHECK_FALSE(decode(pose(place + part(2, record({2, 0, 0, 0}))), GuidanceMode::Pose, data).empty());
    CHECK_FALSE(decode(pose(part(1, record({1, 2})) + turn), GuidanceMode::Pose, data).empty());
}

TEST_CASE("messages that cannot be used are refused with the reason", "[egm]") {
    SensorData data;
    const std::string good = part(2, part(1, list(kJoints)));
    CHECK(decode(header(4) + good, GuidanceMode::Joint, data).find("CORRECTION") != std::string::npos);
    CHECK(decode(good, GuidanceMode::Joint, data).find("CORRECTION") != std::string::npos);
    CHECK(decode(header(3) + part(2, part(1, list({1, 2, 3}))), GuidanceMode::Joint, data).find("six") !=
          std::string::npos);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK(decode(header(3) + part(2, part(1, list({bad, 0, 0, 0, 0, 0}))), GuidanceMode::Joint, data)
                  .find("finite") != std::string::npos);
    CHECK(decode(header(4), GuidanceMode::PathCorrection, data).find("position") != std::string::npos);
    CHECK_FALSE(decode(header(3) + good, GuidanceMode::PathCorrection, data).empty());
}

TEST_CASE("a path correction is a position in path coordinates", "[egm]") {
    SensorData data;
    const std::string place = part(1, record({0, 2, -3}));
    const std::string age = std::string{'\x10', '\x01'};
    REQUIRE(decode(header(4) + part(2, place + age), GuidanceMode::PathCorrection, data).empty());
    CHECK(data.pose[1] == 2);
    CHECK(data.pose[2] == -3);
    CHECK_FALSE(decode(header(4) + part(2, age), GuidanceMode::PathCorrection, data).empty());
    CHECK_FALSE(
        decode(header(4) + part(2, part(1, record({0, 2}))), GuidanceMode::PathCorrection, data).empty());
    const std::string bad = part(1, record({0, std::nan(""), 0}));
    CHECK(decode(header(4) + part(2, bad), GuidanceMode::PathCorrection, data).find("finite") !=
          std::string::npos);
}

TEST_CASE("external joints are additional axes from eax_a on", "[egm]") {
    SensorData data;
    const std::string external = part(3, list({7, -8}));
    REQUIRE(
        decode(header(3) + part(2, part(1, list(kJoints)) + external), GuidanceMode::Joint, data).empty());
    CHECK(data.additional[0] == 7);
    CHECK(data.additional[1] == -8);
    CHECK_FALSE(data.additional[2]);
}

TEST_CASE("a message that is cut anywhere is refused or lacks what came after", "[egm]") {
    SensorData data;
    const std::string whole = header(3) + part(2, part(1, list(kJoints)));
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_FALSE(decode(whole.substr(0, length), GuidanceMode::Joint, data).empty());
}

TEST_CASE("the message of the robot begins with its header and fits a datagram", "[egm]") {
    RobotData data;
    data.feedback.joints = {10, 20, 30, 40, 50, 60};
    data.planned = data.feedback;
    data.nanoseconds = 300'000'000; // 300 ms are AC 02
    const std::string bytes = rt::lib::encodeRobotMessage(data, 5);
    CHECK(bytes.substr(0, 9) == std::string("\x0A\x07\x08\x05\x10\xAC\x02\x18\x02", 9));
    CHECK(bytes.size() < 1500);
    CHECK(bytes.find(part(1, list({10, 20, 30, 40, 50, 60}))) != std::string::npos);
}
