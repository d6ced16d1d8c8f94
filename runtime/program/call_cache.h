#pragma once
// CallCache: the routines that names in calls have led to. A program calls the same few names over and over, and looking one
// up in the tables takes longer than the call.

#include "runtime/abi/rt_abi.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace rt {

class CallCache {
  public:
    /// The routine kept for this name in a call from a module of a task; null: none. `from` is compared by address.
    const RoutineEntry* find(const String& name, const char* from, int32_t task) const {
        if (slots_ == nullptr) return nullptr;
        const std::size_t first = indexOf(name);
        for (const std::size_t index : {first, first ^ 1}) {
            const Slot& slot = (*slots_)[index];
            if (slot.from == from && slot.task == task && sameBytes(slot.name, name)) return slot.routine;
        }
        return nullptr;
    }
    void keep(const String& name, const char* from, int32_t task, const RoutineEntry& routine) {
        if (slots_ == nullptr) slots_ = std::make_unique<std::array<Slot, kSlots>>();
        const std::size_t first = indexOf(name);
        if ((*slots_)[first].routine != nullptr)
            (*slots_)[first ^ 1] = (*slots_)[first]; // two names may take turns
        (*slots_)[first] = {name, from, task, &routine};
    }
    void clear() { slots_.reset(); }

  private:
    static constexpr std::size_t kSlots = 256;
    struct Slot {
        String name;
        const char* from = nullptr;
        int32_t task = -1;
        const RoutineEntry* routine = nullptr; ///< null: not used yet
    };

    /// The 8 bytes from `offset` on, zeros after the end of the text.
    static uint64_t wordAt(const String& text, uint32_t offset) {
        uint64_t word = 0;
        std::memcpy(&word, text.bytes + offset, sizeof word);
        const uint32_t rest = text.length - offset;
        return rest < sizeof word ? word & ~(~uint64_t{0} << 8 * rest) : word;
    }
    static bool sameBytes(const String& a, const String& b) {
        if (a.length != b.length) return false;
        for (uint32_t offset = 0; offset < a.length; offset += sizeof(uint64_t))
            if (wordAt(a, offset) != wordAt(b, offset)) return false;
        return true;
    }
    static std::size_t indexOf(const String& text) {
        uint64_t hash = text.length;
        for (uint32_t offset = 0; offset < text.length; offset += sizeof(uint64_t)) {
            hash = (hash ^ wordAt(text, offset)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        return hash % kSlots;
    }
    static_assert(sizeof(String::bytes) % sizeof(uint64_t) == 0, "words do not reach beyond the bytes");
    static_assert(std::endian::native == std::endian::little, "the first byte is the lowest one of a word");

    std::unique_ptr<std::array<Slot, kSlots>> slots_;
};

} // namespace rt
