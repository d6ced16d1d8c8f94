#pragma once
// Queue: a sequence that grows at its end and whose first elements are forgotten. Planning asks for elements by their number all the
// time, for which a std::deque divides by the size of an element.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace motion {

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
        std::size_t low = 0;
        for (std::size_t left = size_; left > 0;) {
            const std::size_t half = left / 2;
            if (most < valueOf((*this)[low + half])) {
                left = half;
            } else {
                low += half + 1;
                left -= half + 1;
            }
        }
        return low;
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
    std::vector<Element>& blockOf(std::size_t i) { return blocks_[(first_ + i) / kBlock]; }

    static constexpr std::size_t kBlock = std::bit_floor(std::max<std::size_t>(1, 8192 / sizeof(Element)));
    std::vector<std::vector<Element>> blocks_; // full up to the one with the last element, then empty
    std::size_t first_ = 0;                    // in the first block; the ones before it are forgotten
    std::size_t size_ = 0;
};

} // namespace motion
