#pragma once
// The short words that all parts of a check use: text and place of a node, its facts, reports.

#include "frontend/sema/parts.h"
#include "frontend/sema/state.h"
#include "frontend/sema/typed.h"

namespace rapid::sema {

class CheckerPart {
  protected:
    explicit CheckerPart(State& state)
        : state_(state), program_(state.program), names_(state.names), reports_(state.reports),
          context_(state.context), task_(state.task), routine_(state.routine) {}

    SourceRange range(const syntax::Node& node) const { return context_.tree->range(node); }
    SourceRange range(syntax::TokenIndex token) const {
        return token == syntax::kNoToken ? SourceRange{} : context_.tree->range(token);
    }
    /// False for what is missing after a syntax error and for the placeholder <ID>.
    bool isName(syntax::TokenIndex token) const {
        return token != syntax::kNoToken &&
               context_.tree->tokens[token].kind == syntax::TokenKind::Identifier;
    }
    NameId idOf(syntax::TokenIndex token) const { return names_.intern(context_.tree->text(token)); }
    /// As written; of a long node the beginning.
    std::string text(const syntax::Node& node) const;
    std::string text(syntax::TokenIndex token) const { return std::string(context_.tree->text(token)); }
    /// As written, and its value where that does not show: "n+1 = 4".
    std::string valueText(const syntax::Expr& e) const;
    ExprInfo& info(const syntax::Expr& e) const { return context_.exprs->at(e.id); }
    void setType(const syntax::Expr& e, const DataType& type) const {
        info(e).setType(type, context_.module->facts->inner);
    }
    FileFacts& facts() const { return *context_.module->facts; }
    bool hasErrorHandler() const {
        return context_.routine && !context_.routine->routineDecl->errors.empty();
    }

    template <size_t N>
    diag::Diagnostic& report(diag::Message<N> message, SourceRange where, diag::MessageArgs<N> args) {
        return reports_.report(message.code, where, args);
    }
    diag::Diagnostic& report(diag::Message<0> message, SourceRange where) {
        return reports_.report(message.code, where, {});
    }
    /// The same; `subject` may be a consequence of another mistake (one_mistake.h).
    template <size_t N>
    diag::Diagnostic& report(diag::Message<N> message, SourceRange where, diag::MessageArgs<N> args,
                             const Subject& subject) {
        diag::Diagnostic& diagnostic = reports_.report(message.code, where, args);
        reports_.noteMisfit(diagnostic, subject);
        return diagnostic;
    }
    /// Adds "declared here" at the declaration of `symbol`, when it has one in a file of the user.
    static void noteDeclared(diag::Diagnostic& diagnostic, const Symbol& symbol);
    /// Notes every placeholder from `first` to `last`: a program with placeholders can be loaded and run, and
    /// ERR_EXECPHR is raised where one is reached (manual 1.1.2).
    void notePlaceholders(syntax::TokenIndex first, syntax::TokenIndex last);
    /// Fills the members that every symbol of the module has.
    template <class S>
    S& fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name, bool local);

    State& state_;
    CheckedProgram& program_;
    Interner& names_;
    Reports& reports_;
    Context& context_;
    TaskContext& task_;
    RoutineContext& routine_;
};

template <class S>
S& CheckerPart::fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name,
                     bool local) {
    symbol.kind = kind;
    symbol.name = text(name);
    symbol.nameId = idOf(name);
    symbol.module = context_.module;
    symbol.decl = &decl;
    symbol.nameToken = name;
    symbol.isLocal = local;
    symbol.predefined = context_.module->predefined;
    return symbol;
}

} // namespace rapid::sema
