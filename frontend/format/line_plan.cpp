#include "frontend/format/line_plan.h"

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::format {

using namespace rapid::syntax;
using K = TokenKind;

namespace {

/// First walk: what only the tree knows.
class Marker {
  public:
    Marker(const SyntaxTree& tree, std::vector<TokenPlan>& plan) : tree_(tree), plan_(plan) {}

    void visit(const Node& node) {
        if (node.first > node.last) return;
        mark(node);
        forEachChild(node, [this](const Node& child) { visit(child); });
    }

  private:
    void set(TokenIndex token, uint16_t flag) {
        if (token < plan_.size()) plan_[token].flags |= flag;
    }
    /// Marks the first token of one of these kinds in a node.
    void setWord(const Node& node, TokenSet kinds, uint16_t flag) {
        for (TokenIndex t = node.first; t <= node.last; ++t)
            if (kinds.has(tree_.tokens[t].kind)) return set(t, flag);
    }
    void setName(TokenIndex name) {
        if (name != kNoToken && isKeyword(tree_.tokens[name].kind)) set(name, kNoKeyword);
    }

    void mark(const Node& node) {
        if (isDecl(node.kind) || node.kind == NodeKind::Module || node.kind == NodeKind::RecordComponent)
            set(node.first, kBeginsLine);
        if (isStmt(node.kind)) markStatement(node);
        switch (node.kind) {
        case NodeKind::Module:
        case NodeKind::If:
        case NodeKind::For:
        case NodeKind::While:
        case NodeKind::Test: return set(node.first, kOpensBlock);
        case NodeKind::Record: return setWord(node, {K::KwRecord}, kOpensBlock), markTypes(node);
        case NodeKind::Routine: return markRoutine(as<RoutineDecl>(node));
        case NodeKind::Call: return set(as<CallExpr>(node).name, kNameUse);
        case NodeKind::Name: return set(as<NameExpr>(node).name, kNameUse);
        case NodeKind::Unary:
            if (as<UnaryExpr>(node).op != UnaryOp::Not) set(node.first, kSign);
            return;
        case NodeKind::Argument: return markArgument(as<Argument>(node));
        case NodeKind::Param: return markParameter(as<ParamDecl>(node));
        default: return markTypes(node);
        }
    }

    void markStatement(const Node& node) {
        if (node.kind == NodeKind::Empty) return set(node.first, kEmptyStatement);
        set(node.first, kBeginsLine);
        if (node.kind == NodeKind::Label) set(node.first, kLabel);
        if (node.kind == NodeKind::CompactIf) {
            const auto* body = as<CompactIfStmt>(node).body;
            if (body) set(body->first, kCompactBody);
        }
        if (node.kind != NodeKind::CallStmt) return;
        const auto& call = as<CallStmt>(node);
        set(call.name, kCallName | kNameUse);
        if (!call.lateName) return;
        set(node.first, kLateOpen);
        if (call.lateName->first <= call.lateName->last) set(call.lateName->last + 1, kLateClose);
    }

    void markRoutine(const RoutineDecl& node) {
        set(node.returnType, kNameUse);
        if (node.hasBody) setWord(node, {K::KwProc, K::KwFunc, K::KwTrap}, kOpensBlock);
    }

    void markArgument(const Argument& node) {
        setName(node.name);
        if (node.name != kNoToken && node.value && node.argKind != ArgKind::Conditional)
            set(node.name + 1, kTightAssign);
    }

    void markParameter(const ParamDecl& node) {
        set(node.type, kNameUse);
        setName(node.name);
        if (node.isSwitch && node.name != kNoToken) set(node.name - 1, kLowerWord);
    }

    void markTypes(const Node& node) {
        switch (node.kind) {
        case NodeKind::Data: {
            const auto& data = as<DataDecl>(node);
            if (data.scope == ScopeWord::Task) set(node.first, kUpperWord);
            return set(data.type, kNameUse);
        }
        case NodeKind::Alias: return set(as<AliasDecl>(node).type, kNameUse);
        case NodeKind::RecordComponent: return set(as<RecordComponent>(node).type, kNameUse);
        default: return;
        }
    }

    const SyntaxTree& tree_;
    std::vector<TokenPlan>& plan_;
};

/// Second walk, over the tokens: blocks and levels.
class Leveller {
  public:
    Leveller(const SyntaxTree& tree, const FormatSettings& settings, std::vector<TokenPlan>& plan)
        : tree_(tree), settings_(settings), plan_(plan) {
        blocks_.push_back({});
    }

    void run() {
        for (TokenIndex t = 0; t < plan_.size(); ++t) {
            if (plan_[t].has(kVerbatim)) continue;
            place(t);
            noteBrackets(t);
        }
    }

    /// At the first token of a declaration of a module nothing else is open.
    void setDeclStarts(std::vector<bool> starts) { declStarts_ = std::move(starts); }

  private:
    struct Block {
        uint16_t level = 0;
        uint16_t middle = 0; ///< of ELSE, CASE, ERROR
        uint16_t body = 0;
    };

    static uint16_t deeper(uint16_t level, bool one) { return static_cast<uint16_t>(level + (one ? 1 : 0)); }

    void place(TokenIndex t) {
        TokenPlan& plan = plan_[t];
        const K kind = plan.has(kNoKeyword) ? K::Identifier : tree_.tokens[t].kind;
        if (t < declStarts_.size() && declStarts_[t] && blocks_.size() > 2) blocks_.resize(2);
        if (kind == K::EndOfFile) {
            blocks_.resize(1);
            return begin(plan, 0);
        }
        if (kind == K::FileHeader) return begin(plan, 0);
        if (kEnds.has(kind)) return close(plan);
        if (kMiddles.has(kind)) return middle(plan);
        if (plan.has(kCompactBody) && plan.has(kBeginsLine)) {
            plan.hasLevel = true;
            plan.level = plan.commentLevel = deeper(lineLevel_, true);
            if (startsLine(t)) lineLevel_ = plan.level;
        } else if (plan.has(kBeginsLine) || kAlone.has(kind)) {
            begin(plan, blocks_.back().body);
            if (plan.has(kLabel) && settings_.labels == LabelPlace::FirstColumn) plan.level = 0;
        } else if (kind == K::Semicolon) {
            plan.lineBreak = LineBreak::Never;
            plan.hasLevel = plan.has(kEmptyStatement) && !plan.has(kCompactBody);
            plan.level = plan.commentLevel = blocks_.back().body;
        }
        if (plan.has(kOpensBlock)) open(kind);
    }

    void begin(TokenPlan& plan, uint16_t level) {
        plan.lineBreak = LineBreak::Must;
        plan.hasLevel = true;
        plan.level = plan.commentLevel = level;
        lineLevel_ = level;
        brackets_.clear();
    }

    void open(K kind) {
        const uint16_t level = lineLevel_;
        Block block{level, level, deeper(level, true)};
        switch (kind) {
        case K::KwModule: block.body = deeper(level, settings_.indentModule); break;
        case K::KwProc:
        case K::KwFunc:
        case K::KwTrap: block.middle = deeper(level, settings_.indentHandlers); break;
        case K::KwTest: block.middle = block.body = deeper(level, settings_.indentCase); break;
        default: break;
        }
        blocks_.push_back(block);
    }

    void middle(TokenPlan& plan) {
        Block& block = blocks_.back();
        plan.endsBlock = true;
        const uint16_t inside = block.body;
        begin(plan, block.middle);
        plan.commentLevel = inside;
        block.body = deeper(block.middle, true);
    }

    void close(TokenPlan& plan) {
        plan.endsBlock = true;
        const uint16_t inside = blocks_.back().body;
        begin(plan, blocks_.back().level);
        plan.commentLevel = inside;
        if (blocks_.size() > 1) blocks_.pop_back();
    }

    bool startsLine(TokenIndex t) const {
        return gapBefore(tree_, t).find_first_of("\r\n") != std::string_view::npos;
    }

    void noteBrackets(TokenIndex t) {
        const K kind = tree_.tokens[t].kind;
        if (kind == K::LeftParen || kind == K::LeftBracket || kind == K::LeftBrace) brackets_.push_back(kind);
        if (kind == K::RightParen || kind == K::RightBracket || kind == K::RightBrace)
            if (!brackets_.empty()) brackets_.pop_back();
        if (kind == K::Comma && !brackets_.empty() && brackets_.back() != K::LeftParen)
            plan_[t].flags |= kListComma;
    }

    static constexpr TokenSet kEnds = {K::KwEndmodule, K::KwEndproc,  K::KwEndfunc, K::KwEndtrap,  K::KwEndif,
                                       K::KwEndfor,    K::KwEndwhile, K::KwEndtest, K::KwEndrecord};
    static constexpr TokenSet kMiddles = {K::KwElse,   K::KwElseif, K::PlaceEit, K::KwCase,    K::KwDefault,
                                          K::PlaceCse, K::KwError,  K::KwUndo,   K::KwBackward};
    /// Placeholders for whole lines that need not have a node.
    static constexpr TokenSet kAlone = {K::PlaceTdn, K::PlaceDdn, K::PlaceRdn};

    const SyntaxTree& tree_;
    const FormatSettings& settings_;
    std::vector<TokenPlan>& plan_;
    std::vector<Block> blocks_;
    std::vector<K> brackets_;
    std::vector<bool> declStarts_;
    uint16_t lineLevel_ = 0;
};

/// Marks the tokens of declarations that overlap `broken`, and stray semicolons after them.
void markBroken(const SyntaxTree& tree, const std::vector<SourceRange>& broken,
                std::vector<TokenPlan>& plan) {
    for (const ModuleDecl* module : tree.modules)
        for (const Decl* decl : module->decls) {
            if (decl->first > decl->last) continue;
            const SourceRange range = tree.range(*decl);
            const bool hit = std::any_of(broken.begin(), broken.end(), [&](SourceRange r) {
                return r.begin <= range.end && r.end >= range.begin;
            });
            if (!hit) continue;
            for (TokenIndex t = decl->first; t <= decl->last || tree.tokens[t].kind == TokenKind::Semicolon;
                 ++t)
                plan[t].flags |= kVerbatim;
        }
}

} // namespace

std::vector<TokenPlan> planLines(const SyntaxTree& tree, const FormatSettings& settings,
                                 const std::vector<SourceRange>& broken) {
    std::vector<TokenPlan> plan(tree.tokens.size());
    Marker marker(tree, plan);
    std::vector<bool> declStarts(broken.empty() ? 0 : plan.size());
    for (const ModuleDecl* module : tree.modules) {
        marker.visit(*module);
        if (broken.empty()) continue;
        for (const Decl* decl : module->decls)
            if (decl->first <= decl->last) declStarts[decl->first] = true;
    }
    if (!broken.empty()) markBroken(tree, broken, plan);
    Leveller leveller(tree, settings, plan);
    leveller.setDeclStarts(std::move(declStarts));
    leveller.run();
    return plan;
}

} // namespace rapid::format
