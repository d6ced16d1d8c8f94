#include "unit/runtime/test_program.h"

#include "runtime/io/io_system.h"

#include <catch2/catch.hpp>

using namespace rt;
using Catch::Matchers::Contains;

namespace {

/// An I/O system on a clock of its own; a task is not needed for timed changes.
struct IoBench {
    Scheduler scheduler{{}};
    IoSystem io{scheduler};
    std::vector<CfgProblem> problems;
    std::vector<std::string> changes;

    explicit IoBench(const std::string& sections = "") {
        const std::string text = "EIO:CFG_1.0:7:0::\n\n" + sections;
        io.configure(parseCfg(text, "EIO.cfg", problems), problems);
        io.finishConfiguration(problems);
        io.addListener(-1, [this](SignalId id, double, double value) {
            changes.push_back(formatSeconds(scheduler.now(), 1) + " " + io.config(id).name + "=" +
                              std::to_string(static_cast<int64_t>(value)));
        });
    }
    Handle handle(const char* name) const { return IoSystem::handleOf(io.find(name)); }
    double value(const char* name) const { return io.value(io.find(name)); }
    void runTo(Time time) {
        scheduler.at(time, [] {});
        scheduler.run([&] { return scheduler.now() >= time; });
    }
};

std::string signals(std::initializer_list<const char*> rows) {
    std::string text = "#\n\nEIO_SIGNAL:\n\n";
    for (const char* row : rows)
        text += std::string("      ") + row + "\n\n";
    return text;
}

const std::string kBasic = signals({"-Name \"di1\" -SignalType \"DI\"", "-Name \"do1\" -SignalType \"DO\"",
                                    "-Name \"do2\" -SignalType \"DO\" -Default 1",
                                    "-Name \"ao1\" -SignalType \"AO\" -MaxLog 10 -MinLog -5",
                                    "-Name \"go1\" -SignalType \"GO\" -DeviceMap \"0-3,8\"",
                                    "-Name \"gi1\" -SignalType \"GI\" -DeviceMap \"0-31\"",
                                    "-Name \"do3\" -SignalType \"DO\" -Access \"ReadOnly\""});

} // namespace

TEST_CASE("signals are read from EIO with limits and defaults", "[io]") {
    IoBench bench(kBasic);
    REQUIRE(bench.problems.empty());
    CHECK(bench.io.find("DI1") == bench.io.find("di1"));
    CHECK(bench.io.find("nothing") == -1);
    CHECK(bench.value("do2") == 1);
    CHECK(bench.io.config(bench.io.find("go1")).bits == 5);
    CHECK(bench.io.set(bench.handle("go1"), 31) == IoResult::Ok);
    CHECK(bench.io.set(bench.handle("go1"), 32) == IoResult::OutOfRange);
    CHECK(bench.io.set(bench.handle("ao1"), 10.5) == IoResult::OutOfRange);
    CHECK(bench.io.set(bench.handle("ao1"), -5) == IoResult::Ok);
    CHECK(bench.io.set(bench.handle("do1"), 17) == IoResult::Ok);
    CHECK(bench.value("do1") == 1);
    CHECK(bench.io.set(bench.handle("di1"), 1) == IoResult::NotWritable);
    CHECK(bench.io.set(bench.handle("do3"), 1) == IoResult::NotWritable);
    CHECK(bench.io.set(0, 1) == IoResult::NoSignal);
    CHECK(bench.io.set(999, 1) == IoResult::NoSignal);
    CHECK(bench.io.force(bench.io.find("gi1"), 4294967295.0) == IoResult::Ok);
    CHECK(bench.value("gi1") == 4294967295.0);
    CHECK(bench.io.force(bench.io.find("gi1"), 4294967296.0) == IoResult::OutOfRange);
}

TEST_CASE("a new order for an output cancels the change that waits (manual 2.10)", "[io]") {
    IoBench bench(kBasic);
    CHECK(bench.io.setDelayed(bench.handle("do1"), 1, 2 * kSecond) == IoResult::Ok);
    bench.runTo(kSecond);
    CHECK(bench.value("do1") == 0);
    CHECK(bench.io.set(bench.handle("do1"), 0) == IoResult::Ok);
    bench.runTo(5 * kSecond);
    CHECK(bench.changes.empty());
    CHECK(bench.io.setDelayed(bench.handle("do1"), 1, kSecond) == IoResult::Ok);
    bench.runTo(8 * kSecond);
    CHECK(bench.changes == std::vector<std::string>{"6.0 do1=1"});
    CHECK(bench.io.setDelayed(bench.handle("do1"), 0, 3000 * kSecond) == IoResult::BadTime);
}

TEST_CASE("pulses go up and come back; with high they end low", "[io]") {
    IoBench bench(kBasic);
    CHECK(bench.io.pulse(bench.handle("do1"), kSecond, false) == IoResult::Ok);
    CHECK(bench.io.pulse(bench.handle("do2"), 2 * kSecond, false) == IoResult::Ok); // is 1: inverted
    bench.runTo(3 * kSecond);
    CHECK(bench.changes == std::vector<std::string>{"0.0 do1=1", "0.0 do2=0", "1.0 do1=0", "2.0 do2=1"});
    bench.changes.clear();
    CHECK(bench.io.pulse(bench.handle("do2"), kSecond, true) == IoResult::Ok);
    bench.runTo(5 * kSecond);
    CHECK(bench.changes == std::vector<std::string>{"4.0 do2=0"});
    CHECK(bench.io.pulse(bench.handle("do1"), 0, false) == IoResult::BadTime);
    CHECK(bench.io.pulse(bench.handle("ao1"), kSecond, false) == IoResult::NotWritable);
}

TEST_CASE("any number of signals pulse, 20 are delayed at a time", "[io]") {
    IoBench bench;
    for (int i = 0; i < 25; ++i) {
        SignalConfig config;
        config.name = "o" + std::to_string(i);
        config.type = SignalType::DO;
        bench.io.addSignal(config);
    }
    const auto handle = [&](int i) { return bench.handle(("o" + std::to_string(i)).c_str()); };
    for (int i = 0; i < 25; ++i)
        CHECK(bench.io.pulse(handle(i), kSecond, false) == IoResult::Ok);
    CHECK(bench.io.pulse(handle(3), kSecond, false) == IoResult::Ok); // pulses already
    bench.runTo(2 * kSecond);
    for (int i = 0; i < 25; ++i)
        CHECK(bench.value(("o" + std::to_string(i)).c_str()) == 0);
    for (int i = 0; i < 20; ++i)
        CHECK(bench.io.setDelayed(handle(i), 1, kSecond) == IoResult::Ok);
    CHECK(bench.io.setDelayed(handle(20), 1, kSecond) == IoResult::TooManyDelays);
    CHECK(bench.io.setDelayed(handle(7), 0, kSecond) == IoResult::Ok);
    CHECK(bench.io.set(handle(8), 0) == IoResult::Ok); // gives its place free
    CHECK(bench.io.setDelayed(handle(20), 1, kSecond) == IoResult::Ok);
}

TEST_CASE("cross connections: chains, conditions, last change wins (manual 2.10)", "[io]") {
    const std::string plus = "#\n\nEIO_CROSS:\n\n"
                             "      -Res \"di2\" -Act1 \"di1\"\n\n"
                             "      -Res \"do4\" -Act1 \"di2\"\n\n"
                             "      -Res \"do5\" -Act1 \"di6\" -Oper1 \"AND\" -Act2 \"do1\" -Act2_invert\n\n"
                             "      -Res \"do8\" -Act1 \"do7\"\n\n      -Res \"do8\" -Act1 \"di5\"\n";
    IoBench bench(
        signals({"-Name di1 -SignalType DI", "-Name di2 -SignalType DI", "-Name di5 -SignalType DI",
                 "-Name di6 -SignalType DI", "-Name do1 -SignalType DO", "-Name do4 -SignalType DO",
                 "-Name do5 -SignalType DO", "-Name do7 -SignalType DO", "-Name do8 -SignalType DO"}) +
        plus);
    REQUIRE(bench.problems.empty());
    bench.io.force(bench.io.find("di1"), 1);
    CHECK(bench.changes == std::vector<std::string>{"0.0 di1=1", "0.0 di2=1", "0.0 do4=1"});
    CHECK(bench.io.force(bench.io.find("di2"), 0) == IoResult::NotWritable); // its channel is cut off
    bench.io.force(bench.io.find("di6"), 1);
    CHECK(bench.value("do5") == 1);
    bench.io.set(bench.handle("do1"), 1);
    CHECK(bench.value("do5") == 0);
    bench.io.set(bench.handle("do7"), 1);
    CHECK(bench.value("do8") == 1);
    bench.io.force(bench.io.find("di5"), 1);
    bench.io.force(bench.io.find("di5"), 0);
    CHECK(bench.value("do8") == 0); // set last by di5
    // pulses and delays are not carried over
    bench.io.set(bench.handle("do7"), 0);
    bench.changes.clear();
    bench.io.pulse(bench.handle("do7"), kSecond, false);
    bench.runTo(2 * kSecond);
    CHECK(bench.changes == std::vector<std::string>{"0.0 do7=1", "1.0 do7=0"});
}

TEST_CASE("cross connections are settled before the program starts", "[io]") {
    IoBench bench(signals({"-Name a -SignalType DO", "-Name b -SignalType DO", "-Name c -SignalType DO"}) +
                  "#\n\nEIO_CROSS:\n\n      -Res c -Act1 b\n\n      -Res b -Act1 a -Act1_invert\n");
    REQUIRE(bench.problems.empty());
    CHECK(bench.value("b") == 1);
    CHECK(bench.value("c") == 1);
    CHECK(bench.changes.empty());
}

TEST_CASE("wrong cross connections are refused with place", "[io]") {
    IoBench bench(
        signals({"-Name a -SignalType DO", "-Name b -SignalType DO", "-Name x -SignalType AO"}) +
        "#\n\nEIO_CROSS:\n\n      -Res b -Act1 a\n\n      -Res a -Act1 b\n\n      -Res a -Act1 x\n\n"
        "      -Res a -Act1 nowhere\n\n      -Res b -Act1 a -Oper1 XOR -Act2 a\n");
    REQUIRE(bench.problems.size() == 4);
    CHECK_THAT(bench.problems[0].text(), Contains("loop"));
    CHECK(bench.problems[0].line == 19);
    CHECK_THAT(bench.problems[1].text(), Contains("analog"));
    CHECK_THAT(bench.problems[2].text(), Contains("nowhere"));
    CHECK(bench.problems[2].warning); // may belong to an add-in
    CHECK_THAT(bench.problems[3].text(), Contains("XOR"));
}

TEST_CASE("wrong signals are refused with place and remedy", "[io]") {
    IoBench bench(
        signals({"-SignalType DI", "-Name a -SignalType XY", "-Name g -SignalType GO -DeviceMap \"0-40\"",
                 "-Name g -SignalType GO -DeviceMap \"oops\"", "-Name d -SignalType DI",
                 "-Name d -SignalType DO", "-Name v -SignalType AO -MaxLog 5 -MinLog 7",
                 "-Name w -SignalType AO -MaxLog 5 -MinLog 0 -Default 6"}));
    REQUIRE(bench.problems.size() == 7);
    CHECK(bench.problems[0].text() == "EIO.cfg:7: a signal without -Name");
    CHECK_THAT(bench.problems[1].message, Contains("must be DI, DO"));
    CHECK_THAT(bench.problems[4].message, Contains("already defined as DI in EIO.cfg:15"));
}

TEST_CASE("listeners may remove themselves and add others while they are called", "[io]") {
    IoBench bench(kBasic);
    int calls = 0;
    uint64_t number = 0;
    number = bench.io.addListener(bench.io.find("do1"), [&](SignalId, double, double) {
        ++calls;
        bench.io.removeListener(number);
        bench.io.addListener(-1, [&](SignalId, double, double) { calls += 10; });
    });
    bench.io.set(bench.handle("do1"), 1);
    CHECK(calls == 1);
    bench.io.set(bench.handle("do1"), 0);
    CHECK(calls == 11);
}

TEST_CASE("a simulated input keeps the client's value until the simulation ends", "[io]") {
    IoBench bench(kBasic + "#\n\nEIO_CROSS:\n\n      -Name \"c\" -Res \"di1\" -Act1 \"do1\"\n");
    const SignalId input = bench.io.find("di1");
    bench.io.simulate(input, true);
    CHECK(bench.io.isSimulated(input));
    CHECK(bench.io.set(bench.handle("do1"), 1) == IoResult::Ok);
    CHECK(bench.value("di1") == 0); // its cross connection does not count
    CHECK(bench.io.setByClient(input, 1) == IoResult::Ok);
    CHECK(bench.io.setByClient(input, 0) == IoResult::Ok);
    CHECK(bench.value("di1") == 0);
    bench.io.simulate(input, false);
    CHECK(bench.value("di1") == 1); // what the plant says

    const SignalId output = bench.io.find("do2");
    bench.io.simulate(output, true);
    CHECK(bench.io.set(bench.handle("do2"), 0) == IoResult::Ok); // programs still set it
    CHECK(bench.value("do2") == 0);
    bench.io.simulate(output, false);
    CHECK(bench.value("do2") == 0);
}
