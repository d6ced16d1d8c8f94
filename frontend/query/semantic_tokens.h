#pragma once
// The kind of each name, for colours (editor contract 14).

#include "frontend/query/name_walk.h"

namespace rapid::query {

enum class TokenType : uint8_t {
    Namespace,
    Type,
    Function,
    Parameter,
    Variable,
    Property,
    Label,
    Keyword,
    String,
    Number,
    Comment
};
enum TokenModifier : uint8_t {
    kDeclaration = 1,
    kReadonly = 2,       ///< CONST
    kDefaultLibrary = 4, ///< predefined
    kStatic = 8          ///< PERS
};

struct SemanticToken {
    uint32_t offset = 0;
    uint32_t length = 0;
    TokenType type = TokenType::Variable;
    uint8_t modifiers = 0;
};

/// In the order of the text, none overlapping. `withSyntax`: keywords, strings, numbers and comments as well, for editors without a grammar.
std::vector<SemanticToken> semanticTokens(const Snapshot& snapshot, const FileView& file, SourceRange range,
                                          bool withSyntax = false, const Cancel* cancel = nullptr);
/// The whole file.
std::vector<SemanticToken> semanticTokens(const Snapshot& snapshot, const FileView& file,
                                          const Cancel* cancel = nullptr);

} // namespace rapid::query
