// Data declarations: types, dimensions and initial values, worked out on demand because constants may refer to
// constants of other modules in any order (manual 1.2.2).

#include "frontend/sema/resolve_data.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/diag/messages/names.h"
#include "frontend/sema/attributes.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/fold.h"
#include "frontend/sema/literal_value.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/resolve_types.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"

#include <cmath>

namespace rapid::sema {

using namespace syntax;

namespace {
/// Such an expression gets no ExprInfo unless something is wrong with it: the symbol has type and value.
bool isPlain(const Expr& e) {
    return e.kind == NodeKind::Aggregate && as<AggregateExpr>(e).isPlain();
}

/// Its initial value is a constant; that of a VAR in a routine is calculated at each call.
bool mustFold(const DataSymbol& symbol) {
    return !symbol.routine || symbol.dataKind != DataKind::Var;
}
} // namespace

DataResolver::DataResolver(State& state, const Parts& parts)
    : CheckerPart(state), expressions_(parts.expressions), folding_(parts.folding), remedies_(parts.remedies),
      types_(parts.types) {}

void DataResolver::ensureData(DataSymbol& symbol) {
    if (symbol.progress != Progress::Pending) {
        if (!symbol.type.type) symbol.type.type = program_.errorType; // its dimensions ask for itself
        return;
    }
    symbol.progress = Progress::Active;
    const Context saved = context_;
    if (!symbol.routine) state_.enterModule(symbol.module);
    if (state_.depth > kMaxDepth) { // its dimensions may ask for the dimensions of others
        task_.dependsOnOrder = true;
        report(say::ConstantTooDeep, range(symbol.nameToken), {symbol.name});
        symbol.type.type = program_.errorType;
        symbol.progress = Progress::Done;
        context_ = saved;
        return;
    }
    ++state_.depth;
    const auto& decl = as<DataDecl>(*symbol.decl);
    const bool outerMuted = reports_.mute(decl.broken);
    const Type* type = types_.resolveType(decl.type, &decl);
    const size_t outerLiterals = expressions_.bigLiterals();
    const uint64_t elements = resolveDimensions(symbol, decl);
    expressions_.checkBigLiterals(outerLiterals);
    // Without its dimensions, or when its line ends in the middle, nothing is said about what is done with it.
    const bool unclear = elements == 0 || (decl.broken && !decl.init);
    symbol.type.type = unclear ? program_.errorType : type;
    if (elements * type->leaves > kMaxLeaves) {
        report(say::ArrayTooLarge, range(symbol.nameToken), {symbol.name});
        symbol.type.type = program_.errorType;
    }
    symbol.progress = Progress::Done;
    if (symbol.predefined) applyDataAttributes(*context_.tree, symbol);
    checkDeclaration(symbol);
    reports_.mute(outerMuted);
    --state_.depth;
    context_ = saved;
}

void DataResolver::checkDeclaration(DataSymbol& symbol) {
    const auto& decl = as<DataDecl>(*symbol.decl);
    const Type& type = *symbol.type.type;
    if (symbol.routine && symbol.dataKind == DataKind::Pers)
        report(say::PersInRoutine, range(symbol.nameToken), {symbol.name});
    if (!isValueType(type) && symbol.dataKind == DataKind::Const)
        report(say::ConstantNonValue, range(symbol.nameToken), {symbol.name, type.name});
    else if (!isValueType(type) && decl.init)
        report(say::NonValueInit, range(*decl.init), {symbol.name, type.name});
    if (symbol.dataKind != DataKind::Pers || decl.init || decl.scope == ScopeWord::None) return;
    const char* scope = decl.scope == ScopeWord::Local ? "LOCAL" : "TASK";
    if (isValueType(type))
        report(say::PersWithoutValue, range(symbol.nameToken), {symbol.name, scope});
    else
        report(say::PersNonValue, range(symbol.nameToken), {symbol.name, scope, type.name});
}

std::string DataResolver::describeDimension(const Expr& e, Typed t) {
    if (!t.isScalar(TypeKind::Num) && !t.isScalar(TypeKind::Dnum)) return "'" + typeName(*t.info) + "'";
    const Symbol* symbol = e.kind == NodeKind::Name ? info(e).symbol : nullptr;
    return symbol ? describe(*symbol) : describeExpr(e);
}

// Gives the number of elements; it stops counting at kMaxLeaves. 0 when that is not known.
uint64_t DataResolver::resolveDimensions(DataSymbol& symbol, const DataDecl& decl) {
    if (decl.dims.empty()) return 1;
    if (decl.dims.size() > 3) {
        report(say::TooManyDimensions, range(*decl.dims[3]), {std::to_string(decl.dims.size())});
        symbol.type.rank = 3; // of any size
        return 0;
    }
    uint64_t elements = 1;
    bool known = true;
    for (size_t i = 0; i < decl.dims.size(); ++i) {
        const Expr& e = *decl.dims[i];
        const bool wasConstant = std::exchange(context_.constant, true);
        const Typed t = expressions_.expr(e);
        context_.constant = wasConstant;
        int32_t size = 0; // after an error: any
        const ConstValue* value = t.info->constant;
        if (!value || value->kind != ConstValue::Kind::Number) {
            known = known && e.kind == NodeKind::PlaceholderExpr;
            const bool number = t.isScalar(TypeKind::Num) || t.isScalar(TypeKind::Dnum);
            const bool reported = number && !findNonConstant(e); // where a constant has no value
            if (!t.isError() && e.kind != NodeKind::PlaceholderExpr && !reported)
                report(say::DimensionNotConstant, range(e), {describeDimension(e, t)});
        } else if (!(value->number >= 1) || value->number != std::floor(value->number) ||
                   value->number > 2e9) {
            known = false;
            report(say::DimensionValue, range(e), {valueText(e)});
        } else {
            size = static_cast<int32_t>(value->number);
            elements = std::min<uint64_t>(elements * static_cast<uint64_t>(size), kMaxLeaves + 1);
        }
        symbol.type.dims[i] = size;
    }
    symbol.type.rank = static_cast<uint8_t>(decl.dims.size());
    return known ? elements : 0;
}

void DataResolver::ensureValue(DataSymbol& symbol) {
    if (symbol.valueProgress == Progress::Done) return;
    const auto& decl = as<DataDecl>(*symbol.decl);
    const bool cycle = symbol.valueProgress == Progress::Active;
    if (cycle || state_.depth >= kMaxDepth) {
        const Context saved = context_;
        if (!symbol.routine) state_.enterModule(symbol.module);
        task_.dependsOnOrder = true;
        report(cycle ? say::ConstantCycle : say::ConstantTooDeep, range(symbol.nameToken), {symbol.name});
        context_ = saved;
        symbol.valueProgress = Progress::Done;
        return;
    }
    symbol.valueProgress = Progress::Active;
    ++state_.depth;
    ensureData(symbol);
    if (decl.init) {
        const Context saved = context_;
        if (!symbol.routine) state_.enterModule(symbol.module);
        const bool outerMuted = reports_.mute(decl.broken);
        const size_t outerLiterals = expressions_.bigLiterals();
        initialise(symbol, decl);
        if (mustFold(symbol)) expressions_.checkBigLiterals(outerLiterals);
        reports_.mute(outerMuted);
        context_ = saved;
    }
    --state_.depth;
    symbol.valueProgress = Progress::Done;
}

void DataResolver::initialise(DataSymbol& symbol, const DataDecl& decl) {
    const Expr& init = *decl.init;
    const bool folds = mustFold(symbol);
    const bool usable = isValueType(*symbol.type.type);
    context_.constant = folds;
    const DataType& want = symbol.type;
    ConstValue* slot = folds ? &symbol.valueSlot() : nullptr;
    if (usable && isPlain(init) && isLiteralOf(want, *context_.tree, as<AggregateExpr>(init))) {
        symbol.setLiteral();
        if (symbol.users > 0 && !state_.options.onlyDiagnostics)
            symbol.value(); // files that are not checked again have its address
        return;
    }
    if (symbol.dataKind == DataKind::Pers && usable) {
        if (const Expr* culprit = findNonLiteral(init)) {
            expressions_.visitLoose(init);
            if (info(*culprit).type().type->kind != TypeKind::Error) // not known, which is reported
                report(say::NotLiteral, range(*culprit), {symbol.name});
            return;
        }
    }
    if (!usable) {
        expressions_.visitLoose(init);
        return;
    }
    const Typed t = expressions_.expr(init, &want, slot);
    const bool cycle = symbol.valueProgress == Progress::Done;
    if (!expressions_.fits(init, t, want)) {
        const auto names = typeNames(t.info->type(), want);
        const Remedy remedy = remedies_.remedyFor(init, t.info->type(), want);
        remedies_.offer(report(say::InitialValueType, range(init), {names[0], names[1], symbol.name},
                               {Misfit::Type, init}),
                        init, remedy);
    } else if (folds && !t.info->constant && !t.isError() && !cycle) {
        reportNonConstant(init);
    }
    if (folds && t.info->constant && t.info->constant != slot) *slot = folding_.owned(*t.info->constant);
    if (folds && !t.info->constant) *slot = ConstValue{};
}

// Names the first part that keeps `expr` from being constant, if that was not reported at its declaration.
void DataResolver::reportNonConstant(const Expr& e) {
    const Expr* culprit = findNonConstant(e);
    if (!culprit) return;
    const bool call = culprit->kind == NodeKind::Call;
    report(say::NotConstant, range(*culprit),
           {text(*culprit), call ? "a function call" : describe(*info(*culprit).symbol)});
}

// The first part that keeps `expr` from being constant; null when that is a constant whose value is wrong.
const Expr* DataResolver::findNonConstant(const Expr& e) {
    switch (e.kind) {
    case NodeKind::Name:
    case NodeKind::Index:
    case NodeKind::Component: {
        const Expr* root = &e;
        const Expr* open = nullptr; // an index whose value is not known
        while (root->kind != NodeKind::Name) {
            if (root->kind == NodeKind::Index)
                for (const Expr* index : as<IndexExpr>(*root).indices)
                    if (!info(*index).constant) open = index;
            root = root->kind == NodeKind::Index ? as<IndexExpr>(*root).base : as<ComponentExpr>(*root).base;
        }
        const DataSymbol* data = asData(const_cast<Symbol*>(info(*root).symbol));
        if (!data) return nullptr;
        if (data->dataKind == DataKind::Const) return open ? findNonConstant(*open) : nullptr;
        return root;
    }
    case NodeKind::Call: return &e;
    case NodeKind::Paren: return findNonConstant(*as<ParenExpr>(e).inner);
    case NodeKind::Unary: return findNonConstant(*as<UnaryExpr>(e).operand);
    case NodeKind::Binary: {
        const Expr* left = findNonConstant(*as<BinaryExpr>(e).left);
        return left ? left : findNonConstant(*as<BinaryExpr>(e).right);
    }
    case NodeKind::Aggregate:
        for (const Expr* element : as<AggregateExpr>(e).elements()) {
            const Expr* culprit = info(*element).constant ? nullptr : findNonConstant(*element);
            if (culprit) return culprit;
        }
        return nullptr;
    default: return nullptr;
    }
}

const Expr* DataResolver::findNonLiteral(const Expr& e) const {
    switch (e.kind) {
    case NodeKind::NumLiteral:
    case NodeKind::StringLiteral:
    case NodeKind::BoolLiteral:
    case NodeKind::PlaceholderExpr:
    case NodeKind::ErrorExpr: return nullptr;
    case NodeKind::Unary: {
        const auto& u = as<UnaryExpr>(e);
        return u.op != UnaryOp::Not && u.operand->kind == NodeKind::NumLiteral ? nullptr : &e;
    }
    case NodeKind::Aggregate:
        for (const Expr* element : as<AggregateExpr>(e).elements())
            if (const Expr* culprit = findNonLiteral(*element)) return culprit;
        return nullptr;
    default: return &e;
    }
}

} // namespace rapid::sema
