// Text forms of tokens and trees, for `rapidc emit` and the tests.

#include "frontend/syntax/lexer.h"
#include "frontend/syntax/parser.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <fmt/format.h>

namespace rapid::syntax {

namespace {

constexpr std::string_view kBinaryOps[] = {
    "+", "-", "*", "/", "DIV", "MOD", "<", "<=", "=", "<>", ">", ">=", "AND", "OR", "XOR"};

std::string_view unaryText(UnaryOp op) {
    switch (op) {
    case UnaryOp::Plus: return "+";
    case UnaryOp::Minus: return "-";
    case UnaryOp::Not: return "NOT";
    }
    return "";
}

std::string_view modeText(ParamMode mode) {
    switch (mode) {
    case ParamMode::In: return "";
    case ParamMode::Var: return " VAR";
    case ParamMode::Pers: return " PERS";
    case ParamMode::Inout: return " INOUT";
    case ParamMode::Ref: return " REF";
    }
    return "";
}

class TreePrinter {
  public:
    explicit TreePrinter(const SyntaxTree& tree) : tree_(tree) {}

    void print(const Node& node, std::string_view role = {}) {
        out_.append(2 * depth_, ' ');
        if (!role.empty()) out_ += fmt::format("{}: ", role);
        out_ += nodeKindName(node.kind);
        out_ += detail(node);
        out_ += '\n';
        ++depth_;
        printChildren(node);
        --depth_;
    }

    std::string take() { return std::move(out_); }

  private:
    std::string name(TokenIndex t) const { return t == kNoToken ? " ?" : fmt::format(" {}", tree_.text(t)); }

    template <class T> void section(std::string_view title, std::span<T*> nodes) {
        out_.append(2 * depth_, ' ');
        out_ += fmt::format("{}\n", title);
        ++depth_;
        for (const T* node : nodes)
            print(*node);
        --depth_;
    }

    /// Children that a word sets apart get a heading of their own; the others are simply listed.
    void printChildren(const Node& node) {
        switch (node.kind) {
        case NodeKind::If: {
            const auto& n = as<IfStmt>(node);
            for (const IfBranch* branch : n.branches)
                print(*branch);
            if (n.hasElse) section("Else", n.elseBody);
            return;
        }
        case NodeKind::Test: {
            const auto& n = as<TestStmt>(node);
            print(*n.subject);
            for (const TestCase* item : n.cases)
                print(*item);
            if (n.hasDefault) section("Default", n.defaultBody);
            return;
        }
        case NodeKind::For: {
            const auto& n = as<ForStmt>(node);
            print(*n.from, "from");
            print(*n.to, "to");
            if (n.step) print(*n.step, "step");
            for (const Stmt* stmt : n.body)
                print(*stmt);
            return;
        }
        case NodeKind::Data: {
            const auto& n = as<DataDecl>(node);
            for (const Expr* dim : n.dims)
                print(*dim, "dim");
            if (n.init) print(*n.init);
            return;
        }
        case NodeKind::Routine: return printRoutine(as<RoutineDecl>(node));
        default: return forEachChild(node, [this](const Node& child) { print(child); });
        }
    }

    void printRoutine(const RoutineDecl& n) {
        for (const ParamDecl* param : n.params)
            print(*param);
        for (const DataDecl* data : n.data)
            print(*data);
        if (!n.hasBody) return;
        section("Body", n.body);
        if (n.hasBackward) section("Backward", n.backward);
        for (const ErrorClause* clause : n.errors)
            print(*clause);
        if (n.hasUndo) section("Undo", n.undo);
    }

    std::string detail(const Node& node) const {
        switch (node.kind) {
        case NodeKind::NumLiteral: {
            const bool isInteger = numberValue(tree_.text(node.first)).isInteger;
            return fmt::format(" {}{}", as<NumLiteralExpr>(node).value, isInteger ? "" : " decimal");
        }
        case NodeKind::StringLiteral: return name(node.first);
        case NodeKind::BoolLiteral: return as<BoolLiteralExpr>(node).value ? " TRUE" : " FALSE";
        case NodeKind::PlaceholderExpr:
        case NodeKind::PlaceholderStmt:
        case NodeKind::PlaceholderDecl: return name(node.first);
        case NodeKind::Name: return name(as<NameExpr>(node).name);
        case NodeKind::Component: return name(as<ComponentExpr>(node).name);
        case NodeKind::Call: return name(as<CallExpr>(node).name);
        case NodeKind::Unary: return fmt::format(" {}", unaryText(as<UnaryExpr>(node).op));
        case NodeKind::Binary:
            return fmt::format(" {}", kBinaryOps[static_cast<size_t>(as<BinaryExpr>(node).op)]);
        case NodeKind::Argument: return argument(as<Argument>(node));
        case NodeKind::CallStmt: return as<CallStmt>(node).lateName ? " late" : name(as<CallStmt>(node).name);
        case NodeKind::For: return name(as<ForStmt>(node).variable);
        case NodeKind::Goto: return name(as<GotoStmt>(node).label);
        case NodeKind::Label: return name(as<LabelStmt>(node).name);
        case NodeKind::Connect: return fmt::format(" WITH{}", name(as<ConnectStmt>(node).trap));
        default: return declaration(node);
        }
    }

    std::string argument(const Argument& n) const {
        switch (n.argKind) {
        case ArgKind::Required: return n.name == kNoToken ? "" : name(n.name) + " :=";
        case ArgKind::Optional: return fmt::format(" \\{}{}", tree_.text(n.name), n.value ? " :=" : "");
        case ArgKind::Conditional: return fmt::format(" \\{} ?", tree_.text(n.name));
        case ArgKind::Placeholder: return " <ARG>";
        }
        return "";
    }

    std::string declaration(const Node& node) const {
        switch (node.kind) {
        case NodeKind::Module: {
            const auto& n = as<ModuleDecl>(node);
            std::string text = name(n.name);
            for (const TokenIndex t : n.attributeTokens)
                text += name(t);
            return text;
        }
        case NodeKind::Record: return local(as<RecordDecl>(node).local) + name(as<RecordDecl>(node).name);
        case NodeKind::RecordComponent:
            return name(as<RecordComponent>(node).type) + name(as<RecordComponent>(node).name);
        case NodeKind::Alias: {
            const auto& n = as<AliasDecl>(node);
            return local(n.local) + name(n.type) + name(n.name);
        }
        case NodeKind::Data: return data(as<DataDecl>(node));
        case NodeKind::Param: return param(as<ParamDecl>(node));
        case NodeKind::Routine: {
            const auto& n = as<RoutineDecl>(node);
            constexpr std::string_view kKinds[] = {" PROC", " FUNC", " TRAP"};
            return fmt::format("{}{}{}{}{}", local(n.local), kKinds[static_cast<size_t>(n.routineKind)],
                               n.routineKind == RoutineKind::Func ? name(n.returnType) : "", name(n.name),
                               n.hasBody ? "" : " native");
        }
        case NodeKind::ErrorClause: return as<ErrorClause>(node).hasList ? " listed" : "";
        default: return "";
        }
    }

    static std::string local(bool isLocal) { return isLocal ? " LOCAL" : ""; }

    std::string data(const DataDecl& n) const {
        constexpr std::string_view kScopes[] = {"", " LOCAL", " TASK"};
        constexpr std::string_view kKinds[] = {" VAR", " PERS", " CONST"};
        return fmt::format("{}{}{}{}", kScopes[static_cast<size_t>(n.scope)],
                           kKinds[static_cast<size_t>(n.dataKind)], name(n.type), name(n.name));
    }

    std::string param(const ParamDecl& n) const {
        if (n.placeholder) return fmt::format(" {}group {}", n.optional ? "optional " : "", n.group);
        std::string rank;
        if (n.rank == ParamDecl::kPlaceholderRank) {
            rank = " {<DIM>}";
        } else if (n.rank > 0) {
            rank = fmt::format(" rank {}", n.rank);
        }
        return fmt::format("{}{}{}{}{} group {}", n.optional ? " optional" : "", modeText(n.mode),
                           n.isSwitch ? " switch" : name(n.type), name(n.name), rank, n.group);
    }

    const SyntaxTree& tree_;
    std::string out_;
    size_t depth_ = 0;
};

} // namespace

std::string printTree(const SyntaxTree& tree) {
    TreePrinter printer(tree);
    for (const ModuleDecl* module : tree.modules)
        printer.print(*module);
    return printer.take();
}

namespace {
/// Later tokens were made afterwards (SyntaxTree::tokens).
bool isEnd(const SyntaxTree& tree, TokenIndex i) {
    return tree.tokens[i].kind == TokenKind::EndOfFile;
}
} // namespace

std::string printTokens(const SyntaxTree& tree) {
    std::string out;
    // Lines and columns are counted along: asking for each would take squared time in a very long line.
    const std::string_view source = tree.source->text();
    LineColumn at;
    uint32_t counted = 0;
    for (TokenIndex i = 0; i < tree.tokens.size(); ++i) {
        for (; counted < tree.tokens[i].offset; ++counted) {
            if (at.line < tree.source->lineCount() && counted + 1 == tree.source->lineStart(at.line + 1)) {
                at = {at.line + 1, 1};
            } else if ((static_cast<unsigned char>(source[counted]) & 0xC0) != 0x80) {
                ++at.column;
            }
        }
        const std::string_view text = tree.text(i);
        out += fmt::format("{}:{} {}{}{}\n", at.line, at.column, tokenKindName(tree.tokens[i].kind),
                           text.empty() ? "" : " ", text);
        if (isEnd(tree, i)) break;
    }
    return out;
}

std::string printSource(const SyntaxTree& tree) {
    std::string out;
    out.reserve(tree.source->text().size());
    for (TokenIndex i = 0; i < tree.tokens.size(); ++i) {
        out += gapBefore(tree, i);
        out += tree.text(i);
        if (isEnd(tree, i)) break;
    }
    return out;
}

} // namespace rapid::syntax
