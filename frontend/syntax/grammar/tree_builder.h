#pragma once
// Makes the nodes of a tree.

#include "frontend/syntax/grammar/token_cursor.h"

#include <memory>
#include <vector>

namespace rapid::syntax {

/// Nodes begin at the current token and end before it when they are finished. Lists grow on stacks that all levels of the
/// recursion share; drain() moves what is on top into the arena.
class TreeBuilder {
  public:
    TreeBuilder(SyntaxTree& tree, const TokenCursor& in) : tree_(tree), in_(in) {}

    template <class T> T* make(NodeKind nodeKind) {
        T* node = tree_.arena.make<T>();
        node->kind = nodeKind;
        node->first = in_.pos();
        return node;
    }
    template <class T> T* makeExpr(NodeKind nodeKind) {
        T* node = make<T>(nodeKind);
        node->id = tree_.exprCount++;
        return node;
    }
    template <class T> T* finish(T* node) {
        node->last = in_.pos() ? in_.pos() - 1 : 0;
        return node;
    }
    /// Moves what was pushed since `mark` into the arena.
    template <class T> std::span<T> drain(std::vector<T>& stack, size_t mark) {
        const size_t count = stack.size() - mark;
        if (count == 0) return {};
        const std::span<T> pushed(stack.data() + mark, count);
        T* data = static_cast<T*>(tree_.arena.allocate(pushed.size_bytes(), alignof(T)));
        std::uninitialized_copy(pushed.begin(), pushed.end(), data);
        stack.resize(mark);
        return {data, count};
    }

    std::vector<Expr*> exprs;
    std::vector<Stmt*> stmts;
    std::vector<Decl*> decls;
    uint32_t depth = 0; ///< of the recursion

  private:
    SyntaxTree& tree_;
    const TokenCursor& in_;
};

/// Counts nesting; false when it is too deep.
class Nest {
  public:
    explicit Nest(TreeBuilder& nodes) : nodes_(nodes) { ++nodes_.depth; }
    ~Nest() { --nodes_.depth; }
    Nest(const Nest&) = delete;
    Nest& operator=(const Nest&) = delete;
    explicit operator bool() const { return nodes_.depth <= kMaxDepth; }

  private:
    TreeBuilder& nodes_;
};

/// Restores a variable at the end of a block.
template <class T> class Restore {
  public:
    explicit Restore(T& place) : place_(place), saved_(place) {}
    ~Restore() { place_ = saved_; }
    const T& saved() const { return saved_; }
    Restore(const Restore&) = delete;
    Restore& operator=(const Restore&) = delete;

  private:
    T& place_;
    T saved_;
};

} // namespace rapid::syntax
