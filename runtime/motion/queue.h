#pragma once
// Queue: a sequence that grows at its end and whose first elements are forgotten. Planning asks for elements by their number all the
// time, for which a std::deque divides by the size of an element.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace motion {

/// Leaves members without an initial value as they are in a new element: some have large arrays of which only the first items count.
template <class Element> struct LeanAllocator : std::allocator<Element> {
    template <class Other> struct rebind {
        using other = LeanAllocator<Other>;
    };
    template <class Made, class... From> void construct(Made* place, From&&... from) {
        if constexpr (sizeof...(From) == 0 && !std::is_trivially_default_constructible_v<Made>)
            ::new (static_cast<void*>(place)) Made;
        else
            ::new (static_cast<void*>(place)) Made(std::forward<From>(from)...);
    }
};

/// A new element may invalidate references to others.
template <class Element> class Queue {
  public:
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Element& operator[](std::size_t i) { return blockOf(i)[(first_ + i) % kBlock]; }
    const Element& operator[](std::size_t i) const {
        return blocks_[(first_ + i) / kBlock][(first_ + i) % kBlock];
    }
    Element& front() { return (*this)[0]; }
    const Element& front() const { return (*this)[0]; }
    Element& back() { return (*this)[size_ - 1]; }
    const Element& back() const { return (*this)[size_ - 1]; }
    /// How many of the first elements have at most this value; `valueOf` grows from element to element.
    template <class Value, class ValueOf> std::size_t countUpTo(const Value& most, ValueOf valueOf) const {
        return countWhile([&](const Element& element) { return !(most < valueOf(element)); });
    }
    /// How many of the first elements the condition holds for; it holds for none after the first one that it does not hold for.
    /// Looks for the block first: inside it the elements lie side by side.
    template <class Condition> std::size_t countWhile(Condition holds) const {
        if (size_ == 0 || !holds(front())) return 0;
        const std::size_t last = (first_ + size_ - 1) / kBlock;
        std::size_t block = 0;
        for (std::size_t left = last; left > 0;) {
            const std::size_t half = (left + 1) / 2;
            if (holds(blocks_[block + half].front())) {
                block += half;
                left -= half;
            } else {
                left = half - 1;
            }
        }
        const Element* const elements = blocks_[block].data();
        std::size_t low = block == 0 ? first_ : 0;
        for (std::size_t left = blocks_[block].size() - low; left > 0;) {
            const std::size_t half = left / 2;
            if (holds(elements[low + half])) {
                low += half + 1;
                left -= half + 1;
            } else {
                left = half;
            }
        }
        return block * kBlock + low - first_;
    }

    /// A new element at the end.
    Element& grow() {
        if ((first_ + size_) / kBlock == blocks_.size()) blocks_.emplace_back().reserve(kBlock);
        return blockOf(size_++).emplace_back();
    }
    void push_back(Element element) { grow() = std::move(element); }
    void pop_back() { blockOf(--size_).pop_back(); }
    void resize(std::size_t size) {
        while (size_ > size)
            pop_back();
        while (size_ < size)
            grow();
    }
    /// Forgets the first ones, not more than there are.
    void forget(std::size_t count) {
        first_ += count;
        size_ -= count;
        blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(first_ / kBlock));
        first_ %= kBlock;
    }

  private:
    using Block = std::vector<Element, LeanAllocator<Element>>;
    Block& blockOf(std::size_t i) { return blocks_[(first_ + i) / kBlock]; }

    static constexpr std::size_t kBlock = std::bit_floor(std::max<std::size_t>(1, 8192 / sizeof(Element)));
    std::vector<Block> blocks_; // full up to the one with the last element, then empty
    std::size_t first_ = 0;     // in the first block; the ones before it are forgotten
    std::size_t size_ = 0;
};

} // namespace motion
