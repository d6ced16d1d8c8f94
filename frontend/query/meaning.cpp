#include "frontend/query/meaning.h"

#include "frontend/sema/names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

const DataSymbol* dataOf(const Symbol* symbol) {
    return symbol && symbol->kind == SymbolKind::Data ? static_cast<const DataSymbol*>(symbol) : nullptr;
}
const RoutineSymbol* routineOf(const Symbol* symbol) {
    return symbol && symbol->kind == SymbolKind::Routine ? static_cast<const RoutineSymbol*>(symbol)
                                                         : nullptr;
}
const TypeSymbol* typeSymbolOf(const Symbol* symbol) {
    return symbol && symbol->kind == SymbolKind::Type ? static_cast<const TypeSymbol*>(symbol) : nullptr;
}

namespace {

/// Finds what one token means by the nodes around it.
class Finder {
  public:
    Finder(const Snapshot& snapshot, const FileView& file, TokenIndex token)
        : snapshot_(snapshot), file_(file), tree_(*file.tree), token_(token),
          scope_(snapshot, file, tree_.tokens[token].offset),
          // One more, so that the nodes which begin with the token are found.
          path_(nodesAt(file, tree_.tokens[token].offset + (tree_.tokens[token].length > 0 ? 1 : 0))) {
        meaning_.file = &file;
        meaning_.token = token;
    }

    Meaning find() {
        for (size_t i = path_.size(); i-- > 0 && !meaning_.found();) {
            at_ = i;
            meaning_.node = path_[i];
            look(*path_[i]);
        }
        return meaning_;
    }

  private:
    bool is(TokenIndex token) const { return token == token_ && token != kNoToken; }
    std::string_view text() const { return tree_.text(token_); }
    void set(const Symbol* symbol, Access access) {
        if (!symbol || symbol->name.empty()) return;
        meaning_.symbol = symbol;
        meaning_.access = access;
    }
    void declares(const Node& node) {
        const auto isIt = [&](const Symbol* s) { return s && s->decl == &node && s->nameToken == token_; };
        const auto inList = [&](const auto& list) {
            for (const auto* symbol : list)
                if (isIt(symbol)) set(symbol, Access::Declaration);
        };
        const Surroundings& around = scope_.around();
        const RoutineSymbol* routine = around.routine;
        if (routine) {
            inList(routine->params);
            inList(routine->data);
        }
        if (!around.module || meaning_.symbol) return;
        inList(around.module->types);
        inList(around.module->data);
        inList(around.module->routines);
    }
    void type(TokenIndex name) {
        if (is(name)) set(scope_.findType(text()), Access::Read);
    }
    const BoundCall* boundCall(const Node& node) const {
        if (!file_.facts) return nullptr;
        const auto found = file_.facts->calls.find(&node);
        return found == file_.facts->calls.end() ? nullptr : &found->second;
    }
    const RoutineSymbol* calleeOf(const Node& node, TokenIndex name) const {
        if (const BoundCall* call = boundCall(node)) return call->routine;
        return routineOf(scope_.find(tree_.text(name)));
    }

    void call(const Node& node, TokenIndex name, std::span<Argument* const> args) {
        if (is(name)) return set(calledOrNamed(node, name), Access::Call);
        for (const Argument* arg : args)
            if (is(arg->name)) return argumentName(node, name, *arg);
    }
    const Symbol* calledOrNamed(const Node& node, TokenIndex name) const {
        if (const RoutineSymbol* routine = calleeOf(node, name)) return routine;
        return scope_.find(tree_.text(name));
    }
    void argumentName(const Node& node, TokenIndex name, const Argument& arg) {
        if (const BoundCall* call = boundCall(node))
            for (const BoundArg& bound : call->args)
                if (bound.param && bound.argument == &arg) return set(bound.param, Access::Read);
        const RoutineSymbol* routine = calleeOf(node, name);
        if (!routine) return;
        const std::string folded = foldName(text());
        for (const DataSymbol* param : routine->params)
            if (foldName(param->name) == folded) return set(param, Access::Read);
    }

    void component(const ComponentExpr& node) {
        if (!is(node.name)) return;
        const DataType base = typeOfExpr(scope_, *node.base);
        if (!base.type) return;
        const int index = base.type->findComponent(text());
        if (index < 0) return;
        meaning_.record = base.type->base();
        meaning_.component = index;
        meaning_.access = accessOfExpr();
    }
    void recordComponent(const RecordComponent& node) {
        type(node.type);
        if (!is(node.name) || !scope_.around().module || at_ == 0) return;
        for (const TypeSymbol* symbol : scope_.around().module->types)
            if (symbol->decl == path_[at_ - 1] && symbol->type) {
                meaning_.component = symbol->type->findComponent(text());
                if (meaning_.component >= 0) meaning_.record = symbol->type;
                meaning_.access = Access::Declaration;
            }
    }

    void name(const NameExpr& node) {
        const Symbol* symbol = nullptr;
        if (const Module* module = scope_.around().module)
            symbol = snapshot_.program().info(*module, node).symbol;
        if (!symbol || symbol->name.empty()) symbol = scope_.find(text());
        set(symbol, accessOfExpr());
    }

    /// What happens to the expression at `at_`, seen from the nodes around it: parts of something that is written are
    /// written, indices are read.
    Access accessOfExpr() const {
        const Node* inner = path_[at_];
        for (size_t i = at_; i-- > 0; inner = path_[i]) {
            const Node& outer = *path_[i];
            switch (outer.kind) {
            case NodeKind::Component: continue;
            case NodeKind::Index:
                if (as<IndexExpr>(outer).base != inner) return Access::Read;
                continue;
            case NodeKind::Argument:
                if (i == 0) return Access::Read;
                return accessOfArgument(*path_[i - 1], as<Argument>(outer));
            case NodeKind::Assign:
                return as<AssignStmt>(outer).target == inner ? Access::Write : Access::Read;
            case NodeKind::Connect:
                return as<ConnectStmt>(outer).target == inner ? Access::Write : Access::Read;
            default: return Access::Read;
            }
        }
        return Access::Read;
    }
    Access accessOfArgument(const Node& call, const Argument& arg) const {
        const BoundCall* bound = boundCall(call);
        if (!bound) return Access::Read;
        for (const BoundArg& b : bound->args) {
            if (b.argument != &arg || !b.param) continue;
            const ParamMode mode = b.param->mode;
            // Tools and work objects are given as PERS and only read by what is predefined.
            if (mode == ParamMode::Pers && bound->routine && bound->routine->predefined) return Access::Read;
            return mode == ParamMode::In ? Access::Read : Access::ReadWrite;
        }
        return Access::Read;
    }

    const Symbol* kept(const Node& node) const {
        if (!file_.facts) return nullptr;
        const auto found = file_.facts->references.find(&node);
        return found == file_.facts->references.end() ? nullptr : found->second;
    }

    void look(const Node& node) {
        switch (node.kind) {
        case NodeKind::Name:
            if (is(as<NameExpr>(node).name)) name(as<NameExpr>(node));
            break;
        case NodeKind::Component: component(as<ComponentExpr>(node)); break;
        case NodeKind::Call: call(node, as<CallExpr>(node).name, as<CallExpr>(node).args); break;
        case NodeKind::CallStmt: call(node, as<CallStmt>(node).name, as<CallStmt>(node).args); break;
        case NodeKind::Break:
        case NodeKind::Continue:
            if (boundCall(node)) call(node, node.first, {});
            break;
        case NodeKind::Goto:
            if (is(as<GotoStmt>(node).label))
                set(kept(node) ? kept(node) : scope_.findLabel(text()), Access::Read);
            break;
        case NodeKind::Label:
            if (is(as<LabelStmt>(node).name)) set(scope_.findLabel(text()), Access::Declaration);
            break;
        case NodeKind::Connect:
            if (is(as<ConnectStmt>(node).trap))
                set(kept(node) ? kept(node) : scope_.find(text()), Access::Call);
            break;
        case NodeKind::For:
            if (is(as<ForStmt>(node).variable)) declares(node);
            break;
        default: lookAtDeclaration(node);
        }
    }
    void lookAtDeclaration(const Node& node) {
        switch (node.kind) {
        case NodeKind::Data:
            type(as<DataDecl>(node).type);
            if (is(as<DataDecl>(node).name)) declares(node);
            break;
        case NodeKind::Param:
            type(as<ParamDecl>(node).type);
            if (is(as<ParamDecl>(node).name)) declares(node);
            break;
        case NodeKind::Alias:
            type(as<AliasDecl>(node).type);
            if (is(as<AliasDecl>(node).name)) declares(node);
            break;
        case NodeKind::Record:
            if (is(as<RecordDecl>(node).name)) declares(node);
            break;
        case NodeKind::RecordComponent: recordComponent(as<RecordComponent>(node)); break;
        case NodeKind::Routine:
            type(as<RoutineDecl>(node).returnType);
            if (is(as<RoutineDecl>(node).name)) declares(node);
            break;
        case NodeKind::Module:
            if (is(as<ModuleDecl>(node).name)) {
                meaning_.module = scope_.around().module;
                meaning_.access = Access::Declaration;
                for (const Module* module : file_.modules)
                    if (module->decl == &node) meaning_.module = module;
            }
            break;
        default: break;
        }
    }

    const Snapshot& snapshot_;
    const FileView& file_;
    const SyntaxTree& tree_;
    TokenIndex token_;
    Scope scope_;
    std::vector<const Node*> path_;
    size_t at_ = 0;
    Meaning meaning_;
};

/// In what could not be read: the text alone says what a name means.
Meaning byText(const Snapshot& snapshot, const FileView& file, TokenIndex token) {
    Meaning meaning;
    meaning.file = &file;
    meaning.token = token;
    const Scope scope(snapshot, file, file.tree->tokens[token].offset);
    meaning.symbol = scope.find(file.tree->text(token));
    return meaning;
}

} // namespace

Meaning meaningOf(const Snapshot& snapshot, const FileView& file, TokenIndex token) {
    if (token == kNoToken || token >= tokenCountOf(file) || !isWord(file.tree->tokens[token].kind)) return {};
    Meaning meaning = Finder(snapshot, file, token).find();
    if (meaning.found()) return meaning;
    const TokenKind before = token > 0 ? file.tree->tokens[token - 1].kind : TokenKind::EndOfFile;
    if (file.tree->tokens[token].kind != TokenKind::Identifier || before == TokenKind::Dot ||
        before == TokenKind::Backslash)
        return {};
    const std::vector<const Node*> path = nodesAt(file, file.tree->tokens[token].offset);
    const bool unread = path.empty() || path.back()->kind == NodeKind::ErrorStmt || path.back()->broken ||
                        path.back()->kind == NodeKind::ErrorDecl || path.back()->kind == NodeKind::ErrorExpr;
    return unread ? byText(snapshot, file, token) : Meaning{};
}

Meaning meaningAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    return meaningOf(snapshot, file, wordAt(file, offset));
}

Location declarationOf(const Snapshot& snapshot, const Meaning& meaning) {
    Location place;
    if (meaning.symbol) return locationOf(snapshot, *meaning.symbol);
    if (meaning.module && meaning.module->decl) {
        const SyntaxTree& tree = *meaning.module->tree;
        place.file = tree.source;
        if (meaning.module->decl->name != kNoToken) place.range = tree.range(meaning.module->decl->name);
        place.whole = tree.range(*meaning.module->decl);
        return place;
    }
    const TypeSymbol* type = meaning.record ? snapshot.symbolOf(*meaning.record) : nullptr;
    if (!type || !type->decl || type->decl->kind != NodeKind::Record) return place;
    const SyntaxTree& tree = *type->module->tree;
    const std::string name =
        foldName(meaning.record->components[static_cast<size_t>(meaning.component)].name);
    for (const RecordComponent* component : as<RecordDecl>(*type->decl).components) {
        if (component->name == kNoToken || foldName(tree.text(component->name)) != name) continue;
        place.file = tree.source;
        place.range = tree.range(component->name);
        place.whole = tree.range(*component);
        place.isLibrary = type->predefined;
        break;
    }
    return place;
}

Entity entityOf(const Snapshot& snapshot, const Meaning& meaning) {
    if (!meaning.found()) return {};
    if (const DataSymbol* data = dataOf(meaning.symbol)) {
        if (data->storage == Storage::Signal) return {"<configured>", 0, foldName(data->name)};
        if (data->storage == Storage::ModuleData && data->dataKind == DataKind::Pers && !data->isLocal &&
            data->scope == ScopeWord::None && !data->predefined)
            return {"<persistent>", 0, foldName(data->name)};
    }
    const Location place = declarationOf(snapshot, meaning);
    if (!place.file) return meaning.symbol ? Entity{"<other>", 0, foldName(meaning.symbol->name)} : Entity{};
    return {place.file->path(), place.range.begin,
            foldName(place.file->text().substr(place.range.begin, place.range.end - place.range.begin))};
}

} // namespace rapid::query
