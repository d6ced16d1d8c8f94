#pragma once
// Brackets and arguments from the beginning of a value to the offset: which frame is open there, and what it expects.

#include "frontend/query/cursor.h"

namespace rapid::query {

/// A value may end with it: a name, a literal, a closing bracket.
bool endsValue(syntax::TokenKind kind);

class ArgumentScan {
  public:
    /// Looks at the tokens from `from` to `at`, which is the word at the offset or what follows it.
    ArgumentScan(const Scope& scope, syntax::TokenIndex from, syntax::TokenIndex at);

    /// A value of the type.
    void run(const sema::DataType& type);
    /// The arguments of a procedure without parentheses; `callee` is kNoToken in a call by name.
    void runCall(syntax::TokenIndex callee);
    /// What is expected at the offset.
    void fill(Cursor& cursor) const;
    /// No bracket is open.
    bool outermost() const { return frames_.size() == 1; }

  private:
    enum class Kind : uint8_t { Value, Paren, Index, Aggregate, Call };
    struct Frame {
        Kind kind = Kind::Value;
        sema::DataType type;                        ///< Value, Paren: of the value; Aggregate: of the whole
        syntax::TokenIndex open = syntax::kNoToken; ///< the bracket
        syntax::TokenIndex valueStart = 0;
        uint32_t member = 0; ///< of an aggregate
        // Calls
        CallContext call;
        uint32_t required = 0;    ///< positional arguments before this one
        bool optional = false;    ///< the current argument is one
        bool conditional = false; ///< after `?`
    };

    void scan();
    void token(syntax::TokenIndex t);
    void open(syntax::TokenIndex t);
    void close(syntax::TokenIndex t);
    void separator(Frame& frame, syntax::TokenIndex t);
    void argumentName(Frame& frame, syntax::TokenIndex t);
    void endArgument(Frame& frame);
    void choosePositional(Frame& frame) const;
    void findLater(CallContext& call) const;
    bool beginsLine(syntax::TokenIndex t) const;
    void expectedOf(const Frame& frame, Cursor& cursor) const;
    sema::DataType memberType(const Frame& frame) const;
    sema::DataType valueType(const Frame& frame) const;
    sema::DataType operandType(const Frame& frame, syntax::TokenIndex end, bool& comparison) const;
    syntax::TokenKind kind(syntax::TokenIndex t) const;

    const Scope& scope_;
    const syntax::SyntaxTree& tree_;
    syntax::TokenIndex from_, at_;
    std::vector<Frame> frames_;
};

} // namespace rapid::query
