#include "frontend/format/formatter.h"

#include "config/letter_case.h"
#include "frontend/edit/apply_edits.h"
#include "frontend/format/canonical_names.h"
#include "frontend/format/layout.h"
#include "frontend/format/same_meaning.h"
#include "frontend/syntax/parser.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_set>

namespace rapid::format {

using namespace rapid::syntax;

namespace {

constexpr uint32_t kTabWidth = 4; // of tabs in a text that is to be indented with spaces

/// The ends of lines in a piece of white space, as written.
std::vector<std::string_view> lineEnds(std::string_view space) {
    std::vector<std::string_view> ends;
    for (size_t i = 0; i < space.size(); ++i) {
        if (space[i] != '\n' && space[i] != '\r') continue;
        const bool crlf = space[i] == '\r' && i + 1 < space.size() && space[i + 1] == '\n';
        ends.push_back(space.substr(i, crlf ? 2 : 1));
        i += crlf ? 1 : 0;
    }
    return ends;
}

/// Every name that the file declares, lower case: such a name is not the predefined one.
class DeclaredNames {
  public:
    explicit DeclaredNames(const SyntaxTree& tree) : tree_(tree) {
        for (const ModuleDecl* module : tree.modules)
            visit(*module);
    }
    bool has(const std::string& name) const { return names_.contains(name); }

  private:
    void add(TokenIndex name) { names_.insert(config::lowerCase(tree_.text(name))); }
    void visit(const Node& node) {
        switch (node.kind) {
        case NodeKind::Record: add(as<RecordDecl>(node).name); break;
        case NodeKind::Alias: add(as<AliasDecl>(node).name); break;
        case NodeKind::Data: add(as<DataDecl>(node).name); break;
        case NodeKind::Routine: add(as<RoutineDecl>(node).name); break;
        case NodeKind::Param: add(as<ParamDecl>(node).name); break;
        case NodeKind::For: add(as<ForStmt>(node).variable); break;
        default: break;
        }
        forEachChild(node, [this](const Node& child) { visit(child); });
    }
    const SyntaxTree& tree_;
    std::unordered_set<std::string> names_;
};

class Formatter {
  public:
    Formatter(const SyntaxTree& tree, const std::vector<SourceRange>& errors, const FormatRequest& request)
        : tree_(tree), text_(tree.source->text()), request_(request), settings_(request.settings),
          plan_(planLines(tree, settings_, errors)),
          atoms_(collectAtoms(tree, settings_.tabs ? settings_.indent : kTabWidth)),
          lineEnd_(edit::lineEnd(text_)) {}

    std::vector<TextEdit> run() {
        const std::vector<Gap> gaps = layOut(tree_, atoms_, plan_, settings_);
        uint32_t line = 1, end = 0;
        for (size_t i = 0; i < atoms_.size(); ++i) {
            const Atom& atom = atoms_[i];
            const uint32_t newLine = line + atom.newlines;
            if (!gaps[i].keep) editGap({end, atom.begin}, gaps[i], line, newLine);
            line = newLine;
            if (!atom.isComment && inRange(line)) editWord(atom.token);
            if (!atom.isComment && tree_.tokens[atom.token].kind == TokenKind::FileHeader)
                line +=
                    static_cast<uint32_t>(lineEnds(text_.substr(atom.begin, atom.end - atom.begin)).size());
            end = atom.end;
        }
        return std::move(edits_);
    }

  private:
    bool inRange(uint32_t line) const { return line >= request_.firstLine && line <= request_.lastLine; }

    /// Adds an edit for the part of `range` that differs.
    void replace(SourceRange range, std::string text) {
        const std::string_view old = text_.substr(range.begin, range.end - range.begin);
        const size_t shorter = std::min(old.size(), text.size());
        size_t head = 0, tail = 0;
        while (head < shorter && old[head] == text[head])
            ++head;
        while (tail < shorter - head && old[old.size() - 1 - tail] == text[text.size() - 1 - tail])
            ++tail;
        if (head + tail == old.size() && old.size() == text.size()) return;
        edits_.push_back(
            {{range.begin + static_cast<uint32_t>(head), range.end - static_cast<uint32_t>(tail)},
             text.substr(head, text.size() - head - tail)});
    }

    std::string indentation(const Gap& gap) const {
        if (settings_.tabs) return std::string(gap.levels, '\t') + std::string(gap.spaces, ' ');
        return std::string(size_t{gap.levels} * settings_.indent + gap.spaces, ' ');
    }

    /// White space from line `from` to line `to` of the old text.
    void editGap(SourceRange range, const Gap& gap, uint32_t from, uint32_t to) {
        const std::string_view old = text_.substr(range.begin, range.end - range.begin);
        const auto oldEnds = lineEnds(old);
        if (inRange(from) && inRange(to)) {
            std::string text;
            for (size_t i = 0; i < gap.newlines; ++i)
                text += i < oldEnds.size() ? oldEnds[i] : lineEnd_;
            return replace(range, text + indentation(gap));
        }
        if (oldEnds.empty() || gap.newlines == 0) return; // lines outside of the range would change
        if (inRange(to)) {
            const auto begin = static_cast<uint32_t>(old.find_last_of("\r\n") + 1);
            replace({range.begin + begin, range.end}, indentation(gap));
        } else if (inRange(from)) {
            const auto length = static_cast<uint32_t>(old.find_first_of("\r\n"));
            replace({range.begin, range.begin + length}, "");
        }
    }

    /// The case of keywords and, if wanted, of predefined names.
    void editWord(TokenIndex t) {
        const TokenPlan& plan = plan_[t];
        if (plan.has(kVerbatim)) return;
        const TokenKind kind = tree_.tokens[t].kind;
        const bool keyword = (isKeyword(kind) || isPlaceholder(kind)) && !plan.has(kNoKeyword) &&
                             equalsNoCase(tree_.text(t), tokenText(kind)); // misspelt ones stay
        if (keyword || plan.has(kUpperWord)) {
            const std::string word = keyword ? std::string(tokenText(kind)) : "TASK";
            if (settings_.keywords == KeywordCase::Upper) replace(tree_.range(t), word);
            if (settings_.keywords == KeywordCase::Lower) replace(tree_.range(t), config::lowerCase(word));
        } else if (plan.has(kLowerWord)) {
            if (settings_.keywords != KeywordCase::Keep) replace(tree_.range(t), "switch");
        } else if (plan.has(kNameUse) && kind == TokenKind::Identifier) {
            editName(t);
        }
    }

    void editName(TokenIndex t) {
        if (settings_.names != NameCase::Canonical || !request_.names) return;
        const std::string folded = config::lowerCase(tree_.text(t));
        const auto found = request_.names->find(folded);
        if (found == request_.names->end()) return;
        if (!declared_) declared_ = std::make_unique<DeclaredNames>(tree_);
        if (!declared_->has(folded)) replace(tree_.range(t), found->second);
    }

    const SyntaxTree& tree_;
    std::string_view text_;
    const FormatRequest& request_;
    const FormatSettings& settings_;
    std::vector<TokenPlan> plan_;
    std::vector<Atom> atoms_;
    std::string_view lineEnd_;
    std::unique_ptr<DeclaredNames> declared_;
    std::vector<TextEdit> edits_;
};

/// Why this tree cannot be formatted; empty when it can.
std::string refusal(const SyntaxTree& tree, const std::vector<SourceRange>& errors, bool keepErrors) {
    if (tree.source->isBinary()) return "the file is encrypted or binary";
    if (errors.empty()) return {};
    if (!keepErrors) return "the file has mistakes";
    for (const SourceRange& error : errors) {
        const bool atEnd = error.begin >= tree.source->text().size(); // ENDMODULE lacks
        const bool inside =
            std::any_of(tree.modules.begin(), tree.modules.end(), [&](const ModuleDecl* module) {
                return std::any_of(module->decls.begin(), module->decls.end(), [&](const Decl* decl) {
                    if (decl->first > decl->last) return false;
                    const SourceRange range = tree.range(*decl);
                    return atEnd || (error.begin <= range.end && error.end >= range.begin);
                });
            });
        if (!inside) return "there is a mistake outside of the declarations";
    }
    return {};
}

constexpr uint32_t kFirstReach = 16; // bytes

/// The place where the text would mean something else after the edits, or could not be changed so; no value: none.
std::optional<SourceRange> changeOfMeaning(const SyntaxTree& tree, const std::vector<TextEdit>& edits,
                                           const FormatRequest& request, bool nodes) {
    const auto changed = edit::applyEditsToText(tree.source->text(), edits);
    if (!changed.ok()) return edits.front().range;
    diag::Sink ignored; // mistakes that are kept
    ParseOptions options;
    options.declarations = request.declarations;
    const bool old = SourceFile::isLegacyFileType(tree.source->path()); // words mean other things there
    const auto again = parse(std::make_shared<const SourceFile>(old ? "new.mod" : "new.modx", changed.bytes),
                             ignored, options);
    return findDifference(tree, *again, nodes);
}

} // namespace

std::vector<SourceRange> errorRanges(const diag::Sink& sink) {
    std::vector<SourceRange> ranges;
    for (const diag::Diagnostic& diagnostic : sink.all())
        if (diagnostic.severity == diag::Severity::Error) ranges.push_back(diagnostic.range);
    return ranges;
}

FormatResult format(const SyntaxTree& tree, const std::vector<SourceRange>& errors,
                    const FormatRequest& request) {
    FormatResult result;
    result.problem = refusal(tree, errors, request.keepErrors);
    if (!result.ok()) return result;
    if (tree.tokens.size() == 1 && tree.modules.empty()) return result; // nothing but comments
    // A mistake, or an instruction that continues outside of the range, may be read in a different way when something near
    // it moves. Then that part is left as it is too.
    const bool partly = !errors.empty() || request.firstLine > 1 || request.lastLine != UINT32_MAX;
    std::vector<SourceRange> untouched = errors;
    for (uint32_t reach = 0;; reach = std::max(kFirstReach, 4 * reach)) {
        result.edits = Formatter(tree, untouched, request).run();
        if (result.edits.empty()) return result;
        const auto change = changeOfMeaning(tree, result.edits, request, errors.empty());
        if (!change) return result;
        const auto size = static_cast<uint32_t>(tree.source->text().size());
        if (!partly || reach / 4 > size) {
            const uint32_t line = tree.source->lineColumn(change->begin).line;
            return {{},
                    fmt::format("formatting is refused, since line {} would change; please report this file",
                                line)};
        }
        untouched.push_back({change->begin - std::min(change->begin, reach),
                             change->end + std::min(size - change->end, reach)});
    }
}

} // namespace rapid::format
