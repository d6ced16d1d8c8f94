// Interning of identifiers.

#include "frontend/sema/names.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace rapid::sema {

namespace {

/// Equal for names that differ in case only: the bit that distinguishes upper from lower case is left out, even in the
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
    for (size_t i = 0; i < name.size(); ++i)
        if (config::lowerByte(name[i], i > 0 ? name[i - 1] : '\0') != folded[i]) return false;
    return true;
}

} // namespace

Interner::Interner() : slots_(4096) {}

NameId Interner::intern(std::string_view name) {
    const uint32_t hash = foldedHash(name);
    for (size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
        const Slot slot = slots_[i];
        if (slot.record == kFree) return add(name, hash, i);
        if (slot.hash != hash || wordAt(slot.record + 4) != name.size()) continue;
        const char* spelling = text_.data() + slot.record + kHead;
        if (std::memcmp(name.data(), spelling, name.size()) == 0 ||
            equalsFolded(name, spelling + name.size()))
            return wordAt(slot.record);
    }
}

void Interner::expect(std::string_view name) const {
    __builtin_prefetch(&slots_[foldedHash(name) & (slots_.size() - 1)]);
}

NameId Interner::add(std::string_view name, uint32_t hash, size_t slot) {
    const auto id = static_cast<NameId>(records_.size());
    const size_t at = text_.size(), size = name.size();
    records_.push_back(static_cast<uint32_t>(at));
    text_.resize(at + kHead + 2 * size);
    const auto length = static_cast<uint32_t>(size);
    std::memcpy(text_.data() + at, &id, sizeof id);
    std::memcpy(text_.data() + at + 4, &length, sizeof length);
    std::copy(name.begin(), name.end(), text_.data() + at + kHead);
    for (size_t i = 0; i < size; ++i)
        text_[at + kHead + size + i] = config::lowerByte(name[i], i > 0 ? name[i - 1] : '\0');
    shapes_.push_back(shapeOf(folded(id)));
    slots_[slot] = {hash, static_cast<uint32_t>(at)};
    if (records_.size() * 2 > slots_.size()) grow();
    return id;
}

void Interner::grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots_.size() * 2));
    for (const Slot& slot : old) {
        if (slot.record == kFree) continue;
        size_t i = slot.hash & (slots_.size() - 1);
        while (slots_[i].record != kFree)
            i = (i + 1) & (slots_.size() - 1);
        slots_[i] = slot;
    }
}

} // namespace rapid::sema
