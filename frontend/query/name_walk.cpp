#include "frontend/query/name_walk.h"

#include "frontend/sema/names.h"

#include <algorithm>
#include <unordered_map>

namespace rapid::query {

using namespace sema;
using namespace syntax;

const BoundCall* boundCallOf(const FileView& file, const Node& node) {
    if (!file.facts) return nullptr;
    const auto found = file.facts->calls.find(&node);
    return found == file.facts->calls.end() ? nullptr : &found->second;
}

namespace {

class NameWalker {
  public:
    NameWalker(const Snapshot& snapshot, const FileView& file, const Module& module,
               const std::function<void(const Meaning&)>& visit)
        : snapshot_(snapshot), file_(file), tree_(*file.tree), module_(module), visit_(visit),
          types_(snapshot, file, module.decl ? file.tree->range(*module.decl).begin + 1 : 0) {
        const auto add = [this](const Symbol* symbol) {
            if (symbol && symbol->decl) declared_[symbol->decl] = symbol;
        };
        for (const TypeSymbol* type : module.types)
            add(type);
        for (const DataSymbol* data : module.data)
            add(data);
        for (const RoutineSymbol* routine : module.routines)
            add(routine);
        if (file.facts)
            for (size_t i = 0; i < file.facts->labels.size(); ++i)
                add(&file.facts->labels[i]);
    }

    void walk(const Decl& decl) {
        routine_ = nullptr;
        found_.clear();
        if (decl.kind == NodeKind::Routine) enter(as<RoutineDecl>(decl));
        node(decl);
        std::sort(found_.begin(), found_.end(),
                  [](const Meaning& a, const Meaning& b) { return a.token < b.token; });
        for (const Meaning& meaning : found_)
            visit_(meaning);
    }

  private:
    void enter(const RoutineDecl& decl) {
        const auto found = declared_.find(&decl);
        if (found == declared_.end()) return;
        routine_ = static_cast<const RoutineSymbol*>(found->second);
        for (const DataSymbol* param : routine_->params)
            if (param->decl) declared_[param->decl] = param;
        for (const DataSymbol* data : routine_->data)
            if (data->decl) declared_[data->decl] = data;
    }

    void add(TokenIndex token, const Symbol* symbol, Access access = Access::Read) {
        if (token == kNoToken || !symbol || symbol->name.empty()) return;
        Meaning& meaning = found_.emplace_back();
        meaning.file = &file_;
        meaning.token = token;
        meaning.symbol = symbol;
        meaning.access = access;
    }
    void declaration(const Node& n, TokenIndex name) {
        const auto found = declared_.find(&n);
        if (found != declared_.end() && found->second->nameToken == name)
            add(name, found->second, Access::Declaration);
    }
    void type(TokenIndex name) {
        if (name != kNoToken) add(name, types_.findType(tree_.text(name)));
    }
    /// A name that the checker did not look at, because of a mistake, means what the scope says.
    const Symbol* byScope(TokenIndex name) const {
        return name == kNoToken ? nullptr
                                : Scope(snapshot_, file_, tree_.tokens[name].offset).find(tree_.text(name));
    }
    void call(const Node& n, TokenIndex name) {
        const BoundCall* bound = boundCallOf(file_, n);
        if (!bound) return add(name, byScope(name), Access::Call);
        add(name, bound->routine, Access::Call);
        for (const BoundArg& arg : bound->args)
            if (arg.param && arg.argument) add(arg.argument->name, arg.param);
    }
    void component(const ComponentExpr& n) {
        if (n.name == kNoToken) return;
        DataType base = snapshot_.program().info(module_, *n.base).type();
        if (!base.type || base.type->kind == TypeKind::Error)
            base = typeOfExpr(Scope(snapshot_, file_, tree_.tokens[n.name].offset), *n.base);
        componentOf(base.type, n.name, Access::Read);
    }
    void componentOf(const Type* record, TokenIndex name, Access access) {
        const int index = record && name != kNoToken ? record->findComponent(tree_.text(name)) : -1;
        if (index < 0) return;
        Meaning& meaning = found_.emplace_back();
        meaning.file = &file_;
        meaning.token = name;
        meaning.record = record->base();
        meaning.component = index;
        meaning.access = access;
    }
    void record(const RecordDecl& n) {
        declaration(n, n.name);
        const auto found = declared_.find(&n);
        const Type* own =
            found == declared_.end() ? nullptr : static_cast<const TypeSymbol*>(found->second)->type;
        for (const RecordComponent* part : n.components) {
            type(part->type);
            componentOf(own, part->name, Access::Declaration);
        }
    }
    const Symbol* kept(const Node& n) const {
        if (!file_.facts) return nullptr;
        const auto found = file_.facts->references.find(&n);
        return found == file_.facts->references.end() ? nullptr : found->second;
    }

    void node(const Node& n) {
        switch (n.kind) {
        case NodeKind::Name: {
            const auto& name = as<NameExpr>(n);
            const Symbol* symbol = snapshot_.program().info(module_, name).symbol;
            add(name.name, symbol && !symbol->name.empty() ? symbol : byScope(name.name));
            return;
        }
        case NodeKind::Component: component(as<ComponentExpr>(n)); break;
        case NodeKind::Call: call(n, as<CallExpr>(n).name); break;
        case NodeKind::CallStmt: call(n, as<CallStmt>(n).name); break;
        case NodeKind::Goto: add(as<GotoStmt>(n).label, kept(n)); return;
        case NodeKind::Label: return declaration(n, as<LabelStmt>(n).name);
        case NodeKind::Break:
        case NodeKind::Continue:
            if (boundCallOf(file_, n)) call(n, n.first);
            return;
        case NodeKind::Connect: add(as<ConnectStmt>(n).trap, kept(n), Access::Call); break;
        case NodeKind::For: declaration(n, as<ForStmt>(n).variable); break;
        case NodeKind::Record: return record(as<RecordDecl>(n));
        case NodeKind::Data:
            type(as<DataDecl>(n).type);
            declaration(n, as<DataDecl>(n).name);
            break;
        case NodeKind::Param:
            type(as<ParamDecl>(n).type);
            declaration(n, as<ParamDecl>(n).name);
            return;
        case NodeKind::Alias:
            type(as<AliasDecl>(n).type);
            declaration(n, as<AliasDecl>(n).name);
            return;
        case NodeKind::Routine:
            type(as<RoutineDecl>(n).returnType);
            declaration(n, as<RoutineDecl>(n).name);
            break;
        default: break;
        }
        forEachNode(n, [this](const Node& child) { node(child); });
    }

    const Snapshot& snapshot_;
    const FileView& file_;
    const SyntaxTree& tree_;
    const Module& module_;
    const std::function<void(const Meaning&)>& visit_;
    Scope types_;
    std::unordered_map<const Node*, const Symbol*> declared_;
    const RoutineSymbol* routine_ = nullptr;
    std::vector<Meaning> found_; ///< of one declaration
};

bool overlaps(const SyntaxTree& tree, const Node& node, SourceRange range) {
    if (node.first == kNoToken || node.first > node.last) return false;
    const SourceRange own = tree.range(node);
    return own.begin <= range.end && range.begin <= own.end;
}

} // namespace

void forEachName(const Snapshot& snapshot, const FileView& file, SourceRange range,
                 const std::function<void(const Meaning&)>& visit, const Cancel* cancel) {
    for (const Module* module : file.modules) {
        if (!module->decl) continue;
        if (module->decl->name != kNoToken && overlaps(*file.tree, *module->decl, range)) {
            Meaning meaning;
            meaning.file = &file;
            meaning.token = module->decl->name;
            meaning.module = module;
            meaning.access = Access::Declaration;
            visit(meaning);
        }
        NameWalker walker(snapshot, file, *module, visit);
        for (const Decl* decl : module->decl->decls) {
            if (isCancelled(cancel)) return;
            if (overlaps(*file.tree, *decl, range)) walker.walk(*decl);
        }
    }
}

void forEachNodeOf(const FileView& file, SourceRange range,
                   const std::function<void(const Module&, const RoutineSymbol*, const Node&)>& visit,
                   const Cancel* cancel) {
    for (const Module* module : file.modules) {
        if (!module->decl) continue;
        std::unordered_map<const Node*, const RoutineSymbol*> routines;
        for (const RoutineSymbol* routine : module->routines)
            routines[routine->decl] = routine;
        for (const Decl* decl : module->decl->decls) {
            if (isCancelled(cancel)) return;
            if (!overlaps(*file.tree, *decl, range)) continue;
            const auto found = routines.find(decl);
            const RoutineSymbol* routine = found == routines.end() ? nullptr : found->second;
            const std::function<void(const Node&)> walk = [&](const Node& node) {
                visit(*module, routine, node);
                forEachNode(node, walk);
            };
            walk(*decl);
        }
    }
}

} // namespace rapid::query
