#pragma once
// Patterns of names as SetDataSearch takes them: . [set] [^set] r* r+ r? (r) r|s, without regard to case; a pattern must
// match the whole name. Time is bounded by the lengths of both, whatever the pattern.

#include <cstdint>
#include <string_view>
#include <vector>

namespace rt::lib {

class NamePattern {
  public:
    /// The pattern that every name matches.
    NamePattern() = default;
    /// False when the text is not a pattern; the object then matches nothing.
    bool parse(std::string_view text);
    /// Names of up to 63 characters.
    bool matches(std::string_view name) const;

  private:
    enum class Kind : uint8_t { Set, Sequence, Choice, Repeat };
    struct Node {
        Kind kind = Kind::Sequence;
        bool any[256] = {};          // Set: folded characters
        bool least1 = false;         // Repeat: at least one
        bool once = false;           // Repeat: at most one
        std::vector<uint32_t> parts; // Sequence, Choice; Repeat: one
    };
    class Reader;
    uint64_t step(uint32_t node, uint64_t from, std::string_view name) const;
    std::vector<Node> nodes_;
    uint32_t root_ = 0;
    bool everything_ = true;
};

} // namespace rt::lib
