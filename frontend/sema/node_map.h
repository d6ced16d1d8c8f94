#pragma once
// Facts about nodes of syntax trees, found by the address of the node.

#include "frontend/source/arena.h"

namespace rapid::sema {

/// Map from the nodes of a tree to values that need no destructor. Values keep their address.
template <class N, class T> class NodeMap {
  public:
    explicit NodeMap(Arena& arena) : arena_(arena) {}
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
    /// Forgets everything; the memory of the entries goes with the arena.
    void clear() {
        slots_ = {};
        count_ = 0;
    }

    Iterator find(const N* node) const {
        if (slots_.empty()) return end();
        const size_t slot = slotOf(node);
        return slots_[slot] ? Iterator(slots_.data() + slot, slots_.data() + slots_.size()) : end();
    }
    /// The value of a node that is there.
    T& at(const N* node) const { return slots_[slotOf(node)]->second; }

    /// The value of a node, made if there is none yet.
    T& operator[](const N* node) {
        if (slots_.empty() || (count_ + 1) * 2 > slots_.size()) grow(slots_.size() * 2);
        Entry*& entry = slots_[slotOf(node)];
        if (!entry) {
            entry = new (arena_.allocate(sizeof(Entry), alignof(Entry))) Entry(node, T());
            ++count_;
        }
        return entry->second;
    }

  private:
    /// The place of the node, or where it would be.
    size_t slotOf(const N* node) const {
        const size_t mask = slots_.size() - 1;
        size_t slot = (reinterpret_cast<uintptr_t>(node) * uint64_t{0x9E3779B97F4A7C15u} >> 32) & mask;
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

    Arena& arena_;
    std::vector<Entry*> slots_; ///< a power of two, at most half full
    size_t count_ = 0;
};

} // namespace rapid::sema
