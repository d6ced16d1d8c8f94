#pragma once
// Reads frontend/rapid.ebnf and derives random sentences from it.

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::test {

struct Grammar {
    enum class Kind : uint8_t { Terminal, Range, Rule, Sequence, Choice, Optional, Repeat };
    struct Part {
        Kind kind = Kind::Sequence;
        std::string text;  ///< terminal, rule name
        uint32_t low = 0;  ///< first character of a range
        uint32_t high = 0; ///< last one
        std::vector<Part> parts;
        uint32_t depth = 0; ///< height of the lowest derivation
    };
    struct Rule {
        Part body;
        bool characters = false; ///< defined by ::=
        uint32_t depth = 0;      ///< height of the lowest derivation
    };
    std::map<std::string, Rule> rules;
};

/// Throws std::runtime_error with the place when the text is not in the notation, or a rule is not defined.
Grammar readGrammar(std::string_view text);

/// The tokens of a sentence of `start`, at most about `depth` rules deep.
std::vector<std::string> deriveSentence(const Grammar& grammar, const std::string& start, uint32_t depth,
                                        std::mt19937& random);

/// A text of these tokens: random layout, case and comments, a new line after each semicolon and END word.
std::string layOut(const std::vector<std::string>& tokens, std::mt19937& random);

} // namespace rapid::test
