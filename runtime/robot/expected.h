#pragma once
// Expected: a value or a reason why there is none. The libraries below the controller report failures of the
// outside world (files, unreachable targets) this way; nothing throws across their border.

#include <cstdlib>
#include <utility>
#include <variant>

namespace robot {

/// Wraps an error so that it cannot be mistaken for a value: `return Unexpected{error};`
template <class E> struct Unexpected {
    E error;
};
template <class E> Unexpected(E) -> Unexpected<E>;

/// A T, or an E that says why not. Reading the absent side is a bug of the caller and aborts.
template <class T, class E> class [[nodiscard]] Expected {
  public:
    Expected(T value) : data_(std::in_place_index<0>, std::move(value)) {}
    Expected(Unexpected<E> failure) : data_(std::in_place_index<1>, std::move(failure.error)) {}

    bool hasValue() const { return data_.index() == 0; }
    explicit operator bool() const { return hasValue(); }

    const T& value() const { return *checked(std::get_if<0>(&data_)); }
    T& value() { return *checked(std::get_if<0>(&data_)); }
    const T& operator*() const { return value(); }
    T& operator*() { return value(); }
    const T* operator->() const { return &value(); }
    T* operator->() { return &value(); }
    const E& error() const { return *checked(std::get_if<1>(&data_)); }

  private:
    template <class P> static P* checked(P* pointer) {
        if (pointer == nullptr) std::abort();
        return pointer;
    }
    std::variant<T, E> data_;
};

} // namespace robot
