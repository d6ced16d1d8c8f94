// Places, texts and reports for all parts of a check.

#include "frontend/sema/part.h"

#include <algorithm>
#include <fmt/format.h>

#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/syntax/token_set.h"

namespace rapid::sema {

using namespace syntax;

diag::Diagnostic& Reports::report(Code code, SourceRange where, std::span<const std::string> args) {
    if (muted_ || isUnclear(where)) return unsaid_ = diag::Diagnostic();
    diag::Diagnostic& d = (collect_ ? *collect_ : sink_).report(code, context_.tree->source, where, args);
    d.cause = diag::CauseId{++lastCause_};
    d.line = unfinishedLine(code, where);
    return d;
}

/// For a report about the words of a line that lacks its semicolon: the cause of the report that says so.
diag::CauseId Reports::unfinishedLine(Code code, SourceRange where) const {
    const auto& lines = context_.tree->unfinishedLines;
    const auto line = std::lower_bound(lines.begin(), lines.end(), where.end,
                                       [](const auto& one, uint32_t end) { return one.end < end; });
    if (line == lines.end() || !isOfUnfinished(code, where, line->end)) return diag::CauseId::None;
    return diag::CauseId{line->cause};
}

/// An error in the words of a line that also lacks its semicolon, at `end`: a line that is being typed.
bool Reports::isOfUnfinished(Code code, SourceRange where, uint32_t end) const {
    constexpr Code kLastWord[] = {say::UnknownName.code, say::UnknownLabel.code, say::UnknownParameter.code,
                                  say::NotAProcedure.code};
    constexpr uint32_t kLongLine = 300;
    if (where.end == end)
        return std::find(std::begin(kLastWord), std::end(kLastWord), code) != std::end(kLastWord);
    if (code != say::UnknownProcedure.code || end - where.end > kLongLine) return false;
    const std::string_view between = context_.tree->source->text().substr(where.end, end - where.end);
    return between.find_first_of("\r\n") == std::string_view::npos;
}

void Reports::noteMisfit(const diag::Diagnostic& diagnostic, const Subject& subject) {
    if (diagnostic.cause != diag::CauseId::None)
        misfits_.push_back({subject.misfit, &subject.node, diagnostic.cause});
}

/// In a line that could not be read as a whole: what seems wrong there follows from that.
bool Reports::isUnclear(SourceRange where) const {
    if (const SourceRange quiet = quietLine(); where.begin < quiet.end && where.begin >= quiet.begin)
        return true;
    const std::vector<uint32_t>& lines = context_.tree->unclearLines;
    if (lines.empty()) return false;
    const auto after = std::upper_bound(lines.begin(), lines.end(), where.begin);
    if (after == lines.begin()) return false;
    const uint32_t begin = *(after - 1);
    if (where.begin - begin > SyntaxTree::kUnclearReach) return false;
    const std::string_view between = context_.tree->source->text().substr(begin, where.begin - begin);
    return between.find_first_of("\r\n") == std::string_view::npos;
}

bool Reports::hasUnclearLine(const Node& node) const {
    const std::vector<uint32_t>& lines = context_.tree->unclearLines;
    const SourceRange whole = context_.tree->range(node);
    const auto line = std::lower_bound(lines.begin(), lines.end(), whole.begin);
    return line != lines.end() && *line < whole.end;
}

std::string CheckerPart::text(const Node& node) const {
    const SourceRange r = range(node);
    constexpr uint32_t kLongest = 40;
    if (r.end - r.begin <= kLongest)
        return std::string(context_.tree->source->text().substr(r.begin, r.end - r.begin));
    const std::string_view all = context_.tree->source->text();
    uint32_t end = r.begin + kLongest - 3;
    while (end > r.begin && (static_cast<unsigned char>(all[end]) & 0xC0) == 0x80)
        --end; // not inside a character
    return std::string(all.substr(r.begin, end - r.begin)) + "...";
}

void CheckerPart::noteDeclared(diag::Diagnostic& diagnostic, const Symbol& symbol) {
    if (symbol.predefined || !symbol.decl || symbol.nameToken == kNoToken) return;
    const SyntaxTree& tree = *symbol.module->tree;
    diagnostic.notes.push_back(
        {tree.source, tree.range(symbol.nameToken), "'" + symbol.name + "' is declared here"});
}

std::string CheckerPart::valueText(const Expr& e) const {
    const ConstValue* value = info(e).constant;
    const Expr& inner = e.kind == NodeKind::Unary ? *as<UnaryExpr>(e).operand : e;
    if (inner.kind == NodeKind::NumLiteral || !value || value->kind != ConstValue::Kind::Number)
        return text(e);
    return fmt::format("{} = {}", text(e), value->number);
}

void CheckerPart::notePlaceholders(TokenIndex first, TokenIndex last) {
    for (TokenIndex t = first; t <= last; ++t)
        if (isPlaceholder(context_.tree->tokens[t].kind)) report(say::Placeholder, range(t), {text(t)});
}

} // namespace rapid::sema
