#include "frontend/query/scope.h"

#include "frontend/query/fuzzy.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"

#include <unordered_set>

namespace rapid::query {

using namespace sema;
using namespace syntax;

Scope::Scope(const Snapshot& snapshot, const FileView& file, uint32_t offset)
    : snapshot_(snapshot), file_(file), offset_(offset), around_(surroundings(file, offset)) {}

/// Variables of loops are seen in the loop only.
bool Scope::reaches(const DataSymbol& data) const {
    if (data.storage != Storage::LoopVariable || !data.decl) return true;
    const SourceRange loop = file_.tree->range(*data.decl);
    const bool ended = data.decl->last < file_.tree->tokens.size() &&
                       file_.tree->tokens[data.decl->last].kind == TokenKind::KwEndfor;
    return loop.begin <= offset_ && (offset_ <= loop.end || !ended);
}

/// Calls `visit` for the data of the routine, the innermost last declared first, until it returns true.
template <class F> bool Scope::inRoutine(F&& visit) const {
    if (!around_.routine) return false;
    const auto& data = around_.routine->data;
    for (size_t i = data.size(); i-- > 0;)
        if (data[i] && !data[i]->name.empty() && reaches(*data[i]) && visit(*data[i])) return true;
    for (const DataSymbol* param : around_.routine->params)
        if (param && !param->name.empty() && visit(*param)) return true;
    return false;
}

namespace {

template <class F> bool inModule(const Module& module, F&& visit) {
    for (const DataSymbol* data : module.data)
        if (visit(*data)) return true;
    for (const RoutineSymbol* routine : module.routines)
        if (visit(*routine)) return true;
    for (const TypeSymbol* type : module.types)
        if (visit(*type)) return true;
    return false;
}

const Symbol* findIn(const NameTable& table, const std::string& folded) {
    const auto found = table.find(folded);
    return found == table.end() ? nullptr : found->second;
}

/// Without making a copy of each name that is compared: most differ in length.
bool isNamed(const Symbol& symbol, const std::string& folded) {
    return symbol.name.size() == folded.size() && foldName(symbol.name) == folded;
}

} // namespace

const Symbol* Scope::find(std::string_view name) const {
    if (name.empty()) return nullptr;
    const std::string folded = foldName(name);
    const Symbol* found = nullptr;
    const auto matches = [&](const Symbol& symbol) {
        if (!isNamed(symbol, folded)) return false;
        found = &symbol;
        return true;
    };
    if (inRoutine(matches)) return found;
    if (around_.module && inModule(*around_.module, matches)) return found;
    if (file_.task) {
        if ((found = findIn(snapshot_.globals(*file_.task), folded))) return found;
        const auto& configured = snapshot_.configured();
        if (const auto place = configured.find(folded); place != configured.end()) return place->second;
    }
    return findIn(snapshot_.predefined(), folded);
}

const TypeSymbol* Scope::findType(std::string_view name) const {
    if (name.empty()) return nullptr;
    const std::string folded = foldName(name);
    const auto asType = [](const Symbol* symbol) {
        return symbol && symbol->kind == SymbolKind::Type ? static_cast<const TypeSymbol*>(symbol) : nullptr;
    };
    if (around_.module)
        for (const TypeSymbol* type : around_.module->types)
            if (isNamed(*type, folded)) return type;
    if (file_.task)
        if (const TypeSymbol* type = asType(findIn(snapshot_.globals(*file_.task), folded))) return type;
    return asType(findIn(snapshot_.predefined(), folded));
}

std::vector<const LabelSymbol*> Scope::labels() const {
    std::vector<const LabelSymbol*> found;
    if (!file_.facts || !around_.routine) return found;
    for (size_t i = 0; i < file_.facts->labels.size(); ++i)
        if (file_.facts->labels[i].routine == around_.routine) found.push_back(&file_.facts->labels[i]);
    return found;
}

const LabelSymbol* Scope::findLabel(std::string_view name) const {
    const std::string folded = foldName(name);
    for (const LabelSymbol* label : labels())
        if (isNamed(*label, folded)) return label;
    return nullptr;
}

std::vector<const Symbol*> Scope::visible(const Cancel* cancel, std::string_view letters) const {
    std::vector<const Symbol*> found;
    forEachVisible(cancel, letters, [&](const Symbol& symbol) { found.push_back(&symbol); });
    return found;
}

void Scope::forEachVisible(const Cancel* cancel, std::string_view letters,
                           const std::function<void(const Symbol&)>& use) const {
    std::unordered_set<std::string> hidden;
    const NameTable* globals = nullptr; ///< once they are among the names found
    const auto add = [&](const Symbol& symbol) {
        if (symbol.name.empty() || !fuzzyMatch(letters, symbol.name)) return false;
        std::string folded = foldName(symbol.name);
        if (globals && globals->contains(folded)) return false;
        if (hidden.insert(std::move(folded)).second) use(symbol);
        return false;
    };
    inRoutine(add);
    if (around_.module) inModule(*around_.module, add);
    if (isCancelled(cancel)) return;
    globals = file_.task ? &snapshot_.globals(*file_.task) : nullptr;
    if (file_.task) {
        // The table has each name once; names of them all, or a set of them, would cost more than the rest of the answer.
        const bool areUnique = snapshot_.hasUniqueGlobals(*file_.task);
        std::unordered_set<const Symbol*> hiddenGlobals;
        for (const std::string& name : hidden)
            if (const Symbol* global = findIn(*globals, name); global && global->module != around_.module)
                hiddenGlobals.insert(global);
        const bool hidesGlobals = !hiddenGlobals.empty();
        for (const Module* module : file_.task->modules) {
            if (isCancelled(cancel)) return;
            if (module == around_.module) continue; // all of it has been found above
            inModule(*module, [&](const Symbol& symbol) {
                if (symbol.isLocal || symbol.name.empty() || !fuzzyMatch(letters, symbol.name)) return false;
                const bool isGlobal = areUnique || findIn(*globals, foldName(symbol.name)) == &symbol;
                if (isGlobal && !(hidesGlobals && hiddenGlobals.contains(&symbol))) use(symbol);
                return false;
            });
        }
        for (const auto& [name, symbol] : snapshot_.configured())
            if (!symbol->assumed || !symbol->module || snapshot_.fileOf(*symbol->module)) add(*symbol);
    }
    if (isCancelled(cancel)) return;
    for (const Module* module : snapshot_.program().predefinedModules)
        inModule(*module, add);
}

const Type* typeNamed(const Scope& scope, std::string_view name) {
    const TypeSymbol* symbol = scope.findType(name);
    return symbol ? symbol->type : nullptr;
}

namespace {

bool isKnown(const DataType& type) {
    return type.type && type.type->kind != TypeKind::Error;
}

DataType byNames(const Scope& scope, const Expr& expr) {
    const SyntaxTree& tree = *scope.file().tree;
    switch (expr.kind) {
    case NodeKind::Name: {
        const Symbol* symbol = scope.find(tree.text(as<NameExpr>(expr).name));
        return symbol && symbol->kind == SymbolKind::Data ? static_cast<const DataSymbol*>(symbol)->type
                                                          : DataType{};
    }
    case NodeKind::Call: {
        const Symbol* symbol = scope.find(tree.text(as<CallExpr>(expr).name));
        return symbol && symbol->kind == SymbolKind::Routine
                   ? static_cast<const RoutineSymbol*>(symbol)->returnType
                   : DataType{};
    }
    case NodeKind::Index: {
        DataType base = typeOfExpr(scope, *as<IndexExpr>(expr).base);
        base.rank = 0;
        return base;
    }
    case NodeKind::Component: {
        const auto& component = as<ComponentExpr>(expr);
        const DataType base = typeOfExpr(scope, *component.base);
        const int index = base.type ? base.type->findComponent(tree.text(component.name)) : -1;
        if (index < 0) return {};
        return {base.type->base()->components[static_cast<size_t>(index)].type, 0, {}};
    }
    case NodeKind::Paren: return typeOfExpr(scope, *as<ParenExpr>(expr).inner);
    case NodeKind::NumLiteral: return {scope.snapshot().program().num, 0, {}};
    case NodeKind::BoolLiteral: return {scope.snapshot().program().boolean, 0, {}};
    case NodeKind::StringLiteral: return {scope.snapshot().program().string, 0, {}};
    default: return {};
    }
}

} // namespace

DataType typeOfExpr(const Scope& scope, const Expr& expr) {
    if (const Module* module = scope.around().module) {
        const ExprInfo& info = scope.snapshot().program().info(*module, expr);
        if (info.symbol && info.symbol->kind == SymbolKind::Data && expr.kind == NodeKind::Name) {
            const DataType& own = static_cast<const DataSymbol*>(info.symbol)->type;
            if (isKnown(own)) return own; // a signal that is read as a number is a signal
        }
        if (isKnown(info.type())) return info.type();
    }
    return byNames(scope, expr);
}

} // namespace rapid::query
