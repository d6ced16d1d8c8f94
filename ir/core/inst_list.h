#pragma once
// The instructions and blocks of a routine: a list that grows without copying what it holds, since programs have millions of them.

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace ir {

/// A list in pieces. Only a list with one piece moves its elements when it grows.
template <class T> class PieceList {
    template <class List, class Element> class Iterator {
      public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using pointer = Element*;
        using reference = Element&;

        Iterator() = default;
        Iterator(List* list, size_t at) : list_(list), at_(at) {}
        Element& operator*() const { return (*list_)[at_]; }
        Element* operator->() const { return &(*list_)[at_]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) {
            Iterator before = *this;
            ++at_;
            return before;
        }
        bool operator==(const Iterator&) const = default;

      private:
        List* list_ = nullptr;
        size_t at_ = 0;
    };

  public:
    using iterator = Iterator<PieceList, T>;
    using const_iterator = Iterator<const PieceList, const T>;

    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T& operator[](size_t i) { return pieces_[i / kPiece][i % kPiece]; }
    const T& operator[](size_t i) const { return pieces_[i / kPiece][i % kPiece]; }
    T& back() { return (*this)[size_ - 1]; }
    const T& back() const { return (*this)[size_ - 1]; }
    iterator begin() { return {this, 0}; }
    iterator end() { return {this, size_}; }
    const_iterator begin() const { return {this, 0}; }
    const_iterator end() const { return from(size_); }
    const_iterator from(size_t first) const { return {this, first}; }

    void push_back(T element) {
        if (size_ % kPiece == 0) {
            pieces_.emplace_back();
            if (size_ > 0) pieces_.back().reserve(kPiece);
        }
        pieces_.back().push_back(std::move(element));
        ++size_;
    }

    /// Keeps the first `count` elements, at most as many as there are.
    void truncate(size_t count) {
        pieces_.resize((count + kPiece - 1) / kPiece);
        if (count % kPiece != 0)
            pieces_.back().erase(pieces_.back().begin() + count % kPiece, pieces_.back().end());
        size_ = count;
    }

  private:
    static constexpr size_t kPiece = 4096;

    std::vector<std::vector<T>> pieces_;
    size_t size_ = 0;
};

} // namespace ir
