#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

using Visit = std::function<void(const Node&)>;

void one(const Node* child, const Visit& visit) {
    if (child) visit(*child);
}

template <class T> void all(std::span<T*> children, const Visit& visit) {
    for (const T* child : children)
        visit(*child);
}

void visitRoutine(const RoutineDecl& n, const Visit& visit) {
    all(n.params, visit);
    // Semicolons between the declarations are instructions, and handlers may be in any order.
    std::vector<std::pair<TokenIndex, const Node*>> children;
    const auto add = [&](auto list) {
        for (const Node* child : list)
            children.emplace_back(child->first, child);
    };
    add(n.data);
    add(n.body);
    add(n.backward);
    add(n.errors);
    add(n.undo);
    std::sort(children.begin(), children.end());
    for (const auto& [first, child] : children)
        visit(*child);
}

void visitTest(const TestStmt& n, const Visit& visit) {
    one(n.subject, visit);
    all(n.cases, visit);
    all(n.defaultBody, visit);
}

constexpr std::string_view kNodeNames[] = {
#define NODE(name, group) #name,
#include "frontend/syntax/node_kinds.def"
};

enum class Group : uint8_t { Expr, Stmt, Decl, Part };
constexpr Group kGroups[] = {
#define NODE(name, group) Group::group,
#include "frontend/syntax/node_kinds.def"
};

} // namespace

// Size: one case for each kind of node.
void forEachChild(const Node& node, const Visit& visit) {
    switch (node.kind) {
    case NodeKind::NumLiteral:
    case NodeKind::StringLiteral:
    case NodeKind::BoolLiteral:
    case NodeKind::Name:
    case NodeKind::PlaceholderExpr:
    case NodeKind::ErrorExpr:
    case NodeKind::Goto:
    case NodeKind::Label:
    case NodeKind::Retry:
    case NodeKind::TryNext:
    case NodeKind::Exit:
    case NodeKind::Break:
    case NodeKind::Continue:
    case NodeKind::PlaceholderStmt:
    case NodeKind::Empty:
    case NodeKind::ErrorStmt:
    case NodeKind::Alias:
    case NodeKind::PlaceholderDecl:
    case NodeKind::ErrorDecl:
    case NodeKind::RecordComponent:
    case NodeKind::Param: return;
    case NodeKind::Index: {
        const auto& n = as<IndexExpr>(node);
        one(n.base, visit);
        return all(n.indices, visit);
    }
    case NodeKind::Component: return one(as<ComponentExpr>(node).base, visit);
    case NodeKind::Call: return all(as<CallExpr>(node).args, visit);
    case NodeKind::Aggregate: return all(as<AggregateExpr>(node).elements(), visit);
    case NodeKind::Paren: return one(as<ParenExpr>(node).inner, visit);
    case NodeKind::Unary: return one(as<UnaryExpr>(node).operand, visit);
    case NodeKind::Binary: {
        const auto& n = as<BinaryExpr>(node);
        one(n.left, visit);
        return one(n.right, visit);
    }
    case NodeKind::Assign: {
        const auto& n = as<AssignStmt>(node);
        one(n.target, visit);
        return one(n.value, visit);
    }
    case NodeKind::CallStmt: {
        const auto& n = as<CallStmt>(node);
        one(n.lateName, visit);
        return all(n.args, visit);
    }
    case NodeKind::If: {
        const auto& n = as<IfStmt>(node);
        all(n.branches, visit);
        return all(n.elseBody, visit);
    }
    case NodeKind::CompactIf: {
        const auto& n = as<CompactIfStmt>(node);
        one(n.condition, visit);
        return one(n.body, visit);
    }
    case NodeKind::For: {
        const auto& n = as<ForStmt>(node);
        one(n.from, visit);
        one(n.to, visit);
        one(n.step, visit);
        return all(n.body, visit);
    }
    case NodeKind::While: {
        const auto& n = as<WhileStmt>(node);
        one(n.condition, visit);
        return all(n.body, visit);
    }
    case NodeKind::Test: return visitTest(as<TestStmt>(node), visit);
    case NodeKind::Return: return one(as<ReturnStmt>(node).value, visit);
    case NodeKind::Raise: return one(as<RaiseStmt>(node).value, visit);
    case NodeKind::Connect: return one(as<ConnectStmt>(node).target, visit);
    case NodeKind::DeclStmt: return one(as<DeclStmt>(node).decl, visit);
    case NodeKind::Record: return all(as<RecordDecl>(node).components, visit);
    case NodeKind::Data: {
        const auto& n = as<DataDecl>(node);
        all(n.dims, visit);
        return one(n.init, visit);
    }
    case NodeKind::Routine: return visitRoutine(as<RoutineDecl>(node), visit);
    case NodeKind::Module: return all(as<ModuleDecl>(node).decls, visit);
    case NodeKind::ErrorClause: {
        const auto& n = as<ErrorClause>(node);
        all(n.numbers, visit);
        return all(n.body, visit);
    }
    case NodeKind::IfBranch: {
        const auto& n = as<IfBranch>(node);
        one(n.condition, visit);
        return all(n.body, visit);
    }
    case NodeKind::TestCase: {
        const auto& n = as<TestCase>(node);
        all(n.values, visit);
        return all(n.body, visit);
    }
    case NodeKind::Argument: return one(as<Argument>(node).value, visit);
    }
}

std::string_view nodeKindName(NodeKind kind) {
    return kNodeNames[static_cast<size_t>(kind)];
}
const Expr& bare(const Expr& e) {
    const Expr* inner = &e;
    while (inner->kind == NodeKind::Paren)
        inner = as<ParenExpr>(*inner).inner;
    return *inner;
}

bool isExpr(NodeKind kind) {
    return kGroups[static_cast<size_t>(kind)] == Group::Expr;
}
bool isStmt(NodeKind kind) {
    return kGroups[static_cast<size_t>(kind)] == Group::Stmt;
}
bool isDecl(NodeKind kind) {
    return kGroups[static_cast<size_t>(kind)] == Group::Decl;
}

std::string_view gapBefore(const SyntaxTree& tree, TokenIndex token) {
    const uint32_t begin = token == 0 ? 0 : tree.range(token - 1).end;
    return tree.source->text().substr(begin, tree.tokens[token].offset - begin);
}

TokenIndex typeTokenOf(const Node& declaration) {
    switch (declaration.kind) {
    case NodeKind::Data: return as<DataDecl>(declaration).type;
    case NodeKind::Param: return as<ParamDecl>(declaration).type;
    case NodeKind::Routine: return as<RoutineDecl>(declaration).returnType;
    default: return kNoToken;
    }
}

std::string_view leadingTrivia(const SyntaxTree& tree, const Node& node) {
    if (node.first == kNoToken) return {};
    const std::string_view gap = gapBefore(tree, node.first);
    if (node.first == 0) return gap;
    const size_t lineEnd = gap.find_first_of("\r\n");
    if (lineEnd == std::string_view::npos) return {};
    const bool crlf = gap[lineEnd] == '\r' && lineEnd + 1 < gap.size() && gap[lineEnd + 1] == '\n';
    return gap.substr(lineEnd + (crlf ? 2 : 1));
}

} // namespace rapid::syntax
