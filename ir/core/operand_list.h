#pragma once
// The operands of an instruction. Most have up to three, which lie in the object itself: programs have millions of instructions.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <utility>
#include <vector>

namespace ir {

using ValueId = uint32_t; ///< index into Routine::insts: the instruction that yields the value

class OperandList {
  public:
    OperandList() = default;
    OperandList(std::initializer_list<ValueId> ids) { assign(ids.begin(), ids.size()); }
    OperandList(const std::vector<ValueId>& ids) { assign(ids.data(), ids.size()); }
    OperandList(const OperandList& other) {
        std::copy_n(other.few_, kFew, few_); // with what lies beside the operands
        assign(other.data(), other.size());
    }
    OperandList(OperandList&& other) noexcept { swap(other); }
    OperandList& operator=(OperandList other) noexcept {
        swap(other);
        return *this;
    }
    ~OperandList() { clear(); }

    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const ValueId* data() const { return isLong() ? many() : few_; }
    ValueId* data() { return isLong() ? many() : few_; }
    const ValueId* begin() const { return data(); }
    const ValueId* end() const { return data() + size_; }
    ValueId* begin() { return data(); }
    ValueId* end() { return data() + size_; }
    ValueId operator[](size_t i) const { return data()[i]; }
    ValueId& operator[](size_t i) { return data()[i]; }

    /// Room beside at most one operand, for what the instruction has besides: its constant, or where it jumps.
    ValueId* room() { return few_ + 1; }
    const ValueId* room() const { return few_ + 1; }

    void clear() {
        if (isLong()) delete[] many();
        size_ = 0;
    }
    void push_back(ValueId id) {
        std::vector<ValueId> ids(begin(), end());
        ids.push_back(id);
        *this = OperandList(ids);
    }

  private:
    static constexpr size_t kFew = 3;

    bool isLong() const { return size_ > kFew; }
    /// The address of a longer list takes the place of the last two.
    ValueId* many() const {
        ValueId* ids = nullptr;
        std::memcpy(&ids, &few_[1], sizeof ids);
        return ids;
    }
    void assign(const ValueId* ids, size_t count) {
        if (count > kFew) {
            ValueId* const made = new ValueId[count];
            std::memcpy(&few_[1], &made, sizeof made);
        }
        size_ = static_cast<uint32_t>(count);
        std::copy_n(ids, count, data());
    }
    void swap(OperandList& other) {
        std::swap(size_, other.size_);
        std::swap(few_, other.few_);
    }

    uint32_t size_ = 0;
    ValueId few_[kFew] = {};
    static_assert(sizeof(ValueId*) <= 2 * sizeof(ValueId));
};

} // namespace ir
