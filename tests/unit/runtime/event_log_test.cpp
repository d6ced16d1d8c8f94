#include "runtime/log/event_log.h"

#include "unit/runtime/test_program.h"

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include <map>

using namespace rt;

namespace {

/// A log with a clock that is moved by hand, and what its JSON file says in the end.
struct Bench {
    testing::TempFolder folder;
    Time now = 0;
    std::string file = folder.file("events.jsonl");
    EventLog log;

    Bench() {
        log.setHumanOutput(nullptr);
        log.setClock([this] { return now; });
        std::string error;
        REQUIRE(log.openJson(file, error));
    }
    void write(const std::string& title, int number = 80001) {
        now += kMillisecond;
        log.write(EventType::Warning, number, title, "text", nullptr);
    }
    /// "title@time", with "xN" when a line represents N.
    std::vector<std::string> lines() {
        log.finish();
        REQUIRE(log.closeJson());
        std::vector<std::string> result;
        std::istringstream in(folder.read("events.jsonl"));
        for (std::string line; std::getline(in, line);) {
            const auto json = nlohmann::json::parse(line);
            std::string text = json["title"].get<std::string>() + "@" +
                               std::to_string(static_cast<int>(json["time"].get<double>() * 1000 + 0.5));
            if (json.contains("count")) text += "x" + std::to_string(json["count"].get<int>());
            result.push_back(text);
        }
        return result;
    }
};

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("an event that repeats is counted until another one comes", "[log]") {
    Bench bench;
    for (int i = 0; i < 5; ++i)
        bench.write("a");
    bench.write("b");
    bench.write("a");
    CHECK(bench.lines() == Lines{"a@1", "a@5x4", "b@6", "a@7"});
}

TEST_CASE("events that take turns are counted, each for itself", "[log]") {
    Bench bench;
    for (int i = 0; i < 100; ++i) {
        bench.write("a");
        bench.write("b");
    }
    CHECK(bench.lines() == Lines{"a@1", "b@2", "a@199x99", "b@200x99"});
}

TEST_CASE("orders and states of the controller are never counted", "[log]") {
    Bench bench;
    for (int i = 0; i < 2; ++i) {
        bench.write("stop", 10125);
        bench.write("error", 40229);
    }
    CHECK(bench.lines() == Lines{"stop@1", "error@2", "stop@3", "error@4"});
}

TEST_CASE("the log keeps repetitions in one place, and finds each of them", "[log]") {
    Bench bench;
    for (int i = 0; i < 3000; ++i)
        bench.write("a");
    bench.write("b");
    REQUIRE(bench.log.events().size() == 2);
    const Event& first = bench.log.events().front();
    CHECK(first.count == 3000);
    CHECK(first.sequence == 3000);
    CHECK(first.since == kMillisecond);
    CHECK(first.time == 3000 * kMillisecond);
    for (const uint64_t sequence : {1U, 1500U, 3000U})
        CHECK(bench.log.find(sequence) == &bench.log.events().front());
    CHECK(bench.log.find(3001) == &bench.log.events().back());
    CHECK(bench.log.find(0) == nullptr);
    CHECK(bench.log.find(3002) == nullptr);

    EventLog next; // of the run that continues
    next.setHumanOutput(nullptr);
    next.write(EventType::Warning, 80001, "c", "text", nullptr);
    next.restore({bench.log.events().begin(), bench.log.events().end()});
    CHECK(next.find(3001)->title == "b");
    CHECK(next.find(3002)->title == "c");
    CHECK(next.find(17)->title == "a");
    CHECK(next.count() == 3002);
}

TEST_CASE("every occurrence reaches the listeners", "[log]") {
    Bench bench;
    int heard = 0;
    bench.log.addListener([&](const Event& event) { heard += event.count == 1 ? 1 : 0; });
    for (int i = 0; i < 10; ++i)
        bench.write("a");
    CHECK(heard == 10);
}

TEST_CASE("an event that is only counted again leaves what writing it again leaves", "[log]") {
    Bench written, counted;
    for (Bench* bench : {&written, &counted}) {
        std::map<std::string, uint64_t> first;
        for (const char* title :
             {"a", "a", "b", "b", "b", "a", "a", "b", "c", "a", "b", "b", "c", "c", "d"}) {
            bench->now += kMillisecond;
            const uint64_t before = bench->log.count();
            const bool again =
                bench == &counted && first.count(title) != 0 && bench->log.repeat(first[title], bench->now);
            CHECK(again == (bench == &counted && first.count(title) != 0));
            if (!again) first[title] = bench->log.write(EventType::Warning, 80001, title, "text", nullptr);
            CHECK(bench->log.count() == before + 1);
            if (bench->log.count() == 5) CHECK(bench->log.find(4)->title == "b");
        }
    }
    CHECK_FALSE(counted.log.repeat(99, 9 * kMillisecond)); // not written
    REQUIRE(counted.log.events().size() == written.log.events().size());
    for (std::size_t i = 0; i < written.log.events().size(); ++i) {
        const Event &a = written.log.events()[i], &b = counted.log.events()[i];
        CHECK(a.title == b.title);
        CHECK(std::tie(a.sequence, a.count, a.since, a.time) ==
              std::tie(b.sequence, b.count, b.since, b.time));
    }
    CHECK(counted.lines() == written.lines());
}

TEST_CASE("an event is written again if a listener is registered or the error number has a new name",
          "[log]") {
    Bench bench;
    bench.write("a");
    CHECK(bench.log.repeat(1, kMillisecond));
    bench.log.addErrorName(10001, "other", "");
    CHECK_FALSE(bench.log.repeat(1, kMillisecond));
    bench.write("a");
    CHECK(bench.log.repeat(3, kMillisecond));
    bench.log.addListener([](const Event&) {});
    CHECK_FALSE(bench.log.repeat(3, kMillisecond));
}
