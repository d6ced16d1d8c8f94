#pragma once
// Rows of the constant tables that compiled programs carry, built field by field and by name.

#include <llvm/IR/Constants.h>
#include <llvm/IR/Function.h>

#include <concepts>
#include <cstdint>

#include "codegen/abi_types.h"

namespace codegen::abi {

namespace detail {

/// The value as a constant; ends the compiler when the type cannot hold it.
llvm::Constant* integer(llvm::Type* type, int64_t value, bool isSigned);
llvm::Constant* integers(llvm::Type* arrayType, llvm::ArrayRef<int64_t> values, bool isSigned);
/// `function` itself, or null's constant; ends the compiler when the signature is another one.
llvm::Constant* functionOf(llvm::Function* function, llvm::FunctionType* wanted, llvm::StringRef place);

template <class F>
concept FunctionPointer = std::is_pointer_v<F> && std::is_function_v<std::remove_pointer_t<F>>;
template <class F>
concept DataPointer = std::is_pointer_v<F> && !FunctionPointer<F>;

template <class V>
concept PlainInteger = std::is_integral_v<V> || (std::is_enum_v<V> && std::is_convertible_v<V, int>);

/// What a field of type F can be set from: a scoped or nested enum from its own values, any other integer from integers, a
/// pointer from a constant's address, a pointer to a function from a function. Null pointers are written as nullptr.
template <class V, class F>
concept FitsInto = (std::is_enum_v<F> && std::same_as<V, F>) || (std::is_integral_v<F> && PlainInteger<V>) ||
                   (DataPointer<F> && std::convertible_to<V, llvm::Constant*>) ||
                   (FunctionPointer<F> && std::convertible_to<V, llvm::Function*>);

/// Number of the first field of T whose bit is missing in `done`.
template <class T> constexpr size_t firstUnset(uint64_t done) {
    size_t i = 0;
    while (i < kFields<T>.size() && (done >> i & 1) != 0)
        ++i;
    return i;
}

} // namespace detail

/// A constant of struct T. `done` has a bit for each field that has been set: a row can be finished when every field has
/// been, and none can be set twice. A field added to T and forgotten does not compile.
///
///     abi::Row<rt::ModuleDesc>(context).set<&rt::ModuleDesc::name>(text(name)). ... .finish()
template <class T, uint64_t done = 0> class Row {
  public:
    explicit Row(llvm::LLVMContext& context) : type_(structType<T>(context)) {}

    /// The member may be an integer, an enum, a pointer or an array of integers.
    template <auto member, class V>
        requires std::same_as<StructOf<member>, T> && detail::FitsInto<V, TypeOf<member>> &&
                 ((done >> indexOf<member>() & 1) == 0)
    auto set(V value) && {
        using F = TypeOf<member>;
        llvm::Type* type = type_->getElementType(indexOf<member>());
        if constexpr (std::is_same_v<V, std::nullptr_t>)
            return std::move(*this).template with<indexOf<member>()>(llvm::Constant::getNullValue(type));
        else if constexpr (detail::FunctionPointer<F>)
            return std::move(*this).template with<indexOf<member>()>(
                detail::functionOf(value, functionType<F>(type_->getContext()), llvm::getTypeName<T>()));
        else if constexpr (std::is_pointer_v<F>)
            return std::move(*this).template with<indexOf<member>()>(value);
        else
            return std::move(*this).template with<indexOf<member>()>(
                detail::integer(type, static_cast<int64_t>(value), std::is_signed_v<F>));
    }

    template <auto member>
        requires std::same_as<StructOf<member>, T> &&
                 std::is_integral_v<std::remove_extent_t<TypeOf<member>>> &&
                 std::is_array_v<TypeOf<member>> && ((done >> indexOf<member>() & 1) == 0)
    auto set(const std::array<int64_t, std::extent_v<TypeOf<member>>>& values) && {
        return std::move(*this).template with<indexOf<member>()>(
            detail::integers(type_->getElementType(indexOf<member>()), values,
                             std::is_signed_v<std::remove_extent_t<TypeOf<member>>>));
    }

    template <class Struct = T>
        requires(detail::firstUnset<Struct>(done) == kFields<Struct>.size())
    llvm::Constant* finish() && {
        return llvm::ConstantStruct::get(type_, values_);
    }

  private:
    template <class, uint64_t> friend class Row;
    using Values = std::array<llvm::Constant*, kFields<T>.size()>;

    Row(llvm::StructType* type, const Values& values) : type_(type), values_(values) {}
    template <size_t index> Row<T, done | uint64_t{1} << index> with(llvm::Constant* value) && {
        values_[index] = value;
        return {type_, values_};
    }

    llvm::StructType* type_;
    Values values_{};
};

} // namespace codegen::abi
