// Open references: names and data types that a module declares which is not here (encrypted, of an add-in, of the system, or
// loaded later), and placeholders. The instruction that uses them raises an error when it is executed.

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using sema::BoundArg;
using sema::DataSymbol;
using sema::LanguageError;

namespace {

/// The data type as written in the declaration.
std::string_view typeNameOf(const DataSymbol& symbol) {
    if (!symbol.decl || !symbol.module) return symbol.name;
    TokenIndex token = kNoToken;
    if (symbol.decl->kind == NodeKind::Param) token = as<ParamDecl>(*symbol.decl).type;
    if (symbol.decl->kind == NodeKind::Data) token = as<DataDecl>(*symbol.decl).type;
    return token == kNoToken ? std::string_view(symbol.name) : symbol.module->tree->text(token);
}

/// The declaration holds a placeholder in place of type, size or value.
bool hasPlaceholderIn(const DataSymbol& symbol) {
    if (!symbol.decl || !symbol.module || symbol.predefined) return false;
    const auto& tokens = symbol.module->tree->tokens;
    for (TokenIndex t = symbol.decl->first; t <= symbol.decl->last && t < tokens.size(); ++t)
        if (isPlaceholder(tokens[t].kind)) return true;
    return false;
}

/// An array whose size is a placeholder; that of a parameter is known at run time.
bool lacksSize(const DataSymbol& symbol) {
    if (symbol.storage == sema::Storage::Parameter) return false;
    for (int k = 0; k < symbol.type.rank; ++k)
        if (symbol.type.dims[k] == 0) return true;
    return false;
}

/// Its initial value is that of a name which nothing declares here.
bool lacksInitialValue(const DataSymbol& symbol) {
    return symbol.init && !symbol.predefined && symbol.value().kind == sema::ConstValue::Kind::None;
}

bool lacksValue(const DataSymbol& symbol) {
    return symbol.dataKind == DataKind::Const && symbol.storage != sema::Storage::Parameter &&
           lacksInitialValue(symbol);
}

/// The name that nothing declares here and on which the initial value hangs.
std::string_view openNameIn(const Node& node, const DataSymbol& symbol) {
    const sema::Module& module = *symbol.module;
    if (node.kind == NodeKind::Name) {
        const auto& name = as<NameExpr>(node);
        const sema::Symbol* other = (*module.exprs)[name.id].symbol;
        if (!other) return module.tree->text(name.name);
        if (other->kind != sema::SymbolKind::Data || other == &symbol) return {};
        const auto& data = static_cast<const DataSymbol&>(*other);
        return lacksInitialValue(data) ? openNameIn(*data.init, data) : std::string_view();
    }
    std::string_view found;
    forEachChild(node, [&](const Node& child) {
        if (found.empty()) found = openNameIn(child, symbol);
    });
    return found;
}

std::string_view openName(const DataSymbol& symbol) {
    const std::string_view found = openNameIn(*symbol.init, symbol);
    return found.empty() ? std::string_view(symbol.name) : found;
}

bool isVariableWithoutValue(const DataSymbol& data) {
    return data.storage == sema::Storage::ModuleData && data.dataKind == DataKind::Var &&
           lacksInitialValue(data) && !isWithoutForm(data);
}

} // namespace

void ProgramLowering::findOpenInitialValues(const sema::Module& module) {
    openInitialValues_ |= std::any_of(module.data.begin(), module.data.end(),
                                      [](const DataSymbol* data) { return isVariableWithoutValue(*data); });
}

std::string_view RoutineLowering::missingInName(const NameExpr& name, LanguageError& error) const {
    const sema::ExprInfo& facts = info(name);
    const bool isData = facts.symbol && facts.symbol->kind == sema::SymbolKind::Data;
    const auto* data = isData ? static_cast<const DataSymbol*>(facts.symbol) : nullptr;
    if (!isUnknown(facts.type()) && !(data && (lacksValue(*data) || lacksSize(*data)))) return {};
    error = data && hasPlaceholderIn(*data) ? LanguageError::Placeholder : LanguageError::UnknownData;
    const bool hasSize =
        data && data->decl && data->decl->kind == NodeKind::Data && !as<DataDecl>(*data->decl).dims.empty();
    const bool lacksType = data && data->decl && isUnknown(data->type) && !hasSize;
    if (lacksType) return typeNameOf(*data);
    return data && lacksValue(*data) ? openName(*data) : module_->tree->text(name.name);
}

std::string_view RoutineLowering::missingInCall(const Node& node, TokenIndex name,
                                                LanguageError& error) const {
    const auto found = facts().calls.find(&node);
    const bool isFunction = node.kind == NodeKind::Call;
    if (found == facts().calls.end() || !found->second.routine) {
        error = isFunction ? LanguageError::UnknownFunction : LanguageError::UnknownProcedure;
        return module_->tree->text(name);
    }
    const sema::RoutineSymbol& routine = *found->second.routine;
    error = LanguageError::Placeholder;
    if (routine.incomplete) return module_->tree->text(name); // <PAR> replaces parameters
    for (const BoundArg& arg : found->second.args) {
        if (arg.kind == BoundArg::Kind::Absent || !isUnknown(arg.param->type)) continue;
        error = hasPlaceholderIn(*arg.param) ? LanguageError::Placeholder : LanguageError::UnknownData;
        return typeNameOf(*arg.param);
    }
    return isFunction ? missingInResult(routine, error) : std::string_view();
}

/// The data type of a function, when nothing declares it.
std::string_view RoutineLowering::missingInResult(const sema::RoutineSymbol& routine,
                                                  LanguageError& error) const {
    if (!isUnknown(routine.returnType)) return {};
    const auto& tree = *routine.module->tree;
    const TokenIndex type = routine.routineDecl->returnType;
    error = isPlaceholder(tree.tokens[type].kind) ? LanguageError::Placeholder : LanguageError::UnknownData;
    return tree.text(type);
}

/// Of the record of an aggregate: a component of a type that nothing declares.
std::string_view RoutineLowering::missingComponent(const Node& node) const {
    if (node.kind != NodeKind::Aggregate) return {};
    const sema::DataType& type = info(as<AggregateExpr>(node)).type();
    if (type.isArray()) return {};
    for (const sema::Type::Component& component : type.type->base()->components)
        if (component.type->base()->kind == sema::TypeKind::Error) return component.name;
    return {};
}

/// Something in the instruction or expression, not in an instruction nested in it, that nothing declares; its name, and
/// the error it raises.
std::string_view RoutineLowering::missingReference(const Node& node, LanguageError& error) const {
    if (!isStmt(node.kind) && containsPlaceholder(node)) return {}; // an error of its own, when it is reached
    if (node.kind == NodeKind::Name) return missingInName(as<NameExpr>(node), error);
    std::string_view missing = missingComponent(node);
    if (!missing.empty()) error = LanguageError::UnknownData;
    forEachChild(node, [&](const Node& child) {
        if (missing.empty() && !isStmt(child.kind)) missing = missingReference(child, error);
    });
    if (!missing.empty()) return missing;
    if (node.kind == NodeKind::Call) return missingInCall(node, as<CallExpr>(node).name, error);
    if (node.kind == NodeKind::CallStmt && !as<CallStmt>(node).lateName)
        return missingInCall(node, as<CallStmt>(node).name, error);
    error = LanguageError::UnknownData;
    if (node.kind == NodeKind::Component) {
        const auto& component = as<ComponentExpr>(node);
        return isUnknown(info(component).type()) ? module_->tree->text(component.name) : std::string_view();
    }
    if (node.kind != NodeKind::Aggregate) return {};
    const sema::DataType& type = info(as<AggregateExpr>(node)).type();
    const std::string_view text = module_->tree->source->text();
    const SourceRange range = module_->tree->range(node);
    constexpr uint32_t kShown = 40;
    return isUnknown(type) ? text.substr(range.begin, std::min(range.end - range.begin, kShown))
                           : std::string_view();
}

/// A variable of this program or unit that has no value until it is assigned.
bool RoutineLowering::beginsWithoutValue(const DataSymbol& data) const {
    return !program_.isForeign(data) && isVariableWithoutValue(data);
}

/// Variables that no assignment has given a value yet; the target of an assignment gets its value from it.
void RoutineLowering::checkAssigned(const Node& part) {
    if (!program_.hasOpenInitialValues()) return;
    const Expr* target = part.kind == NodeKind::Assign ? as<AssignStmt>(part).target : nullptr;
    std::vector<const DataSymbol*> used;
    collectData(
        part, target && target->kind == NodeKind::Name ? target : nullptr,
        [this](const DataSymbol& data) { return beginsWithoutValue(data); }, used);
    for (const DataSymbol* data : used) {
        const ValueId flag = b_.load(ir::kI32, b_.globalAddr(program_.valueFlag(*data, task_)));
        requireData(b_.binary(ir::Op::INe, flag, b_.constI32(0)),
                    hasPlaceholderIn(*data) ? LanguageError::Placeholder : LanguageError::UnknownData,
                    openName(*data));
    }
}

void RoutineLowering::noteAssigned(const Expr& target) {
    if (!program_.hasOpenInitialValues() || target.kind != NodeKind::Name) return;
    const sema::Symbol* symbol = info(target).symbol;
    if (!symbol || symbol->kind != sema::SymbolKind::Data) return;
    const auto& data = static_cast<const DataSymbol&>(*symbol);
    if (beginsWithoutValue(data))
        b_.store(ir::kI32, b_.constI32(1), b_.globalAddr(program_.valueFlag(data, task_)));
}

/// An instruction whose references stay open until it is executed (manual 1.6). True when it has been dealt with.
bool RoutineLowering::lowerUnresolved(const Node& statement, const Node& part, ir::StmtKind kind) {
    LanguageError error = LanguageError::None;
    std::string_view missing;
    switch (part.kind) {
    case NodeKind::If:
    case NodeKind::CompactIf:
    case NodeKind::While:
    case NodeKind::For:
    case NodeKind::Test:
    case NodeKind::PlaceholderStmt: return false; // their parts, one by one, when they are reached
    case NodeKind::Connect:
        if (facts().references.find(&part) == facts().references.end()) {
            error = LanguageError::UnknownTrap;
            missing = module_->tree->text(as<ConnectStmt>(part).trap);
            break;
        }
        missing = missingReference(part, error);
        break;
    case NodeKind::CallStmt: missing = missingInCallStmt(as<CallStmt>(part), error); break;
    case NodeKind::Return:
        if (symbol_.routineKind == RoutineKind::Func) missing = missingInResult(symbol_, error);
        if (!missing.empty()) break;
        missing = missingReference(part, error);
        break;
    default: missing = missingReference(part, error);
    }
    if (missing.empty()) return false;
    startStatement(statement, kind);
    raiseUnresolved(error, missing);
    return true;
}

/// An expression in the head of an instruction, as lowerUnresolved().
bool RoutineLowering::lowerOpenHead(const Expr& expr) {
    return lowerUnresolved(expr, expr, ir::StmtKind::Control);
}

/// A procedure that nothing declares is looked for when it is called: a module that came meanwhile may have it. An argument
/// of unknown type cannot be passed to it.
std::string_view RoutineLowering::missingInCallStmt(const CallStmt& stmt, LanguageError& error) const {
    const auto found = facts().calls.find(&stmt);
    const bool bound = found != facts().calls.end();
    if (stmt.lateName || (bound && found->second.routine)) return missingReference(stmt, error);
    error = LanguageError::UnknownProcedure;
    const std::string_view name = module_->tree->text(stmt.name);
    if (!bound) return name;
    LanguageError ignored = LanguageError::None;
    for (const BoundArg& arg : found->second.args)
        if (arg.value &&
            (isUnknown(info(*arg.value).type()) || !missingReference(*arg.value, ignored).empty()))
            return name;
    return {};
}

void RoutineLowering::raiseUnresolved(LanguageError error, std::string_view name) {
    if (error == LanguageError::Placeholder)
        return b_.check(b_.constBool(false), program_.errorNumber(error));
    const uint32_t native = program_.support(Support::rt_unresolved);
    b_.callNative(native,
                  {b_.constI32(program_.errorNumber(error)), b_.globalAddr(program_.stringGlobal(name))});
}

} // namespace rapid::lower
