#pragma once
// The short words that all parts of a check use: text and place of a node, its facts, reports.

#include "frontend/sema/parts.h"
#include "frontend/sema/state.h"
#include "frontend/sema/typed.h"

namespace rapid::sema {

class CheckerPart {
  protected:
    explicit CheckerPart(State& state) : state_(state) {}

    SourceRange range(const syntax::Node& node) const { return state_.context.tree->range(node); }
    SourceRange range(syntax::TokenIndex token) const {
        return token == syntax::kNoToken ? SourceRange{} : state_.context.tree->range(token);
    }
    /// False for what is missing after a syntax error and for the placeholder <ID>.
    bool isName(syntax::TokenIndex token) const {
        return token != syntax::kNoToken &&
               state_.context.tree->tokens[token].kind == syntax::TokenKind::Identifier;
    }
    NameId idOf(syntax::TokenIndex token) const {
        return state_.names.intern(state_.context.tree->text(token));
    }
    /// As written; of a long node the beginning.
    std::string text(const syntax::Node& node) const;
    std::string text(syntax::TokenIndex token) const { return std::string(state_.context.tree->text(token)); }
    /// As written, and its value where that does not show: "n+1 = 4".
    std::string valueText(const syntax::Expr& e) const;
    ExprInfo& info(const syntax::Expr& e) const { return state_.context.exprs->at(e.id); }
    FileFacts& facts() const { return *state_.context.module->facts; }
    bool hasErrorHandler() const {
        return state_.context.routine && !state_.context.routine->routineDecl->errors.empty();
    }

    diag::Diagnostic& report(Code code, SourceRange where, std::initializer_list<std::string> args = {}) {
        return state_.reports.report(code, where, args);
    }
    /// Adds "declared here" at the declaration of `symbol`, when it has one in a file of the user.
    static void noteDeclared(diag::Diagnostic& diagnostic, const Symbol& symbol);
    void placeholder(const syntax::Node& node);
    /// What every symbol of the module has.
    template <class S>
    S& fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name, bool local);

    State& state_;
};

template <class S>
S& CheckerPart::fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name,
                     bool local) {
    symbol.kind = kind;
    symbol.name = text(name);
    symbol.nameId = idOf(name);
    symbol.module = state_.context.module;
    symbol.decl = &decl;
    symbol.nameToken = name;
    symbol.isLocal = local;
    symbol.predefined = state_.context.module->predefined;
    return symbol;
}

} // namespace rapid::sema
