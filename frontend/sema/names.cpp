// Interning of identifiers.

#include "frontend/sema/names.h"

#include <algorithm>
#include <cstring>

namespace rapid::sema {

namespace {

constexpr unsigned char kLatin1Lead = 0xC3; // first byte of U+00C0 to U+00FF in UTF-8

/// Lower case of one byte; `previous` tells the second byte of an ISO 8859-1 letter from others.
unsigned char foldByte(unsigned char c, unsigned char previous) {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned char>(c + 32);
    const bool upperLatin1 = previous == kLatin1Lead && c >= 0x80 && c <= 0x9E && c != 0x97;
    return upperLatin1 ? static_cast<unsigned char>(c + 0x20) : c;
}

/// Equal for names that differ in case only: the bit that tells the cases of letters apart is left out, also in the
/// second bytes of ISO 8859-1 letters. Eight bytes at a time, the last ones overlapping those before.
uint32_t foldedHash(std::string_view name) {
    constexpr uint64_t kLowerCase = 0x2020202020202020u;
    constexpr uint64_t kFactor = 0x9E3779B97F4A7C15u;
    const auto word = [](const char* at, size_t size) {
        uint64_t bytes = 0;
        std::memcpy(&bytes, at, size);
        return bytes | kLowerCase;
    };
    uint64_t hash = name.size() * kFactor;
    const auto mix = [&](uint64_t bytes) {
        hash = (hash ^ bytes) * kFactor;
        hash ^= hash >> 32;
    };
    const char* at = name.data();
    const size_t size = name.size();
    if (size >= 8) {
        for (size_t i = 0; i + 8 < size; i += 8)
            mix(word(at + i, 8));
        mix(word(at + size - 8, 8));
    } else if (size >= 4) {
        mix(word(at, 4) | word(at + size - 4, 4) << 32);
    } else {
        for (size_t i = 0; i < size; ++i)
            mix(word(at + i, 1));
    }
    return static_cast<uint32_t>(hash);
}

bool equalsFolded(std::string_view name, const char* folded) {
    unsigned char previous = 0;
    for (size_t i = 0; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        if (foldByte(c, previous) != static_cast<unsigned char>(folded[i])) return false;
        previous = c;
    }
    return true;
}

} // namespace

Interner::Interner() : slots_(4096, 0) {}

NameId Interner::intern(std::string_view name) {
    const uint32_t hash = foldedHash(name);
    for (size_t slot = hash & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
        if (slots_[slot] == 0) return add(name, hash, slot);
        const Entry& entry = entries_[slots_[slot] - 1];
        if (entry.hash == hash && entry.length == name.size() &&
            (std::memcmp(name.data(), spelling_.data() + entry.begin, name.size()) == 0 ||
             equalsFolded(name, text_.data() + entry.begin)))
            return slots_[slot] - 1;
    }
}

void Interner::expect(std::string_view name) const {
    __builtin_prefetch(&slots_[foldedHash(name) & (slots_.size() - 1)]);
}

NameId Interner::add(std::string_view name, uint32_t hash, size_t slot) {
    const auto id = static_cast<NameId>(entries_.size());
    entries_.push_back({hash, static_cast<uint32_t>(text_.size()), static_cast<uint32_t>(name.size())});
    spelling_.insert(spelling_.end(), name.begin(), name.end());
    unsigned char previous = 0;
    for (const char ch : name) {
        const auto c = static_cast<unsigned char>(ch);
        text_.push_back(static_cast<char>(foldByte(c, previous)));
        previous = c;
    }
    slots_[slot] = id + 1;
    if (entries_.size() * 2 > slots_.size()) grow();
    return id;
}

void Interner::grow() {
    slots_.assign(slots_.size() * 2, 0);
    for (size_t i = 0; i < entries_.size(); ++i) {
        size_t slot = entries_[i].hash & (slots_.size() - 1);
        while (slots_[slot] != 0)
            slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = static_cast<uint32_t>(i + 1);
    }
}

std::string foldName(std::string_view name) {
    std::string out(name);
    unsigned char previous = 0;
    for (char& ch : out) {
        const auto c = static_cast<unsigned char>(ch);
        ch = static_cast<char>(foldByte(c, previous));
        previous = c;
    }
    return out;
}

} // namespace rapid::sema
