#pragma once
// How the caller of a query says that the answer is not wanted any more.

#include <atomic>

namespace rapid::query {

/// Set by any thread. A query that finds it set returns early with what it has; the caller drops that.
class Cancel {
  public:
    void request() { requested_.store(true, std::memory_order_relaxed); }
    bool requested() const { return requested_.load(std::memory_order_relaxed); }

  private:
    std::atomic<bool> requested_{false};
};

/// Queries take a pointer: null means that nobody cancels.
inline bool isCancelled(const Cancel* cancel) {
    return cancel && cancel->requested();
}

} // namespace rapid::query
