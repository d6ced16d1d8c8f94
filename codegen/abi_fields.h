#pragma once
// The fields of a plain C++ struct, read off the struct itself: their types, order and places. That is how the layouts of
// rt_abi.h come into LLVM's types without being written down a second time (abi_types.h).

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace llvm {
class LLVMContext;
class Type;
} // namespace llvm

namespace codegen::abi {

/// LLVM's type for an object of type T (defined in abi_types.h).
template <class T> llvm::Type* typeOf(llvm::LLVMContext& context);

/// One field. The struct that another one is derived from counts as its first field.
struct Field {
    llvm::Type* (*type)(llvm::LLVMContext&) = nullptr;
    size_t size = 0, align = 1, offset = 0;

    template <class T> static constexpr Field of() { return {&typeOf<T>, sizeof(T), alignof(T), 0}; }
};

namespace detail {

/// Turns into any scalar that a field asks for.
struct Anything {
    template <class F>
        requires std::is_scalar_v<F>
    operator F() const;
};

/// Turns into nothing but a struct that T is derived from.
template <class T> struct BaseOnly {
    template <class B>
        requires(std::is_base_of_v<B, T> && !std::is_same_v<B, T>)
    operator B() const;
};

template <class T> constexpr bool kHasBase = requires { T{BaseOnly<T>{}}; };

/// Whether T can be made of one braced value for each number: arrays and structs take theirs inside the braces.
template <class T, size_t... i> constexpr bool hasFields(std::index_sequence<i...>) {
    return requires { T{{(static_cast<void>(i), Anything{})}...}; };
}

template <class T, size_t count = 1> constexpr size_t countFields() {
    if constexpr (hasFields<T>(std::make_index_sequence<count>{}))
        return countFields<T, count + 1>();
    else
        return count - 1;
}

/// Only the addresses of its fields matter.
template <class T> inline constexpr T kSample{};

template <class... F> constexpr std::tuple<const F*...> addressesOf(const F&... fields) {
    return {&fields...};
}

// Structured bindings want their number written out: one rung for each.
// clang-format off
#define RAPIDC_RUNG(number, ...)                                                                             \
    if constexpr (count == number) { const auto& [__VA_ARGS__] = kSample<T>; return addressesOf(__VA_ARGS__); } else

/// The offsets of the fields of kSample<T>. T has no base.
template <class T> constexpr auto fieldAddresses() {
    constexpr size_t count = countFields<T>();
    static_assert(count >= 1 && count <= 28, "a struct of more fields needs a further rung");
    RAPIDC_RUNG(1, a)
    RAPIDC_RUNG(2, a, b)
    RAPIDC_RUNG(3, a, b, c)
    RAPIDC_RUNG(4, a, b, c, d)
    RAPIDC_RUNG(5, a, b, c, d, e)
    RAPIDC_RUNG(6, a, b, c, d, e, f)
    RAPIDC_RUNG(7, a, b, c, d, e, f, g)
    RAPIDC_RUNG(8, a, b, c, d, e, f, g, h)
    RAPIDC_RUNG(9, a, b, c, d, e, f, g, h, i)
    RAPIDC_RUNG(10, a, b, c, d, e, f, g, h, i, j)
    RAPIDC_RUNG(11, a, b, c, d, e, f, g, h, i, j, k)
    RAPIDC_RUNG(12, a, b, c, d, e, f, g, h, i, j, k, l)
    RAPIDC_RUNG(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
    RAPIDC_RUNG(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
    RAPIDC_RUNG(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
    RAPIDC_RUNG(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
    RAPIDC_RUNG(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
    RAPIDC_RUNG(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
    RAPIDC_RUNG(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
    RAPIDC_RUNG(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
    RAPIDC_RUNG(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
    RAPIDC_RUNG(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
    RAPIDC_RUNG(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
    RAPIDC_RUNG(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
    RAPIDC_RUNG(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
    RAPIDC_RUNG(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
    RAPIDC_RUNG(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa)
    RAPIDC_RUNG(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, bb)
    {}
}

#undef RAPIDC_RUNG
// clang-format on

// Structured bindings do not reach the fields of a derived struct. Theirs, which must be scalars and no pointers to
// functions, are made of values that note the type they are asked for.

template <class P> inline constexpr P kSomewhere{};

/// Becomes zero, or another value when it is `marked`.
struct Recorder {
    Field* field = nullptr;
    bool marked = false;

    template <class F>
        requires(std::is_scalar_v<F> || std::is_class_v<F>)
    constexpr operator F() const {
        if (field != nullptr) *field = Field::of<F>();
        if constexpr (std::is_class_v<F>) {
            return F{};
        } else if constexpr (std::is_pointer_v<F>) {
            using Target = std::remove_pointer_t<F>;
            return marked ? const_cast<F>(&kSomewhere<std::remove_cv_t<Target>>) : nullptr;
        } else {
            return static_cast<F>(marked ? 1 : 0);
        }
    }
};

template <class T, size_t... i> constexpr auto recordFields(std::index_sequence<i...>) {
    std::array<Field, sizeof...(i)> fields{};
    static_cast<void>(T{Recorder{&fields[i]}...});
    return fields;
}

/// T with all fields zero but one.
template <class T, size_t... i> constexpr T marked(size_t which, std::index_sequence<i...>) {
    return T{Recorder{nullptr, i == which}...};
}

template <class T> constexpr auto unplacedFields() {
    constexpr size_t count = countFields<T>();
    if constexpr (kHasBase<T>) {
        return recordFields<T>(std::make_index_sequence<count>{});
    } else {
        return std::apply(
            []<class... F>(const F*...) { return std::array<Field, sizeof...(F)>{Field::of<F>()...}; },
            fieldAddresses<T>());
    }
}

constexpr size_t roundUp(size_t size, size_t align) {
    return (size + align - 1) / align * align;
}

/// The fields, each at the first place after the one before that its alignment allows: LLVM lays structs out that way.
/// C++ does, too, unless a struct has attributes of layout, or a base with a gap at its end.
template <class T> constexpr auto placedFields() {
    auto fields = unplacedFields<T>();
    size_t end = 0;
    for (Field& field : fields) {
        field.offset = roundUp(end, field.align);
        end = field.offset + field.size;
    }
    return fields;
}

template <size_t count> constexpr size_t largestAlign(const std::array<Field, count>& fields) {
    size_t align = 1;
    for (const Field& field : fields)
        align = field.align > align ? field.align : align;
    return align;
}

template <class Member> struct MemberParts;
template <class S, class F> struct MemberParts<F S::*> {
    using Struct = S;
    using Type = F;
};

} // namespace detail

/// The fields of struct T in their order.
template <class T> inline constexpr auto kFields = detail::placedFields<T>();

/// Size and alignment of T are what its fields need, which is all that LLVM knows of it.
template <class T>
concept LaidOutNaturally =
    std::is_aggregate_v<T> && std::is_trivially_copyable_v<T> &&
    detail::largestAlign(kFields<T>) == alignof(T) &&
    detail::roundUp(kFields<T>.back().offset + kFields<T>.back().size, alignof(T)) == sizeof(T);

/// The struct that declares a member, and the type of the member.
template <auto member> using StructOf = typename detail::MemberParts<decltype(member)>::Struct;
template <auto member> using TypeOf = typename detail::MemberParts<decltype(member)>::Type;

/// Position of a member in kFields of its struct.
template <auto member> constexpr size_t indexOf() {
    using T = StructOf<member>;
    constexpr size_t count = kFields<T>.size();
    size_t found = count;
    if constexpr (detail::kHasBase<T>) {
        for (size_t i = 1; i < count; ++i)
            if (detail::marked<T>(i, std::make_index_sequence<count>{}).*member != TypeOf<member>{})
                found = i;
    } else {
        std::apply(
            [&](const auto*... field) {
                size_t index = 0;
                ((found = static_cast<const void*>(field) == &(detail::kSample<T>.*member) ? index : found,
                  ++index),
                 ...);
            },
            detail::fieldAddresses<T>());
    }
    return found;
}

/// Bytes from the beginning of its struct.
template <auto member>
inline constexpr size_t kOffsetOf = kFields<StructOf<member>>[indexOf<member>()].offset;

} // namespace codegen::abi
