#pragma once
// RetryCounts: the RETRYs of one statement, for each error number.

#include <map>
#include <utility>
#include <vector>

namespace rt {

/// A statement that fails has one error, as a rule; so the count of the first number lies in the object itself, and an
/// error that is handled allocates nothing.
class RetryCounts {
  public:
    RetryCounts() = default;
    explicit RetryCounts(const std::map<int, int>& counts) {
        for (const auto& [number, count] : counts)
            of(number) = count;
    }
    /// 0 at first.
    int& of(int number) {
        if (number == first_.first) return first_.second;
        if (first_.second == 0 && others_.empty()) {
            first_.first = number;
            return first_.second;
        }
        for (auto& [known, count] : others_)
            if (known == number) return count;
        return others_.emplace_back(number, 0).second;
    }
    void clear() {
        first_ = {};
        others_.clear();
    }
    /// Those that are not 0.
    std::map<int, int> all() const {
        std::map<int, int> counts;
        if (first_.second != 0) counts.insert(first_);
        for (const auto& entry : others_)
            if (entry.second != 0) counts.insert(entry);
        return counts;
    }

  private:
    std::pair<int, int> first_{};
    std::vector<std::pair<int, int>> others_;
};

} // namespace rt
