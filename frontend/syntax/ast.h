#pragma once
// The lossless syntax tree. Nodes are arena-allocated and point into the token vector; white space and comments are
// the gaps between tokens in the source text, so text == concatenation of gaps and tokens, byte for byte.

#include "frontend/source/arena.h"
#include "frontend/source/source_file.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::syntax {

/// Token kinds: see token_kinds.def (keywords, punctuation, literals, placeholders, Error, EndOfFile).
enum class TokenKind : uint8_t {
#define TOKEN(name, text) name,
#include "frontend/syntax/token_kinds.def"
};

/// Eight bytes, because files have millions of them.
struct Token {
    uint32_t offset = 0;
    uint32_t length : 24 = 0; ///< at most kMaxTokenLength
    TokenKind kind : 8 = TokenKind::EndOfFile;
};
static_assert(sizeof(Token) == 8);
/// Longer text (it is a mistake anyhow) is cut; the rest counts as white space.
inline constexpr size_t kMaxTokenLength = 0xFFFFFF;

using TokenIndex = uint32_t;
inline constexpr TokenIndex kNoToken = 0xFFFFFFFFu;

enum class PlainPiece : uint8_t; // plain_pieces.h

enum class NodeKind : uint8_t {
#define NODE(name, group) name,
#include "frontend/syntax/node_kinds.def"
};

/// Base of all nodes: kind and the tokens it covers, first to last inclusive (first > last: empty).
struct Node {
    TokenIndex first = kNoToken;
    TokenIndex last = 0;
    NodeKind kind;
    bool broken =
        false; ///< instructions and data: a part could not be read, so nothing is said about what it means
    // Derived nodes begin here with what is small: files have millions of nodes.
};

// ---- Expressions (manual 1.3.6) -------------------------------------------------------------------------------

/// `id` numbers the expressions of a tree densely from 0; later stages keep their facts in tables indexed by it.
struct Expr : Node {
    uint32_t id = 0;
};

struct NumLiteralExpr : Expr {
    double value = 0; ///< rounded to binary64
};
struct StringLiteralExpr : Expr {}; ///< decode with decodeStringLiteral()
struct BoolLiteralExpr : Expr {
    bool value = false;
};
struct NameExpr : Expr {
    TokenIndex name = kNoToken;
};
struct IndexExpr : Expr { ///< base{i,j,k}
    Expr* base = nullptr;
    std::span<Expr*> indices;
};
struct ComponentExpr : Expr { ///< base.name
    Expr* base = nullptr;
    TokenIndex name = kNoToken;
};

enum class ArgKind : uint8_t {
    Required,    ///< [name :=] value
    Optional,    ///< \name [:= value]
    Conditional, ///< \name ? value
    Placeholder  ///< <ARG>
};
struct Argument : Node {
    ArgKind argKind = ArgKind::Required;
    TokenIndex name = kNoToken; ///< kNoToken for a positional argument
    Expr* value = nullptr;      ///< null for a switch or a placeholder
};
static_assert(sizeof(void*) != 8 || sizeof(Argument) == 24);

struct CallExpr : Expr { ///< function call
    TokenIndex name = kNoToken;
    std::span<Argument*> args;
};
struct SyntaxTree;

/// `[a,b]`. Modules full of taught points consist of initial values such as `[[1,-2.5],TRUE,"a"]`: nothing but literals.
/// The elements of such a plain aggregate are made from its text when somebody asks for them; hardly anybody does.
class AggregateExpr : public Expr {
  public:
    std::span<Expr*> elements() const {
        if (!made_) makeElements();
        return {elements_, count_};
    }
    void setElements(std::span<Expr*> elements) {
        elements_ = elements.data();
        count_ = static_cast<uint32_t>(elements.size());
        made_ = true;
    }
    /// Nothing but PlainPieces from `first` to `last`, in order.
    bool isPlain() const { return plain_; }
    /// `shape`: see shape().
    void setPlain(SyntaxTree& tree, uint8_t shape) {
        tree_ = &tree;
        plain_ = true;
        made_ = false;
        shape_ = shape;
    }
    /// Place in SyntaxTree::shapes of what it consists of; kNoShape when it is not noted.
    uint8_t shape() const { return shape_; }
    static constexpr uint8_t kNoShape = 0xFF;

  private:
    void makeElements() const; // plain_aggregate.cpp

    union {
        Expr** elements_ = nullptr;
        SyntaxTree* tree_; ///< while they are not made
    };
    uint32_t count_ = 0;
    bool plain_ = false;
    bool made_ = true;
    uint8_t shape_ = kNoShape;
};
struct ParenExpr : Expr {
    Expr* inner = nullptr;
};
enum class UnaryOp : uint8_t { Plus, Minus, Not };
struct UnaryExpr : Expr {
    UnaryOp op = UnaryOp::Plus;
    Expr* operand = nullptr;
};
enum class BinaryOp : uint8_t { Add, Sub, Mul, Div, IntDiv, Mod, Lt, Le, Eq, Ne, Gt, Ge, And, Or, Xor };
struct BinaryExpr : Expr {
    BinaryOp op = BinaryOp::Add;
    TokenIndex opToken = kNoToken;
    Expr* left = nullptr;
    Expr* right = nullptr;
};
struct PlaceholderExpr : Expr {}; ///< <EXP>, <VAR>, <ID>
struct ErrorExpr : Expr {};       ///< already reported

// ---- Statements (manual 1.4, 1.5, 1.12) ------------------------------------------------------------------------

struct Stmt : Node {};
using StmtList = std::span<Stmt*>;

struct AssignStmt : Stmt {
    Expr* target = nullptr;
    Expr* value = nullptr;
};
struct CallStmt : Stmt {        ///< procedure call, early or late bound
    TokenIndex name = kNoToken; ///< early binding
    Expr* lateName = nullptr;   ///< %expression%
    std::span<Argument*> args;
};
struct IfBranch : Node {
    Expr* condition = nullptr; ///< null for an <EIT> placeholder
    StmtList body;
};
struct IfStmt : Stmt {
    std::span<IfBranch*> branches; ///< IF and each ELSEIF
    bool hasElse = false;
    StmtList elseBody;
};
struct CompactIfStmt : Stmt {
    Expr* condition = nullptr;
    Stmt* body = nullptr;
};
struct ForStmt : Stmt {
    TokenIndex variable = kNoToken;
    Expr* from = nullptr;
    Expr* to = nullptr;
    Expr* step = nullptr; ///< null when STEP is absent
    StmtList body;
};
struct WhileStmt : Stmt {
    Expr* condition = nullptr;
    StmtList body;
};
struct TestCase : Node {
    std::span<Expr*> values; ///< empty for a <CSE> placeholder
    StmtList body;
};
struct TestStmt : Stmt {
    Expr* subject = nullptr;
    std::span<TestCase*> cases;
    bool hasDefault = false;
    StmtList defaultBody;
};
struct GotoStmt : Stmt {
    TokenIndex label = kNoToken;
};
struct LabelStmt : Stmt {
    TokenIndex name = kNoToken;
};
struct ReturnStmt : Stmt {
    Expr* value = nullptr;
};
struct RaiseStmt : Stmt {
    Expr* value = nullptr;
};
struct ConnectStmt : Stmt {
    Expr* target = nullptr;
    TokenIndex trap = kNoToken;
};
/// Keyword statements without operands: RETRY TRYNEXT EXIT BREAK CONTINUE, and <SMT>, empty `;`, reported errors.
struct SimpleStmt : Stmt {};

struct DataDecl;
/// A data declaration after the first instruction of a routine: not allowed, reported by the parser, kept so that
/// the name is known to later stages.
struct DeclStmt : Stmt {
    DataDecl* decl = nullptr;
};

// ---- Declarations (manual 1.1.3, 1.1.5, 1.2) -------------------------------------------------------------------

struct Decl : Node {};

struct RecordComponent : Node {
    TokenIndex type = kNoToken;
    TokenIndex name = kNoToken;
};
struct RecordDecl : Decl {
    bool local = false;
    TokenIndex name = kNoToken;
    std::span<RecordComponent*> components;
};
struct AliasDecl : Decl {
    bool local = false;
    TokenIndex type = kNoToken;
    TokenIndex name = kNoToken;
};
enum class DataKind : uint8_t { Var, Pers, Const };
enum class ScopeWord : uint8_t { None, Local, Task };
struct DataDecl : Decl {
    ScopeWord scope = ScopeWord::None;
    DataKind dataKind = DataKind::Var;
    TokenIndex type = kNoToken;
    TokenIndex name = kNoToken;
    std::span<Expr*> dims;
    Expr* init = nullptr; ///< null when there is no initial value
};
enum class ParamMode : uint8_t { In, Var, Pers, Inout, Ref }; ///< Ref only in the declarations of built-ins
struct ParamDecl : Node {
    ParamMode mode = ParamMode::In;
    bool isSwitch = false;
    bool optional = false;
    bool placeholder = false;   ///< <PAR> or <ALT>
    uint32_t group = 0;         ///< parameters joined by '|' share a number; numbers ascend
    TokenIndex type = kNoToken; ///< kNoToken for switch
    TokenIndex name = kNoToken;
    static constexpr uint8_t kPlaceholderRank = 255; ///< <DIM>
    uint8_t rank = 0;                                ///< number of '*'; 0 = no array
};
enum class RoutineKind : uint8_t { Proc, Func, Trap };
struct ErrorClause : Node {
    bool hasList = false; ///< ERROR (a, b)
    std::span<Expr*> numbers;
    StmtList body;
};
struct RoutineDecl : Decl {
    RoutineKind routineKind = RoutineKind::Proc;
    bool local = false;
    bool hasBody = true; ///< false only in the declarations of built-ins
    bool closed = true;  ///< an end word is there; without one, more instructions may be meant to follow
    TokenIndex returnType = kNoToken; ///< functions
    TokenIndex name = kNoToken;
    std::span<ParamDecl*> params;
    std::span<DataDecl*> data;
    StmtList body;
    bool hasBackward = false;
    StmtList backward;
    std::span<ErrorClause*> errors;
    bool hasUndo = false;
    StmtList undo;
};
struct PlaceholderDecl : Decl {}; ///< <TDN>, <DDN>, <RDN>

enum ModuleAttribute : uint8_t {
    kAttrSysmodule = 1,
    kAttrNoview = 2,
    kAttrNostepin = 4,
    kAttrViewonly = 8,
    kAttrReadonly = 16
};
struct ModuleDecl : Node {
    TokenIndex name = kNoToken;
    std::span<TokenIndex> attributeTokens; ///< as written
    uint8_t attributes = 0;
    std::span<Decl*> decls; ///< in source order, any kind
};

// ---- The tree --------------------------------------------------------------------------------------------------

/// One parsed file: source, tokens, nodes. Some files hold several modules.
struct SyntaxTree {
    std::shared_ptr<const SourceFile> source;
    /// In the arena; the last one is EndOfFile. Those of a PlainAggregate, once its elements are made, are after it,
    /// with an EndOfFile of their own.
    std::span<Token> tokens;
    size_t tokenRoom = 0; ///< for how many there is room in their place; 0 means no more than there are
    Arena arena;
    /// Different ones of the aggregates that are one token: taught points have two or three, thousands of times.
    std::vector<std::vector<PlainPiece>> shapes;
    std::vector<ModuleDecl*> modules;
    uint32_t exprCount = 0; ///< it grows when elements of plain aggregates are made
    /// Beginnings of lines in which something could not be read, which is reported; in order. Errors of names and
    /// types there follows from that.
    std::vector<uint32_t> unclearLines;
    /// Bytes of a line that count as one in unclearLines: the mistakes of a file in one line have nothing to do with each
    /// other.
    static constexpr uint32_t kUnclearReach = 500;
    /// Lines that lack their semicolon, in order. A report of the checker about its last word or its callee names the cause of
    /// the one that says so: both are one mistake.
    struct UnfinishedLine {
        uint32_t end;
        uint32_t cause; ///< diag::CauseId of the report
    };
    std::vector<UnfinishedLine> unfinishedLines;
    bool retagged =
        false; ///< some tokens are not what the text alone says, or the text cannot be read: mistakes

    std::string_view text(TokenIndex t) const {
        return t == kNoToken ? std::string_view() : source->text().substr(tokens[t].offset, tokens[t].length);
    }
    SourceRange range(TokenIndex t) const { return {tokens[t].offset, tokens[t].offset + tokens[t].length}; }
    SourceRange range(const Node& n) const {
        if (n.first == kNoToken || n.first > n.last) return {};
        return {tokens[n.first].offset, tokens[n.last].offset + tokens[n.last].length};
    }
};

/// The value of a string literal token: quotes removed, "" and \\ and \hh decoded (manual 1.1.2). `\hh` yields the
/// raw byte. More than 80 bytes is the caller's to report.
std::string decodeStringLiteral(std::string_view literal);

template <class T> const T& as(const Node& n) {
    return static_cast<const T&>(n);
}
template <class T> T& as(Node& n) {
    return static_cast<T&>(n);
}

} // namespace rapid::syntax
