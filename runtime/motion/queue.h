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
    Element& operator[](std::size_t i) { return blocks_[(first_ + i) / kBlock][(first_ + i) % kBlock]; }
    const Element& operator[](std::size_t i) const {
        return blocks_[(first_ + i) / kBlock][(first_ + i) % kBlock];
    }
    Element& front() { return (*this)[0]; }
    const Element& front() const { return (*this)[0]; }
    Element& back() { return blocks_.back().back(); }
    const Element& back() const { return blocks_.back().back(); }
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
        if (blocks_.empty() || blocks_.back().size() == kBlock) blocks_.emplace_back().reserve(kBlock);
        ++size_;
        return blocks_.back().emplace_back();
    }
    void push_back(Element element) { grow() = std::move(element); }
    void pop_back() {
        blocks_.back().pop_back();
        --size_;
        if (blocks_.back().empty()) blocks_.pop_back();
    }
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
        const std::size_t spare = size_ == 0 ? blocks_.size() : first_ / kBlock;
        blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(spare));
        first_ = size_ == 0 ? 0 : first_ % kBlock;
    }

  private:
    static constexpr std::size_t kBlock = std::bit_floor(std::max<std::size_t>(1, 8192 / sizeof(Element)));
    std::vector<std::vector<Element>> blocks_; // all but the last one are full
    std::size_t first_ = 0;                    // in the first block; the ones before it are forgotten
    std::size_t size_ = 0;
};

} // namespace motion
