#pragma once
// The bytes of a string sixteen at a time. A string always has room for whole blocks: they are loaded without asking for its
// length, and bits of bytes that follow the text are masked. Each mask has a bit for each byte of a block, the lowest for
// the first.

#include "runtime/abi/rt_abi.h"

#include <bit>
#include <cstring>
#include <string_view>

#if defined(__SSSE3__)
#include <tmmintrin.h>
#endif

namespace rt::lib {

inline constexpr size_t kBlock = 16;
inline constexpr uint32_t kWholeBlock = 0xFFFF;
static_assert(kStringCapacity % kBlock == 0);

#if defined(__clang__)

/// Vectors of LLVM: few instructions of its IR, on all processors.
template <size_t Size> struct Vector {
    using Bytes = signed char __attribute__((ext_vector_type(Size)));
    using Bits = bool __attribute__((ext_vector_type(Size)));

    explicit Vector(const char* from) { std::memcpy(&bytes, from, sizeof bytes); }

    Bytes bytes;
};
using Block = Vector<kBlock>;

/// Bytes above 0x7F among the first 64.
inline uint64_t highBytesOfFront(const String& text) {
    const Vector<64> front(text.bytes);
    return std::bit_cast<uint64_t>(__builtin_convertvector(front.bytes < 0, Vector<64>::Bits));
}
inline uint32_t highBytes(const char* block) {
    return std::bit_cast<uint16_t>(__builtin_convertvector(Block(block).bytes < 0, Block::Bits));
}
inline uint32_t bytesEqualTo(const char* block, char byte) {
    const auto equal = Block(block).bytes == static_cast<signed char>(byte);
    return std::bit_cast<uint16_t>(__builtin_convertvector(equal, Block::Bits));
}
inline uint32_t equalBytes(const char* a, const char* b) {
    return std::bit_cast<uint16_t>(__builtin_convertvector(Block(a).bytes == Block(b).bytes, Block::Bits));
}
/// Writes a byte where another block has a certain one.
inline void putWhere(char* block, const char* other, char byte, char put) {
    Block result(block);
    const auto found = Block(other).bytes == static_cast<signed char>(byte);
    result.bytes = (result.bytes & ~found) | (static_cast<signed char>(put) & found);
    std::memcpy(block, &result.bytes, kBlock);
}

#else

template <class Test> uint32_t maskOf(Test test) {
    uint32_t mask = 0;
    for (size_t i = 0; i < kBlock; ++i)
        mask |= uint32_t{test(i)} << i;
    return mask;
}
inline uint32_t highBytes(const char* block) {
    return maskOf([=](size_t i) { return static_cast<uint8_t>(block[i]) >= 0x80; });
}
inline uint64_t highBytesOfFront(const String& text) {
    uint64_t mask = 0;
    for (size_t i = 0; i < 64; i += kBlock)
        mask |= uint64_t{highBytes(text.bytes + i)} << i;
    return mask;
}
inline uint32_t bytesEqualTo(const char* block, char byte) {
    return maskOf([=](size_t i) { return block[i] == byte; });
}
inline uint32_t equalBytes(const char* a, const char* b) {
    return maskOf([=](size_t i) { return a[i] == b[i]; });
}
inline void putWhere(char* block, const char* other, char byte, char put) {
    for (size_t i = 0; i < kBlock; ++i)
        block[i] = other[i] == byte ? put : block[i];
}

#endif

/// Offset of the first byte that a mask has a bit for.
inline size_t firstOf(uint64_t mask) {
    return static_cast<size_t>(std::countr_zero(mask));
}

/// True when every byte of the text is a character of its own (no byte above 0x7F): positions are offsets then. Has no loop
/// and no branch, so that programs ask once for a string that does not change.
inline bool isAscii(const String& text) {
    static_assert(kStringCapacity == 64 + kBlock);
    const size_t length = text.size();
    const uint64_t inFront = length >= 64 ? ~uint64_t{0} : (uint64_t{1} << length) - 1;
    const uint64_t inBack = length > 64 ? (uint64_t{1} << (length - 64)) - 1 : 0;
    return ((highBytesOfFront(text) & inFront) | (highBytes(text.bytes + 64) & inBack)) == 0;
}

/// A set of characters up to 0x7F, others that the text has left out: two words of bits, which programs keep in registers.
class AsciiSet {
  public:
    explicit AsciiSet(std::string_view characters) {
#pragma clang loop vectorize(disable) unroll(disable)
        for (const char character : characters) {
            const auto code = static_cast<uint8_t>(character);
            const uint64_t bit = uint64_t{1} << (code & 0x3F);
            low_ |= code < 0x40 ? bit : 0;
            high_ |= code >= 0x40 && code < 0x80 ? bit : 0;
        }
    }
    /// Asked for characters up to 0x7F.
    bool contains(char character) const {
        const uint64_t low = low_; // both are read: the word chosen first would be taken from memory
        const uint64_t high = high_;
        const auto code = static_cast<uint8_t>(character);
        return ((code >= 0x40 ? high : low) >> (code & 0x3F) & 1) != 0;
    }

  private:
    uint64_t low_ = 0;
    uint64_t high_ = 0;
};

/// As AsciiSet, for blocks: a byte for each lower half of a code, and in it a bit for each upper half.
class AsciiRows {
  public:
    explicit AsciiRows(std::string_view characters) {
#pragma clang loop vectorize(disable) unroll(disable)
        for (const char character : characters) {
            const auto code = static_cast<uint8_t>(character);
            const uint64_t bit = code < 0x80 ? uint64_t{1} << ((code & 7U) * 8 + (code >> 4)) : 0;
            low_ |= (code & 8) != 0 ? 0 : bit;
            high_ |= (code & 8) != 0 ? bit : 0;
        }
    }
    /// Characters of the set in a block; none above 0x7F.
    uint32_t membersOf(const char* block) const {
#if defined(__SSSE3__)
        return ~static_cast<uint32_t>(_mm_movemask_epi8(others(load(block)))) & kWholeBlock;
#else
        uint32_t mask = 0;
        for (size_t i = 0; i < kBlock; ++i)
            mask |= uint32_t{contains(block[i])} << i;
        return mask;
#endif
    }
    /// Copies a block and adds a number to the code of each character of the set.
    void shift(const char* block, char amount, char* result) const {
#if defined(__SSSE3__)
        const __m128i bytes = load(block);
        const __m128i added = _mm_andnot_si128(others(bytes), _mm_set1_epi8(amount));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(result), _mm_add_epi8(bytes, added));
#else
        for (size_t i = 0; i < kBlock; ++i)
            result[i] = static_cast<char>(block[i] + (contains(block[i]) ? amount : 0));
#endif
    }

  private:
#if defined(__SSSE3__)
    static __m128i load(const char* block) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(block));
    }
    /// A byte with all bits for each that is not in the set.
    __m128i others(__m128i bytes) const {
        const __m128i rows = _mm_set_epi64x(static_cast<int64_t>(high_), static_cast<int64_t>(low_));
        const __m128i upper = _mm_and_si128(_mm_srli_epi16(bytes, 4), _mm_set1_epi8(0x0F));
        const __m128i bit =
            _mm_shuffle_epi8(_mm_setr_epi8(1, 2, 4, 8, 16, 32, 64, -128, 0, 0, 0, 0, 0, 0, 0, 0), upper);
        const __m128i found = _mm_and_si128(_mm_shuffle_epi8(rows, bytes), bit);
        return _mm_cmpeq_epi8(found, _mm_setzero_si128());
    }
#else
    bool contains(char character) const {
        const auto code = static_cast<uint8_t>(character);
        const uint64_t row = ((code & 8) != 0 ? high_ : low_) >> (code & 7U) * 8;
        return code < 0x80 && (row >> (code >> 4) & 1) != 0;
    }
#endif

    uint64_t low_ = 0; ///< characters whose lower half is 0 to 7
    uint64_t high_ = 0;
};

// Compiled code knows the results when the string is a constant (codegen/constant_calls.h).
[[gnu::noinline]] inline AsciiSet asciiSetOf(const String& characters) {
    return AsciiSet(characters.view());
}
[[gnu::noinline]] inline AsciiRows asciiRowsOf(const String& characters) {
    return AsciiRows(characters.view());
}

/// Copies up to 80 bytes between strings that may be one: short texts without a call, with what follows them.
inline void copyText(char* to, size_t room, const char* from, size_t readable, size_t size) {
    if (size <= kBlock && room >= kBlock && readable >= kBlock) {
        char block[kBlock];
        std::memcpy(block, from, kBlock);
        std::memcpy(to, block, kBlock);
    } else {
        std::memmove(to, from, size);
    }
}

} // namespace rt::lib
