#pragma once
// Identifiers as small numbers: RAPID names are compared without regard to case (manual 1.1.1, 1.1.2).

#include "config/letter_case.h"
#include "frontend/source/spelling.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::sema {

using NameId = uint32_t;

/// Gives equal numbers to names that differ only in case; letters of ISO 8859-1 are folded too.
class Interner {
  public:
    Interner();
    NameId intern(std::string_view name);
    /// Begins to load what intern() will look at: a table of many names lies far from the processor.
    void expect(std::string_view name) const;
    /// The folded (lower-case) spelling.
    std::string_view folded(NameId id) const {
        const uint32_t length = wordAt(records_[id] + 4);
        return {text_.data() + records_[id] + kHead + length, length};
    }
    WordShape shape(NameId id) const { return shapes_[id]; }
    size_t size() const { return records_.size(); }

  private:
    static constexpr uint32_t kFree = 0xFFFFFFFFu;
    static constexpr size_t kHead = 8; ///< bytes of a record before its text
    struct Slot {
        uint32_t hash = 0;
        uint32_t record = kFree;
    };
    NameId add(std::string_view name, uint32_t hash, size_t slot);
    void grow();
    uint32_t wordAt(size_t at) const {
        uint32_t word = 0;
        std::memcpy(&word, text_.data() + at, sizeof word);
        return word;
    }

    /// A record for each name: its number, its length, its spelling where it appeared first (most others are the same),
    /// and that folded. All that is compared lies together: with many names each place is far from the processor.
    std::vector<char> text_;
    std::vector<uint32_t> records_; ///< where they begin, by number
    std::vector<WordShape> shapes_; ///< by number
    std::vector<Slot> slots_;       ///< their number is a power of two
};

/// Map from names to pointers, made for many small scopes: open addressing, no node allocation.
template <class T> class NameMap {
  public:
    T* find(NameId name) const {
        if (slots_.empty()) return nullptr;
        for (size_t i = name * kSpread & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
            if (!slots_[i].value) return nullptr;
            if (slots_[i].name == name) return slots_[i].value;
        }
    }
    /// Adds or replaces.
    void set(NameId name, T* value) {
        if ((count_ + 1) * 2 > slots_.size()) grow();
        for (size_t i = name * kSpread & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
            if (slots_[i].value && slots_[i].name != name) continue;
            if (!slots_[i].value) ++count_;
            slots_[i] = {name, value};
            return;
        }
    }
    size_t size() const { return count_; }
    template <class F> void forEach(F&& visit) const {
        for (const Slot& s : slots_)
            if (s.value) visit(s.name, s.value);
    }

  private:
    static constexpr size_t kSpread = 2654435761u;
    struct Slot {
        NameId name = 0;
        T* value = nullptr;
    };
    void grow() {
        std::vector<Slot> old = std::move(slots_);
        slots_.assign(old.empty() ? 16 : old.size() * 2, Slot{});
        count_ = 0;
        for (const Slot& s : old)
            if (s.value) set(s.name, s.value);
    }
    std::vector<Slot> slots_;
    size_t count_ = 0;
};

/// The folded spelling of a name that is not interned.
inline std::string foldName(std::string_view name) {
    return config::lowerCase(name);
}

} // namespace rapid::sema
