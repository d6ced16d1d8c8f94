#pragma once
// Tree -> meaning of each token for the layout: whether it begins a line, at which level, and its neighbours.

#include "frontend/format/format_settings.h"
#include "frontend/syntax/ast.h"

#include <vector>

namespace rapid::format {

enum class LineBreak : uint8_t {
    Keep,  ///< on a line of its own where it was
    Must,  ///< begins a line
    Never, ///< directly after the token before, unless a comment keeps it away
};

/// Facts about one token, as bits.
enum TokenFlag : uint16_t {
    kBeginsLine = 1,         ///< first token of an instruction or declaration
    kOpensBlock = 2,         ///< MODULE, RECORD, PROC, IF ... THEN, FOR, WHILE, TEST
    kCompactBody = 4,        ///< first token of the instruction of a compact IF
    kCallName = 8,           ///< name of a called procedure: arguments follow without parenthesis
    kSign = 16,              ///< + or - before an operand
    kLateOpen = 32,          ///< the first % of a late-bound call
    kLateClose = 64,         ///< the second one
    kTightAssign = 128,      ///< := of an argument
    kNoKeyword = 256,        ///< a keyword that is used as a name (\Continue)
    kUpperWord = 512,        ///< TASK
    kLowerWord = 1024,       ///< switch
    kNameUse = 2048,         ///< a name that may be predefined
    kListComma = 4096,       ///< a comma in [ ] or { }
    kVerbatim = 8192,        ///< in a part with mistakes: left as it is
    kEmptyStatement = 16384, ///< a semicolon too many
    kLabel = 32768           ///< first token of a label
};

struct TokenPlan {
    LineBreak lineBreak = LineBreak::Keep;
    bool hasLevel = false;  ///< on a line of its own it is at `level`, else indented as a continuation
    bool endsBlock = false; ///< END word, ELSE, CASE, ERROR ...: comments before it may belong to the block
    uint16_t flags = 0;
    uint16_t level = 0;
    uint16_t commentLevel = 0; ///< of comment lines before it; endsBlock: level of the block that ends
    bool has(uint16_t flag) const { return (flags & flag) != 0; }
};

/// One entry a token, the end of the file included. Declarations in which a place of `broken` lies are marked verbatim.
std::vector<TokenPlan> planLines(const syntax::SyntaxTree& tree, const FormatSettings& settings,
                                 const std::vector<SourceRange>& broken);

} // namespace rapid::format
