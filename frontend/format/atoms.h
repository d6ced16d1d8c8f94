#pragma once
// Tokens and comments of a text in one row, with the columns where they stand.

#include "frontend/syntax/ast.h"

#include <vector>

namespace rapid::format {

struct Atom {
    uint32_t begin = 0; ///< offsets in the text; a comment ends before the white space at its end
    uint32_t end = 0;
    syntax::TokenIndex token = 0; ///< comments: the token that follows
    bool isComment = false;
    uint32_t newlines = 0; ///< line ends between the atom before and this one
    uint32_t column = 0;   ///< from 0; tabs are expanded
    uint32_t endColumn = 0;
};

/// All tokens, that for the end of the file included, and all comments. `tabWidth`: columns of a tab.
std::vector<Atom> collectAtoms(const syntax::SyntaxTree& tree, uint32_t tabWidth);

/// Number of code points.
uint32_t displayWidth(std::string_view text);

} // namespace rapid::format
