// The state file: what is written reads back; what is not one is refused, whatever it is.

#include "runtime/host/saved_state.h"

#include <catch2/catch.hpp>
#include <random>

using namespace rt;

namespace {

StateImage sample() {
    StateImage image;
    image.tasks["T_ROB1"] = {StateImage::Pointer::Inside, "Main:12"};
    image.tasks["T_IO"] = {StateImage::Pointer::Ended, ""};
    image.persistents["COUNT"] = {"num", "0", "17"};
    image.persistents["T_ROB1/MAIN/NAME"] = {"string", "\"\"", "\"gr\xC3\xBCn \\0A\""};
    image.variables["T_ROB1/MAIN/LIST"] = {"[2,2]num", "[[0,0],[0,0]]", "[[1,2],[3,4]]"};
    image.signals["DO1"] = 1;
    image.axes = {0.1, -20, 1.0 / 3, 0, 30, 0, 9e9};
    image.robot = "IRB 120-3/0.58";
    Event event;
    event.sequence = 41;
    event.number = 80001;
    event.type = EventType::Warning;
    event.title = "title";
    event.text = "bytes that are no text: \xFF";
    event.time = 1'500'000'000;
    event.place = {"Main", "main", "main.modx", 12, 3};
    event.arguments = {"a", "b"};
    image.events.push_back(event);
    return image;
}

} // namespace

TEST_CASE("a state reads back as it was written", "[state]") {
    StateImage again;
    REQUIRE(readImage(writeImage(sample()), again).empty());
    CHECK(again.tasks.at("T_ROB1").pointer == StateImage::Pointer::Inside);
    CHECK(again.tasks.at("T_ROB1").place == "Main:12");
    CHECK(again.tasks.at("T_IO").pointer == StateImage::Pointer::Ended);
    CHECK(again.persistents.at("COUNT").value == "17");
    CHECK(again.persistents.at("T_ROB1/MAIN/NAME").value == "\"gr\xC3\xBCn \\0A\"");
    CHECK(again.variables.at("T_ROB1/MAIN/LIST").type == "[2,2]num");
    CHECK(again.signals.at("DO1") == 1);
    CHECK(again.axes == sample().axes);
    REQUIRE(again.events.size() == 1);
    CHECK(again.events[0].sequence == 41);
    CHECK(again.events[0].place.line == 12);
    CHECK(again.events[0].arguments == std::vector<std::string>{"a", "b"});
}

TEST_CASE("no part of a state file is a state file", "[state]") {
    const std::string text = writeImage(sample());
    StateImage image;
    for (std::size_t length = 0; length + 2 < text.size(); ++length) {
        INFO(length);
        CHECK_FALSE(readImage(text.substr(0, length), image).empty());
    }
}

TEST_CASE("damaged state files are read or refused", "[state]") {
    const std::string text = writeImage(sample());
    std::mt19937 random(29);
    const std::string pieces = "[]{}\",:0123456789eE+-.ntf\\u";
    int refused = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string bad = text;
        for (int k = 1 + static_cast<int>(random() % 4); k > 0; --k) {
            const std::size_t at = random() % bad.size();
            if (random() % 3 == 0)
                bad.erase(at, random() % 30);
            else
                bad[at] = random() % 2 == 0 ? pieces[random() % pieces.size()] : static_cast<char>(random());
        }
        StateImage image;
        refused += readImage(bad, image).empty() ? 0 : 1;
    }
    CHECK(refused > 10000);
    StateImage image;
    CHECK(readImage("", image) == "it is no JSON text, or a part of one");
    CHECK(readImage("[1,2]", image) == "it is no state of a controller");
    CHECK(readImage("{}", image) == "it is no state of a controller");
    CHECK(readImage(std::string(1000000, '['), image) == "it is no JSON text, or a part of one");
}
