#include "ir/core/inst_list.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>

namespace {

using List = ir::PieceList<std::unique_ptr<int>>;

List counted(int count) {
    List list;
    for (int i = 0; i < count; ++i)
        list.push_back(std::make_unique<int>(i));
    return list;
}

TEST_CASE("a list in pieces keeps its elements in order", "[ir]") {
    for (const int count : {0, 1, 4095, 4096, 4097, 10'000}) {
        const List list = counted(count);
        CHECK(list.size() == static_cast<size_t>(count));
        CHECK(list.empty() == (count == 0));
        int next = 0;
        for (const std::unique_ptr<int>& element : list)
            if (*element == next) ++next;
        CHECK(next == count);
        if (count > 0) CHECK(*list[static_cast<size_t>(count - 1)] == count - 1);
    }
}

TEST_CASE("a list in pieces can be searched from a place in it", "[ir]") {
    const List list = counted(5000);
    const auto isAbove = [](int limit) {
        return [limit](const std::unique_ptr<int>& element) { return *element > limit; };
    };
    CHECK(std::count_if(list.from(4096), list.end(), isAbove(0)) == 5000 - 4096);
    CHECK(std::none_of(list.from(5000), list.end(), isAbove(0)));
    CHECK(std::any_of(list.begin(), list.end(), isAbove(4998)));
}

TEST_CASE("a list of several pieces does not move its elements when it grows", "[ir]") {
    ir::PieceList<int> list;
    for (int i = 0; i < 4097; ++i)
        list.push_back(i);
    const int *const first = &list[0], *const last = &list[4096];
    for (int i = 4097; i < 20'000; ++i)
        list.push_back(i);
    CHECK(&list[0] == first);
    CHECK(&list[4096] == last);
    CHECK(*last == 4096);
}

} // namespace
