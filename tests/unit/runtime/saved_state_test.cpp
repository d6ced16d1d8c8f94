// The state file: what is written reads back; what is not one is refused, whatever it is.

#include "runtime/host/saved_state.h"

#include <catch2/catch.hpp>
#include <random>

using namespace rt;

namespace {

CallChain sampleChain() {
    CallChain chain;
    SavedFrame frame;
    frame.module = "Main";
    frame.routine = "main";
    frame.textHash = 4711;
    frame.statement = 5;
    frame.failed = 2;
    frame.locals.push_back({SavedLocal::Kind::Value, "num", "0.25", "", 0});
    frame.locals.push_back({SavedLocal::Kind::Object, "[2]num", "", "0:1", 8});
    frame.locals.push_back({SavedLocal::Kind::Absent, "string", "", "", 0});
    chain.frames.push_back(frame);
    chain.behindStop = true;
    chain.errors.errorNumber = 1003;
    chain.errors.text = "why";
    ErrorMemory::Retries retries;
    retries.statement = 2;
    retries.number = 1003;
    retries.counts = {{1003, 2}};
    chain.errors.retries.push_back(retries);
    ErrorMemory::Handled handled;
    handled.number = 1003;
    chain.errors.handled = handled;
    return chain;
}

StateImage sample() {
    StateImage image;
    StateImage::TaskImage& robot = image.tasks["T_ROB1"];
    robot.pointer = StateImage::Pointer::Inside;
    robot.place = "Main:12";
    robot.cycles = 2;
    robot.chain = sampleChain();
    robot.interruptsEnabled = false;
    robot.queuedInterrupts = {3, 3};
    StateImage::Interrupt interrupt;
    interrupt.what.number = 3;
    interrupt.what.ordered = true;
    interrupt.what.order = {"ITimer", "", {0.5}};
    interrupt.module = "Main";
    interrupt.routine = "onTime";
    robot.interrupts.push_back(interrupt);
    image.tasks["T_IO"].pointer = StateImage::Pointer::Ended;
    image.tasks["T_LEFT"].pointer = StateImage::Pointer::Exited;
    StateImage::TaskImage& lost = image.tasks["T_LOST"];
    lost.pointer = StateImage::Pointer::Inside;
    lost.refusal = "a reason";
    motion::MoveCommand move;
    move.kind = motion::MoveKind::Linear;
    move.target.pose.pos = {1, 2, 1.0 / 3};
    move.zone.finep = false;
    image.groups.resize(1);
    image.groups[0].path.moves.push_back(move);
    image.groups[0].path.begun = motion::Pose{{4, 5, 6}, {1, 0, 0, 0}};
    image.groups[0].path.stopMove.byMotionTask = true;
    image.kept["settings"] = "[1,2]";
    image.persistents["COUNT"] = {"num", "0", "17"};
    image.persistents["T_ROB1/MAIN/NAME"] = {"string", "\"\"", "\"gr\xC3\xBCn \\0A\""};
    image.variables["T_ROB1/MAIN/LIST"] = {"[2,2]num", "[[0,0],[0,0]]", "[[1,2],[3,4]]"};
    image.signals["DO1"] = 1;
    image.groups[0].axes = {0.1, -20, 1.0 / 3, 0, 30, 0, 9e9};
    image.groups[0].robot = "IRB 120-3/0.58";
    Event event;
    event.sequence = 41;
    event.number = 80001;
    event.type = EventType::Warning;
    event.title = "title";
    event.text = "bytes that are not text: \xFF";
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
    CHECK(again.tasks.at("T_LEFT").pointer == StateImage::Pointer::Exited);
    CHECK(again.tasks.at("T_LOST").refusal == "a reason");
    CHECK_FALSE(again.tasks.at("T_LOST").chain);
    REQUIRE(again.groups[0].path.moves.size() == 1);
    CHECK(again.groups[0].path.moves[0].kind == motion::MoveKind::Linear);
    CHECK(again.groups[0].path.moves[0].target.pose == sample().groups[0].path.moves[0].target.pose);
    CHECK_FALSE(again.groups[0].path.moves[0].zone.finep);
    CHECK_FALSE(again.groups[0].path.awaited);
    CHECK(again.groups[0].path.begun == sample().groups[0].path.begun);
    CHECK(again.groups[0].path.stopMove.byMotionTask);
    CHECK_FALSE(again.groups[0].path.stopMove.byOtherTask);
    CHECK(again.kept.at("settings") == "[1,2]");
    CHECK(again.persistents.at("COUNT").value == "17");
    CHECK(again.persistents.at("T_ROB1/MAIN/NAME").value == "\"gr\xC3\xBCn \\0A\"");
    CHECK(again.variables.at("T_ROB1/MAIN/LIST").type == "[2,2]num");
    CHECK(again.signals.at("DO1") == 1);
    CHECK(again.groups[0].axes == sample().groups[0].axes);
    REQUIRE(again.events.size() == 1);
    CHECK(again.events[0].sequence == 41);
    CHECK(again.events[0].place.line == 12);
    CHECK(again.events[0].arguments == std::vector<std::string>{"a", "b"});
}

TEST_CASE("a call chain and its interrupts read back as they were written", "[state]") {
    StateImage again;
    REQUIRE(readImage(writeImage(sample()), again).empty());
    const StateImage::TaskImage& robot = again.tasks.at("T_ROB1");
    CHECK(robot.cycles == 2);
    CHECK_FALSE(robot.interruptsEnabled);
    CHECK(robot.queuedInterrupts == std::vector<int>{3, 3});
    REQUIRE(robot.interrupts.size() == 1);
    CHECK(robot.interrupts[0].what.number == 3);
    CHECK(robot.interrupts[0].what.order.kind == "ITimer");
    CHECK(robot.interrupts[0].what.order.numbers == std::vector<double>{0.5});
    CHECK(robot.interrupts[0].routine == "onTime");
    REQUIRE(robot.chain);
    REQUIRE(robot.chain->frames.size() == 1);
    const SavedFrame& frame = robot.chain->frames[0];
    CHECK(frame.routine == "main");
    CHECK(frame.textHash == 4711);
    CHECK(frame.statement == 5);
    CHECK(frame.failed == 2);
    REQUIRE(frame.locals.size() == 3);
    CHECK(frame.locals[0].value == "0.25");
    CHECK(frame.locals[1].kind == SavedLocal::Kind::Object);
    CHECK(frame.locals[1].object == "0:1");
    CHECK(frame.locals[1].offset == 8);
    CHECK(frame.locals[2].kind == SavedLocal::Kind::Absent);
    CHECK(robot.chain->behindStop);
    CHECK(robot.chain->errors.errorNumber == 1003);
    REQUIRE(robot.chain->errors.retries.size() == 1);
    CHECK(robot.chain->errors.retries[0].counts.at(1003) == 2);
    REQUIRE(robot.chain->errors.handled);
    CHECK(robot.chain->errors.handled->number == 1003);
}

TEST_CASE("error numbers of earlier versions, written as decimal numbers, are read", "[state]") {
    std::string text = writeImage(sample());
    const std::size_t at = text.find("1003", text.find("\"errno\""));
    REQUIRE(at != std::string::npos);
    StateImage again;
    INFO(text.substr(at - 20, 60));
    REQUIRE(readImage(std::string(text).insert(at + 4, ".0"), again) == "");
    CHECK(again.tasks.at("T_ROB1").chain->errors.errorNumber == 1003);
    CHECK_FALSE(readImage(std::string(text).insert(at + 4, "e30"), again).empty());
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
    CHECK(readImage("", image) == "it is not JSON text, or only a part of it");
    CHECK(readImage("[1,2]", image) == "it is not the state of a controller");
    CHECK(readImage("{}", image) == "it is not the state of a controller");
    CHECK(readImage(std::string(1000000, '['), image) == "it is not JSON text, or only a part of it");
}
