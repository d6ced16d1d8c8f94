#include "frontend/source/arena.h"

#include "frontend/source/free_memory.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <mutex>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#if defined(__SANITIZE_ADDRESS__)
#define RAPID_PLAIN_BLOCKS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define RAPID_PLAIN_BLOCKS 1
#endif
#endif

namespace rapid {

namespace {

constexpr size_t kGranule = size_t{1} << 10; ///< sizes of blocks are multiples of this
constexpr size_t kSmallest = size_t{1} << 11;
constexpr size_t kLargest = size_t{1} << 14; ///< but for what needs more
[[maybe_unused]] constexpr size_t kHugePage =
    size_t{1} << 21; ///< alignment and granule of what is taken from the system
[[maybe_unused]] constexpr size_t kPage = size_t{1} << 12;
[[maybe_unused]] constexpr size_t kChunk = size_t{1} << 25;

constexpr size_t roundUp(size_t size, size_t granule) {
    return (size + granule - 1) / granule * granule;
}

#if defined(RAPID_PLAIN_BLOCKS)

char* takeBlock(size_t size) { // each block by itself: the sanitizer shall see its ends
    return static_cast<char*>(::operator new(size));
}
void giveBlock(char* data, size_t) {
    ::operator delete(data);
}

#else

/// Free memory by address; neighbours are joined. Memory from the system stays with the process until `release`.
class BlockPool {
  public:
    char* take(size_t size) {
        const std::lock_guard lock(mutex_);
        auto best = free_.end();
        for (auto it = free_.begin(); it != free_.end(); ++it)
            if (it->second >= size && (best == free_.end() || it->second < best->second)) best = it;
        if (best == free_.end()) best = free_.insert(newChunk(size)).first;
        const auto [data, available] = *best;
        free_.erase(best);
        if (available > size) free_.emplace(data + size, available - size);
        return data;
    }

    void give(char* data, size_t size) {
        const std::lock_guard lock(mutex_);
        auto next = free_.lower_bound(data);
        if (next != free_.begin()) {
            const auto before = std::prev(next);
            if (before->first + before->second == data) {
                data = before->first;
                size += before->second;
                free_.erase(before);
            }
        }
        if (next != free_.end() && data + size == next->first) {
            size += next->second;
            free_.erase(next);
        }
        free_.emplace(data, size);
    }

    void release() {
#if defined(__linux__)
        const std::lock_guard lock(mutex_);
        for (const auto& [data, size] : free_) {
            const auto begin = reinterpret_cast<uintptr_t>(data);
            const uintptr_t first = roundUp(begin, kPage), last = (begin + size) / kPage * kPage;
            if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
        }
#endif
    }

  private:
    static std::pair<char*, size_t> newChunk(size_t atLeast) {
        size_t size = std::max(kChunk, roundUp(atLeast, kHugePage));
        void* data = std::aligned_alloc(kHugePage, size);
        if (!data) data = std::aligned_alloc(kHugePage, size = roundUp(atLeast, kHugePage)); // the last of it
        if (!data) throw std::bad_alloc();
#if defined(__linux__)
        ::madvise(data, size, MADV_HUGEPAGE); // where there are none, ordinary pages do
#endif
        return {static_cast<char*>(data), size};
    }

    std::mutex mutex_;
    std::map<char*, size_t> free_;
};

/// Never destroyed: arenas of static duration may give their blocks back at the very end.
BlockPool& pool() {
    static auto* const all = new BlockPool;
    return *all;
}

char* takeBlock(size_t size) {
    return pool().take(size);
}
void giveBlock(char* data, size_t size) {
    pool().give(data, size);
}

#endif

} // namespace

void* Arena::allocateInNewBlock(size_t size, size_t align) {
    // As much again as there is: thousands of small files have arenas of their own.
    const size_t bytes = roundUp(std::max(size + align, std::clamp(total_, kSmallest, kLargest)), kGranule);
    blocks_.push_back({takeBlock(bytes), bytes});
    total_ += bytes;
    const auto begin = reinterpret_cast<uintptr_t>(blocks_.back().data);
    const uintptr_t at = (begin + align - 1) & ~(static_cast<uintptr_t>(align) - 1);
    // Continue where more room is left.
    if (next_ == 0 || begin + bytes - (at + size) >= end_ - next_) {
        next_ = at + size;
        end_ = begin + bytes;
    }
    return reinterpret_cast<void*>(at);
}

void Arena::clear() {
    for (const Block& block : blocks_)
        giveBlock(block.data, block.size);
    blocks_.clear();
    next_ = end_ = total_ = 0;
}

void releaseFreeMemory() {
#if !defined(RAPID_PLAIN_BLOCKS)
    pool().release();
#endif
}

} // namespace rapid
