#include "frontend/query/semantic_tokens.h"

#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

void classify(const Meaning& meaning, SemanticToken& token) {
    if (meaning.access == Access::Declaration) token.modifiers |= kDeclaration;
    if (meaning.module) {
        token.type = TokenType::Namespace;
        return;
    }
    if (meaning.record) {
        token.type = TokenType::Property;
        if (!meaning.record->module || meaning.record->module->predefined) token.modifiers |= kDefaultLibrary;
        return;
    }
    const Symbol& symbol = *meaning.symbol;
    if (symbol.predefined) token.modifiers |= kDefaultLibrary;
    switch (symbol.kind) {
    case SymbolKind::Type: token.type = TokenType::Type; return;
    case SymbolKind::Routine: token.type = TokenType::Function; return;
    case SymbolKind::Label: token.type = TokenType::Label; return;
    case SymbolKind::Module: token.type = TokenType::Namespace; return;
    case SymbolKind::Data: break;
    }
    const auto& data = static_cast<const DataSymbol&>(symbol);
    token.type = data.storage == Storage::Parameter ? TokenType::Parameter : TokenType::Variable;
    if (data.storage == Storage::Parameter) {
        if (data.routine && data.routine->predefined) token.modifiers |= kDefaultLibrary;
    } else if (data.storage == Storage::ModuleData || data.storage == Storage::RoutineData) {
        if (data.dataKind == DataKind::Const) token.modifiers |= kReadonly;
        if (data.dataKind == DataKind::Pers) token.modifiers |= kStatic;
    } else if (data.storage == Storage::LoopVariable) {
        token.modifiers |= kReadonly;
    }
}

/// Words, literals and comments, except where a name has a token already.
void addSyntax(const FileView& file, SourceRange range, std::vector<SemanticToken>& out) {
    const std::vector<SemanticToken> names = out;
    const auto isName = [&](uint32_t offset) {
        const auto at = std::lower_bound(names.begin(), names.end(), offset,
                                         [](const SemanticToken& t, uint32_t o) { return t.offset < o; });
        return at != names.end() && at->offset == offset;
    };
    const auto add = [&](uint32_t begin, uint32_t end, TokenType type) {
        if (begin < range.end && end > range.begin && end > begin)
            out.push_back({begin, end - begin, type, 0});
    };
    const std::string_view text = file.text();
    uint32_t from = 0;
    for (TokenIndex t = 0; t < tokenCountOf(file); ++t) {
        const Token& token = file.tree->tokens[t];
        for (size_t at = text.substr(0, token.offset).find('!', from); at < token.offset;) {
            const size_t end = std::min<size_t>(text.find_first_of("\r\n", at), token.offset);
            add(static_cast<uint32_t>(at), static_cast<uint32_t>(end), TokenType::Comment);
            at = text.substr(0, token.offset).find('!', end);
        }
        from = token.offset + token.length;
        if (isName(token.offset)) continue;
        if (isKeyword(token.kind)) add(token.offset, from, TokenType::Keyword);
        if (token.kind == TokenKind::StringLiteral) add(token.offset, from, TokenType::String);
        if (token.kind == TokenKind::NumLiteral) add(token.offset, from, TokenType::Number);
    }
    std::sort(out.begin(), out.end(),
              [](const SemanticToken& a, const SemanticToken& b) { return a.offset < b.offset; });
}

} // namespace

std::vector<SemanticToken> semanticTokens(const Snapshot& snapshot, const FileView& file, SourceRange range,
                                          bool withSyntax, const Cancel* cancel) {
    std::vector<SemanticToken> tokens;
    forEachName(
        snapshot, file, range,
        [&](const Meaning& meaning) {
            const SourceRange place = meaning.range();
            if (place.begin >= range.end || place.end <= range.begin || place.end <= place.begin) return;
            SemanticToken token{place.begin, place.end - place.begin, TokenType::Variable, 0};
            classify(meaning, token);
            tokens.push_back(token);
        },
        cancel);
    std::sort(tokens.begin(), tokens.end(),
              [](const SemanticToken& a, const SemanticToken& b) { return a.offset < b.offset; });
    tokens.erase(
        std::unique(tokens.begin(), tokens.end(),
                    [](const SemanticToken& a, const SemanticToken& b) { return a.offset == b.offset; }),
        tokens.end());
    if (withSyntax) addSyntax(file, range, tokens);
    return tokens;
}

std::vector<SemanticToken> semanticTokens(const Snapshot& snapshot, const FileView& file,
                                          const Cancel* cancel) {
    return semanticTokens(snapshot, file, {0, static_cast<uint32_t>(file.text().size()) + 1}, false, cancel);
}

} // namespace rapid::query
