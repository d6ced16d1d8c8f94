#pragma once
// Facts about nodes of syntax trees, found by the address of the node.

#include "frontend/source/arena.h"

namespace rapid::sema {

/// Map from nodes to values. Values keep their address and lie in an arena that the caller names; they must not need a
/// destructor.
template <class N, class T> class NodeMap {
  public:
    using Entry = std::pair<const N* const, T>;

    class Iterator {
      public:
        Iterator(Entry* const* at, Entry* const* end) : at_(at), end_(end) { skip(); }
        Entry& operator*() const { return **at_; }
        Entry* operator->() const { return *at_; }
        Iterator& operator++() {
            ++at_;
            skip();
            return *this;
        }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

      private:
        void skip() {
            while (at_ != end_ && !*at_)
                ++at_;
        }
        Entry* const* at_;
        Entry* const* end_;
    };

    Iterator begin() const { return {slots_.data(), slots_.data() + slots_.size()}; }
    Iterator end() const { return {slots_.data() + slots_.size(), slots_.data() + slots_.size()}; }
    size_t size() const { return count_; }

    Iterator find(const N* node) const {
        if (slots_.empty()) return end();
        const size_t slot = slotOf(node);
        return slots_[slot] ? Iterator(slots_.data() + slot, slots_.data() + slots_.size()) : end();
    }
    /// The value of a node that is there.
    T& at(const N* node) const { return slots_[slotOf(node)]->second; }

    /// The value of a node, made in `arena` if there is none yet.
    T& get(const N* node, Arena& arena) {
        if (slots_.empty() || (count_ + 1) * 2 > slots_.size()) grow(slots_.size() * 2);
        Entry*& entry = slots_[slotOf(node)];
        if (!entry) {
            entry = new (arena.allocate(sizeof(Entry), alignof(Entry))) Entry(node, T());
            ++count_;
        }
        return entry->second;
    }

    void reserve(size_t count) {
        size_t size = 16;
        while (size < count * 2)
            size *= 2;
        if (size > slots_.size()) grow(size);
    }

  private:
    /// Where the node is or would be.
    size_t slotOf(const N* node) const {
        // Neighbours in a tree, which are asked for one after the other, are neighbours here.
        const size_t mask = slots_.size() - 1;
        const auto address = reinterpret_cast<uintptr_t>(node);
        constexpr size_t kGroupBits = 6;
        constexpr size_t kNodeBits = 5;
        const uint64_t group = (address >> (kGroupBits + kNodeBits)) * uint64_t{0x9E3779B97F4A7C15u} >> 32;
        size_t slot = (group << kGroupBits | (address >> kNodeBits & ((1u << kGroupBits) - 1))) & mask;
        while (slots_[slot] && slots_[slot]->first != node)
            slot = (slot + 1) & mask;
        return slot;
    }
    void grow(size_t size) {
        std::vector<Entry*> old = std::move(slots_);
        slots_.assign(size < 16 ? 16 : size, nullptr);
        for (Entry* entry : old)
            if (entry) slots_[slotOf(entry->first)] = entry;
    }

    std::vector<Entry*> slots_; ///< a power of two, at most half full
    size_t count_ = 0;
};

} // namespace rapid::sema
