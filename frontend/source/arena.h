#pragma once
// Memory for many small objects that live and die together: syntax trees, facts about them, symbols, constants.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace rapid {

/// Bump allocator; destructors of what lies in it are not run. Its memory comes in blocks from a pool that all arenas
/// of the process share and that huge pages can back: a page fault costs more than filling the page.
class Arena {
  public:
    Arena() = default;
    ~Arena() { clear(); }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    void* allocate(size_t size, size_t align) {
        const uintptr_t at = (next_ + align - 1) & ~(static_cast<uintptr_t>(align) - 1);
        if (next_ == 0 || at + size > end_) return allocateInNewBlock(size, align);
        next_ = at + size;
        return reinterpret_cast<void*>(at);
    }
    template <class T> T* make() { return new (allocate(sizeof(T), alignof(T))) T(); }
    /// `count` objects made by their default constructor.
    template <class T> std::span<T> makeArray(size_t count) {
        if (count == 0) return {};
        T* data = static_cast<T*>(allocate(sizeof(T) * count, alignof(T)));
        std::uninitialized_value_construct_n(data, count);
        return {data, count};
    }
    template <class T> std::span<T> copy(std::span<const T> items) {
        if (items.empty()) return {};
        T* data = static_cast<T*>(allocate(sizeof(T) * items.size(), alignof(T)));
        std::uninitialized_copy(items.begin(), items.end(), data);
        return {data, items.size()};
    }
    template <class T> std::span<T> copy(const std::vector<T>& items) {
        return copy(std::span<const T>(items.data(), items.size()));
    }
    /// Gives all memory back.
    void clear();

  private:
    struct Block {
        char* data = nullptr;
        size_t size = 0;
    };
    void* allocateInNewBlock(size_t size, size_t align);

    std::vector<Block> blocks_;
    size_t total_ = 0; ///< bytes of all blocks
    uintptr_t next_ = 0;
    uintptr_t end_ = 0;
};

/// Objects of one type in an arena, which keep their address; their destructors are run.
template <class T> class Store {
  public:
    explicit Store(Arena& arena) : arena_(arena) {}
    ~Store() { clear(); }
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;
    /// Ends all objects; their memory goes with the arena.
    void clear() {
        for (size_t i = 0; i < size_; ++i)
            (*this)[i].~T();
        chunks_ = {};
        size_ = 0;
    }

    template <class... Args> T& emplace_back(Args&&... args) {
        if (size_ % kPerChunk == 0)
            chunks_.push_back(static_cast<T*>(arena_.allocate(sizeof(T) * kPerChunk, alignof(T))));
        T* object = new (chunks_.back() + size_ % kPerChunk) T(std::forward<Args>(args)...);
        ++size_;
        return *object;
    }
    size_t size() const { return size_; }
    T& operator[](size_t i) { return chunks_[i / kPerChunk][i % kPerChunk]; }
    const T& operator[](size_t i) const { return chunks_[i / kPerChunk][i % kPerChunk]; }

  private:
    static constexpr size_t kPerChunk = 16;
    Arena& arena_;
    std::vector<T*> chunks_;
    size_t size_ = 0;
};

} // namespace rapid
