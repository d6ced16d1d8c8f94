#include "frontend/query/edit_places.h"

#include "frontend/edit/apply_edits.h"
#include "frontend/sema/type_rules.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

TextEdit InsertPlace::edit(std::string_view lines) const {
    std::string text;
    while (true) {
        const size_t end = lines.find('\n');
        const std::string_view line = lines.substr(0, end);
        const std::string own = line.empty() ? "" : indent + std::string(line);
        text += lineBefore ? eol + own : own + eol;
        if (end == std::string_view::npos) break;
        lines.remove_prefix(end + 1);
    }
    return {{offset, offset}, text};
}

std::string indentAt(std::string_view text, uint32_t offset) {
    offset = std::min(offset, static_cast<uint32_t>(text.size()));
    const size_t line = offset == 0 ? std::string_view::npos : text.find_last_of("\r\n", offset - 1);
    const size_t begin = line == std::string_view::npos ? 0 : line + 1;
    const size_t end = std::min(text.find_first_not_of(" \t", begin), text.size());
    return std::string(text.substr(begin, std::min<size_t>(end, offset) - begin));
}

std::string indentUnit(const FileView& file, const Module& module) {
    if (module.decl)
        for (const Decl* decl : module.decl->decls) {
            const SourceRange own = file.tree->range(*decl);
            const std::string outer = indentAt(file.text(), own.begin);
            if (decl->kind != NodeKind::Routine) {
                if (!outer.empty() && outer.size() <= 8) return outer;
                continue;
            }
            const auto& routine = as<RoutineDecl>(*decl);
            const Node* inner = routine.body.empty() ? nullptr : routine.body.front();
            if (!inner || inner->first == kNoToken) continue;
            const std::string in = indentAt(file.text(), file.tree->tokens[inner->first].offset);
            if (in.size() > outer.size() && in.starts_with(outer)) return in.substr(outer.size());
        }
    return "   ";
}

namespace {

/// The end of the line in which a token ends, a comment after it included.
uint32_t lineEndAfter(std::string_view text, uint32_t offset) {
    const size_t end = text.find_first_of("\r\n", offset);
    return static_cast<uint32_t>(end == std::string_view::npos ? text.size() : end);
}

/// Lines after the token, unless something else follows it on its line: then directly after the token.
InsertPlace placeAfter(const FileView& file, TokenIndex token, std::string indent) {
    InsertPlace place;
    const std::string_view text = file.text();
    uint32_t end = file.tree->range(token).end;
    const TokenIndex next = token + 1;
    if (next < tokenCountOf(file) && file.tree->tokens[next].kind == TokenKind::Semicolon &&
        file.tree->tokens[token].kind != TokenKind::Semicolon)
        end = file.tree->range(next).end;
    const uint32_t line = lineEndAfter(text, end);
    const uint32_t following = [&] {
        const TokenIndex after = tokenFrom(file, end);
        return after == kNoToken ? line : file.tree->tokens[after].offset;
    }();
    place.offset = following < line ? end : line;
    place.indent = std::move(indent);
    place.eol = std::string(edit::lineEnd(text));
    place.usable = true;
    return place;
}

/// The last token of `PROC name(...)`, `FUNC num name(...)`, `TRAP name`, `MODULE name(...)`.
TokenIndex endOfHeader(const FileView& file, TokenIndex name) {
    if (name == kNoToken) return kNoToken;
    const auto kind = [&](TokenIndex t) { return file.tree->tokens[t].kind; };
    if (name + 1 >= tokenCountOf(file) || kind(name + 1) != TokenKind::LeftParen) return name;
    for (TokenIndex t = name + 2; t < tokenCountOf(file); ++t) {
        if (kind(t) == TokenKind::RightParen) return t;
        if (kind(t) == TokenKind::Semicolon) break;
    }
    return kNoToken;
}

} // namespace

InsertPlace moduleDataPlace(const FileView& file, const Module& module) {
    if (!module.decl) return {};
    const SyntaxTree& tree = *file.tree;
    const Decl* last = nullptr;
    for (const Decl* decl : module.decl->decls)
        if (decl->kind == NodeKind::Data && decl->first != kNoToken)
            last = decl;
        else if (decl->kind == NodeKind::Routine)
            break;
    if (!last)
        for (const Decl* decl : module.decl->decls)
            if (decl->kind == NodeKind::Record || decl->kind == NodeKind::Alias) last = decl;
    if (last) return placeAfter(file, last->last, indentAt(file.text(), tree.tokens[last->first].offset));
    const TokenIndex header = endOfHeader(file, module.decl->name);
    if (header == kNoToken) return {};
    std::string indent = indentUnit(file, module);
    if (!module.decl->decls.empty() && module.decl->decls.front()->first != kNoToken)
        indent = indentAt(file.text(), tree.tokens[module.decl->decls.front()->first].offset);
    return placeAfter(file, header, std::move(indent));
}

InsertPlace routineDataPlace(const FileView& file, const RoutineDecl& routine) {
    const SyntaxTree& tree = *file.tree;
    if (!routine.data.empty() && routine.data.back()->first != kNoToken)
        return placeAfter(file, routine.data.back()->last,
                          indentAt(file.text(), tree.tokens[routine.data.back()->first].offset));
    const TokenIndex header = endOfHeader(file, routine.name);
    if (header == kNoToken) return {};
    std::string indent = indentAt(file.text(), tree.tokens[routine.first].offset);
    if (!routine.body.empty() && routine.body.front()->first != kNoToken)
        indent = indentAt(file.text(), tree.tokens[routine.body.front()->first].offset);
    else
        indent += "   ";
    return placeAfter(file, header, std::move(indent));
}

InsertPlace afterRoutine(const FileView& file, const RoutineDecl& routine) {
    if (routine.first == kNoToken || routine.last < routine.first) return {};
    return placeAfter(file, routine.last, indentAt(file.text(), file.tree->tokens[routine.first].offset));
}

namespace {

std::string initialOf(const Type& type, int depth) {
    static constexpr std::pair<std::string_view, std::string_view> kKnown[] = {
        {"orient", "[1,0,0,0]"},
        {"extjoint", "[9E9,9E9,9E9,9E9,9E9,9E9]"},
        {"tooldata", "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]"},
        {"wobjdata", "[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]"},
        {"loaddata", "[0.001,[0,0,0.001],[1,0,0,0],0,0,0]"},
        {"speeddata", "[100,500,5000,1000]"},
        {"zonedata", "[FALSE,10,15,15,1.5,15,1.5]"}};
    switch (type.base()->kind) {
    case TypeKind::Num:
    case TypeKind::Dnum: return "0";
    case TypeKind::Bool: return "FALSE";
    case TypeKind::String: return "\"\"";
    case TypeKind::Record: break;
    default: return {};
    }
    if (depth > 30) return {};
    if (!type.base()->module || type.base()->module->predefined)
        for (const auto& [name, text] : kKnown)
            if (type.base()->name == name) return std::string(text);
    std::string text = "[";
    for (const Type::Component& component : type.base()->components) {
        const std::string part = component.type ? initialOf(*component.type, depth + 1) : "";
        if (part.empty()) return {};
        text += (text.size() > 1 ? "," : "") + part;
    }
    return text + "]";
}

} // namespace

std::string initialText(const DataType& type) {
    if (!type.type || type.isArray() || !isValueType(*type.type)) return {};
    return initialOf(*type.type, 0);
}

std::string freeName(const Scope& scope, std::string_view base, uint32_t first, uint32_t step) {
    const auto taken = [&](const std::string& name) {
        if (scope.find(name)) return true;
        // A name in another routine of the module may hide the new one; that is no clash.
        return keywordKind(name) != TokenKind::Identifier;
    };
    for (uint32_t i = 0; i < 10000; ++i) {
        std::string name = fmt::format("{}{}", base, first + i * step);
        if (!taken(name)) return name;
    }
    return std::string(base);
}

} // namespace rapid::query
