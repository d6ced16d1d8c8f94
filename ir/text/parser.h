#pragma once
// The two halves of the parser: ModuleParser reads the items, RoutineParser the bodies.

#include <map>
#include <string>
#include <vector>

#include "ir/core/ir.h"
#include "ir/text/lexer.h"

namespace ir::text {

/// Tokens with one of lookahead and the first error. Every reading function returns false after an error.
class TokenStream {
  public:
    explicit TokenStream(std::string_view source) : lexer_(source) { advance(); }

    const Token& peek() const { return token_; }
    void advance() { token_ = lexer_.next(); }
    bool fail(const std::string& message) { return failAt(token_, message); }
    bool failAt(const Token& where, const std::string& message);
    /// Says what was expected at the current token.
    bool expected(std::string_view what);
    const std::string& error() const { return error_; }

    bool isWord(std::string_view word) const { return token_.kind == TokenKind::Word && token_.text == word; }
    bool isPunct(char c) const { return token_.kind == TokenKind::Punct && token_.text[0] == c; }
    bool takeWord(std::string_view word);
    bool takePunct(char c);

    bool punct(char c);
    bool word(std::string_view word);
    bool endOfLine();
    void skipNewLines();
    bool string(std::string& out);
    bool name(std::string& out);
    bool number(double& out);
    /// A value of the scalar type: integers of all bits, signed or unsigned.
    bool constant(TypeId type, double& number, int64_t& integer);
    bool integer(int64_t& out, int64_t min, int64_t max);
    bool unsignedInt(uint32_t& out);
    bool signedInt(int32_t& out);
    bool block(BlockId& out);
    /// One of the words of a table; `out` = its position.
    template <size_t N> bool oneOf(const std::string_view (&table)[N], std::string_view what, size_t& out) {
        for (size_t i = 0; i < N; ++i) {
            if (isWord(table[i])) {
                out = i;
                advance();
                return true;
            }
        }
        return expected(what);
    }
    bool type(const Module& module, TypeId& out);

  private:
    Lexer lexer_;
    Token token_;
    std::string error_;
};

/// A reference by name that is resolved when everything has been read.
struct Fixup {
    enum class Kind : uint8_t { Global, Native, Routine } kind;
    std::string name;
    Token where;
    uint32_t routine = kNone; ///< instruction `inst` of this routine ...
    uint32_t inst = kNone;    ///< ... or, when kNone, entry `slot` of the tables
    enum class Slot : uint8_t {
        External,
        Alias,
        ModuleGone,
        TaskEntry,
        TaskReset,
        ErrorFilter,
        DetachedHandler,
        Named
    } slot = Slot::External;
    uint32_t index = 0;
};

class RoutineParser {
  public:
    RoutineParser(TokenStream& in, Module& module, uint32_t routine, std::vector<Fixup>& fixups)
        : in_(in), module_(module), index_(routine), routine_(module.routines[routine]), fixups_(fixups) {}
    /// From after the opening brace to the closing one.
    bool parse();

  private:
    bool item();
    bool local();
    bool statement();
    bool handler();
    bool detachedHandler();
    bool blockHeader();
    bool instruction();
    bool body(Inst& inst);
    bool constant(Inst& inst);
    bool sysvar(Inst& inst);
    bool call(Inst& inst, Fixup::Kind kind);
    bool switchOn(Inst& inst);
    bool value(Inst& inst);
    bool values(Inst& inst);
    bool reference(Fixup::Kind kind);
    bool resolveValues();
    void inferTypes();

    TokenStream& in_;
    Module& module_;
    uint32_t index_;
    Routine& routine_;
    std::vector<Fixup>& fixups_;
    struct Use {
        uint32_t inst;
        size_t operand;
        Token where;
    };
    std::map<std::string, ValueId> values_;
    std::vector<Use> uses_;
    StmtId stmt_ = kNone;
};

} // namespace ir::text
