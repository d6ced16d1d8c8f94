#include "frontend/format/layout.h"

#include "frontend/format/spacing.h"

#include <algorithm>
#include <set>

namespace rapid::format {

using namespace rapid::syntax;
using K = TokenKind;

namespace {

/// An indentation: whole levels, which may be tabs, and columns beyond.
struct Indent {
    uint32_t levels = 0;
    uint32_t spaces = 0;
};

class Layout {
  public:
    Layout(const SyntaxTree& tree, const std::vector<Atom>& atoms, const std::vector<TokenPlan>& plan,
           const FormatSettings& settings)
        : tree_(tree), atoms_(atoms), plan_(plan), settings_(settings),
          continuation_(settings.continuation > 0 ? settings.continuation : 2 * settings.indent) {}

    std::vector<Gap> run() {
        gaps_.resize(atoms_.size());
        while (at_ < atoms_.size()) {
            if (atoms_[at_].isComment)
                placeComment();
            else if (!placeToken())
                continue; // the line is laid out again with one break more
            ++at_;
        }
        alignComments();
        return std::move(gaps_);
    }

  private:
    struct Bracket {
        uint32_t column = 0;  ///< of the bracket
        bool hanging = false; ///< nothing follows it on its line
        Indent line;          ///< of its line
    };
    struct State {
        std::vector<Bracket> brackets;
        Indent base; ///< of the instruction
        Indent line; ///< of the line
        uint32_t column = 0;
    };
    struct BreakPoint {
        size_t atom = 0;
        size_t depth = 0;
    };
    /// A comment after code, or one below that continues it.
    struct SideComment {
        size_t atom = 0;
        uint32_t line = 0;      ///< in the new text
        uint32_t codeEnd = 0;   ///< in the new text
        uint32_t oldColumn = 0; ///< in the old text
        uint32_t oldGap = 0;
        bool below = false;
    };

    const Atom& atom() const { return atoms_[at_]; }
    uint32_t columnsOf(Indent indent) const { return indent.levels * settings_.indent + indent.spaces; }
    /// An indentation of so many columns with the levels of the instruction.
    Indent atColumn(uint32_t column) const {
        const uint32_t base = columnsOf({state_.base.levels, 0});
        return column >= base ? Indent{state_.base.levels, column - base} : Indent{0, column};
    }

    uint32_t keptNewlines() const {
        if (at_ == 0) return 0;
        return std::clamp(atom().newlines, 1u, settings_.maxBlankLines + 1);
    }

    // ---- Lines ----

    void beginLine(uint32_t newlines, Indent indent) {
        gaps_[at_] = {newlines, indent.levels, indent.spaces};
        if (newlines > 0) ++line_;
        state_.line = indent;
        state_.column = columnsOf(indent);
        if (settings_.maxLineLength > 0) saved_ = state_;
        lineAtom_ = at_;
        breakPoints_.clear();
    }

    void put(const Atom& item) {
        const bool severalLines = item.endColumn < item.column; // a file header
        const std::string_view text = tree_.source->text().substr(item.begin, item.end - item.begin);
        state_.column = severalLines ? item.endColumn : state_.column + displayWidth(text);
    }

    bool closes(TokenIndex t) const {
        const K kind = tree_.tokens[t].kind;
        return kind == K::RightParen || kind == K::RightBracket || kind == K::RightBrace;
    }

    /// Indentation of the rest of an instruction.
    Indent continuation(bool closing) const {
        if (state_.brackets.empty()) return {state_.base.levels, state_.base.spaces + continuation_};
        const Bracket& bracket = state_.brackets.back();
        if (!bracket.hanging) return atColumn(bracket.column + (closing ? 0 : 1));
        return closing ? bracket.line : Indent{bracket.line.levels + 1, bracket.line.spaces};
    }

    // ---- Tokens ----

    bool placeToken() {
        const TokenIndex t = atom().token;
        const TokenPlan& plan = plan_[t];
        const bool afterComment = at_ > 0 && atoms_[at_ - 1].isComment;
        if (plan.has(kVerbatim)) return gaps_[at_].keep = true;
        const bool broken =
            plan.lineBreak == LineBreak::Must || afterComment ||
            (plan.lineBreak == LineBreak::Keep && (atom().newlines > 0 || forced_.contains(at_)));
        if (tree_.tokens[t].kind == K::EndOfFile) return placeEnd(), true;
        if (broken || at_ == 0)
            breakBefore(plan, t);
        else if (!placeOnLine(t))
            return false;
        put(atom());
        noteBracket(t);
        return true;
    }

    void breakBefore(const TokenPlan& plan, TokenIndex t) {
        const Indent indent = plan.hasLevel ? Indent{plan.level, 0} : continuation(closes(t));
        if (plan.hasLevel) {
            state_.brackets.clear();
            state_.base = indent;
        }
        beginLine(keptNewlines(), indent);
        if (!plan.hasLevel || plan.has(kCompactBody) || plan.has(kLabel)) return;
        lastLevel_ = plan.level;
        lastLineAtom_ = at_;
    }

    /// False when a break further left was chosen instead.
    bool placeOnLine(TokenIndex t) {
        const bool space = spaceBetween(tree_, plan_, settings_, t);
        gaps_[at_] = {0, 0, space ? 1u : 0u};
        if (settings_.maxLineLength > 0 && plan_[t].lineBreak == LineBreak::Keep && !plan_[t].hasLevel) {
            if (tree_.tokens[t - 1].kind == K::Comma) breakPoints_.push_back({at_, state_.brackets.size()});
            if (overflows(t, space) && chooseBreak()) return false;
        }
        state_.column += space ? 1 : 0;
        return true;
    }

    bool overflows(TokenIndex t, bool space) const {
        const Token& token = tree_.tokens[t];
        uint32_t width =
            (space ? 1 : 0) + displayWidth(tree_.source->text().substr(token.offset, token.length));
        // A token that follows without a space stays with it.
        for (TokenIndex next = t + 1; next < tree_.tokens.size(); ++next) {
            const K kind = tree_.tokens[next].kind;
            if (kind != K::Comma && kind != K::Semicolon && !closes(next)) break;
            ++width;
        }
        return state_.column + width > settings_.maxLineLength;
    }

    /// Breaks the line at the outermost, then last comma and goes back to its beginning.
    bool chooseBreak() {
        const BreakPoint* best = nullptr;
        for (const BreakPoint& point : breakPoints_)
            if (!best || point.depth <= best->depth) best = &point;
        if (!best) return false;
        forced_.insert(best->atom);
        const size_t begin = lineAtom_;
        state_ = saved_;
        breakPoints_.clear();
        at_ = begin;
        put(atom());
        noteBracket(atom().token);
        ++at_;
        return true;
    }

    void noteBracket(TokenIndex t) {
        const K kind = tree_.tokens[t].kind;
        if (kind == K::LeftParen || kind == K::LeftBracket || kind == K::LeftBrace) {
            const Atom& next = atoms_[at_ + 1];
            state_.brackets.push_back({state_.column - 1, next.newlines > 0 || next.isComment, state_.line});
        } else if (closes(t) && !state_.brackets.empty()) {
            state_.brackets.pop_back();
        }
    }

    void placeEnd() {
        const bool empty = at_ == 0;
        gaps_[at_] = {empty ? 0u : 1u, 0, 0};
    }

    // ---- Comments ----

    void placeComment() {
        const TokenPlan& next = plan_[atom().token];
        if (next.has(kVerbatim)) {
            gaps_[at_].keep = true;
            return;
        }
        if (atom().newlines == 0 && at_ > 0) {
            gaps_[at_] = {0, 0, 1};
            noteSideComment(state_.column, false);
            return;
        }
        const bool continues = continuesSideComment();
        beginLine(keptNewlines(), commentIndent(next));
        if (continues) noteSideComment(0, true);
    }

    Indent commentIndent(const TokenPlan& next) {
        if (settings_.keepCommentsInFirstColumn && atom().column == 0) return {};
        if (!next.hasLevel) return continuation(false);
        return {next.endsBlock && belongsToEnd() ? next.level : next.commentLevel, 0};
    }

    /// A comment before ELSE, CASE, ENDIF ...: is it aligned with the word that ends the block, while the block
    /// itself is moved in?
    bool belongsToEnd() {
        const TokenIndex t = atom().token;
        size_t word = std::max(at_, lastWord_); // several comments may precede one word
        while (atoms_[word].isComment)
            ++word;
        lastWord_ = word;
        if (atom().column > atoms_[word].column || lastLevel_ != plan_[t].commentLevel) return false;
        const Atom& inside = atoms_[lastLineAtom_];
        const bool beginsOldLine = inside.newlines > 0;
        return beginsOldLine && inside.column > atoms_[word].column;
    }

    /// A comment alone in its line, straight below one after code.
    bool continuesSideComment() const {
        return !sides_.empty() && sides_.back().atom + 1 == at_ && atom().newlines == 1 &&
               atom().column == sides_.back().oldColumn && atom().column > 0;
    }

    void noteSideComment(uint32_t codeEnd, bool below) {
        SideComment side{at_, line_, codeEnd, atom().column, 0, below};
        if (!below) side.oldGap = std::max(1u, atom().column - atoms_[at_ - 1].endColumn);
        sides_.push_back(side);
    }

    /// Comments after code that were in one column in neighbouring lines are aligned again.
    void alignComments() {
        for (size_t begin = 0; begin < sides_.size();) {
            size_t end = begin + 1;
            while (end < sides_.size() && sides_[end].line == sides_[end - 1].line + 1 &&
                   sides_[end].oldColumn == sides_[begin].oldColumn)
                ++end;
            if (end - begin > 1) alignGroup(begin, end);
            begin = end;
        }
    }

    void alignGroup(size_t begin, size_t end) {
        uint32_t width = 0, gap = UINT32_MAX;
        for (size_t i = begin; i < end; ++i) {
            if (sides_[i].below) continue;
            width = std::max(width, sides_[i].codeEnd);
            gap = std::min(gap, sides_[i].oldGap);
        }
        if (gap == UINT32_MAX) return;
        const uint32_t column = width + gap;
        for (size_t i = begin; i < end; ++i) {
            Gap& target = gaps_[sides_[i].atom];
            if (sides_[i].below) {
                const uint32_t levels = std::min(target.levels, column / settings_.indent);
                target.levels = levels;
                target.spaces = column - levels * settings_.indent;
            } else {
                target.spaces = column - sides_[i].codeEnd;
            }
        }
    }

    const SyntaxTree& tree_;
    const std::vector<Atom>& atoms_;
    const std::vector<TokenPlan>& plan_;
    const FormatSettings& settings_;
    uint32_t continuation_;
    std::vector<Gap> gaps_;
    std::vector<SideComment> sides_;
    State state_;
    State saved_;                         ///< at the beginning of the line, its first atom not yet put
    std::vector<BreakPoint> breakPoints_; ///< of the line
    std::set<size_t> forced_;             ///< atoms before which a long line is broken
    size_t at_ = 0;
    size_t lineAtom_ = 0;     ///< first atom of the line
    size_t lastLineAtom_ = 0; ///< first token of the line of code before
    size_t lastWord_ = 0;     ///< the token that ends a block, found for the comment before
    uint32_t lastLevel_ = 0;
    uint32_t line_ = 0;
};

} // namespace

std::vector<Gap> layOut(const SyntaxTree& tree, const std::vector<Atom>& atoms,
                        const std::vector<TokenPlan>& plan, const FormatSettings& settings) {
    return Layout(tree, atoms, plan, settings).run();
}

} // namespace rapid::format
