// Queue behaves as a std::deque that grows at its end and loses its first elements.

#include "runtime/motion/queue.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <vector>

using motion::Queue;

namespace {

/// Few of them lie in one block of memory.
struct Large {
    int number = 0;
    std::array<double, 300> rest{};
};

} // namespace

TEST_CASE("a queue holds what was added last and not forgotten", "[motion][queue]") {
    std::mt19937_64 random(7);
    Queue<Large> queue;
    std::deque<int> expected;
    for (int step = 0; step < 2000; ++step) {
        switch (random() % 4) {
        case 0:
        case 1:
            queue.grow().number = step;
            expected.push_back(step);
            break;
        case 2: {
            const std::size_t size = expected.empty() ? 0 : expected.size() - random() % 2;
            queue.resize(size);
            expected.resize(size);
            break;
        }
        default: {
            const std::size_t count = random() % 8 == 0 ? random() % (expected.size() + 1) : 0;
            queue.forget(count);
            expected.erase(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(count));
        }
        }
        REQUIRE(queue.size() == expected.size());
        const Queue<Large> copy = queue;
        for (std::size_t i = 0; i < expected.size(); ++i)
            REQUIRE((queue[i].number == expected[i] && copy[i].number == expected[i]));
        if (expected.empty()) continue;
        REQUIRE((queue.front().number == expected.front() && queue.back().number == expected.back()));
    }
}

TEST_CASE("a queue counts its elements up to a value", "[motion][queue]") {
    Queue<double> queue;
    const auto own = [](double value) { return value; };
    CHECK(queue.countUpTo(1.0, own) == 0);
    for (const double value : {1.0, 2.0, 2.0, 5.0})
        queue.push_back(value);
    CHECK(queue.countUpTo(0.5, own) == 0);
    CHECK(queue.countUpTo(1.0, own) == 1);
    CHECK(queue.countUpTo(2.0, own) == 3); // equal ones as well
    CHECK(queue.countUpTo(4.9, own) == 3);
    CHECK(queue.countUpTo(9.0, own) == 4);
    queue.forget(1);
    CHECK(queue.countUpTo(2.0, own) == 2);
}

TEST_CASE("a queue counts elements of many blocks, even after some are forgotten", "[motion][queue]") {
    std::mt19937_64 random(5);
    Queue<Large> queue;
    std::vector<int> expected;
    int number = 0;
    for (int round = 0; round < 60; ++round) {
        for (std::size_t count = random() % 9; count > 0; --count) {
            number += static_cast<int>(random() % 3); // equal ones as well
            queue.grow().number = number;
            expected.push_back(number);
        }
        const std::size_t forgotten = random() % 4 == 0 ? random() % (expected.size() + 1) : 0;
        queue.forget(forgotten);
        expected.erase(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(forgotten));
        for (int most = number - 40; most <= number + 1; ++most) {
            const auto after = std::upper_bound(expected.begin(), expected.end(), most);
            const auto wanted = static_cast<std::size_t>(after - expected.begin());
            REQUIRE(queue.countUpTo(most, [](const Large& l) { return l.number; }) == wanted);
        }
    }
}
