#pragma once
// How the caller of a query says that the answer is not wanted any more.

#include <atomic>
#include <cstdint>

namespace rapid::query {

enum class CancelReason : uint8_t {
    None,
    Requested, ///< the caller said so
    Overtaken  ///< the text has changed meanwhile
};

/// Set by any thread. A query that finds it set returns early with what it has; the caller drops that.
class Cancel {
  public:
    void request(CancelReason reason = CancelReason::Requested) {
        reason_.store(reason, std::memory_order_relaxed);
    }
    CancelReason reason() const { return reason_.load(std::memory_order_relaxed); }
    bool requested() const { return reason() != CancelReason::None; }

  private:
    std::atomic<CancelReason> reason_{CancelReason::None};
};

/// Queries take a pointer: null means that it cannot be cancelled.
inline bool isCancelled(const Cancel* cancel) {
    return cancel && cancel->requested();
}

} // namespace rapid::query
