#pragma once
// The comments above a declaration of the standard library: `!!` lines document it, `!@ key: value   key: value` lines are its
// attributes.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::syntax {

struct Attribute {
    std::string_view key;
    std::string value; ///< as written; lines are joined by one space
};

struct DeclarationComment {
    std::string text; ///< of the `!!` lines, joined by '\n', marks removed
    std::vector<Attribute> attributes;
    std::string_view stray; ///< the first word of an attribute line that has no key before it; empty: none

    /// Empty when it is absent.
    std::string_view get(std::string_view key) const;
};

/// Reads the lines that end `before`, the text in front of a declaration.
DeclarationComment readDeclarationComment(std::string_view before);

} // namespace rapid::syntax
