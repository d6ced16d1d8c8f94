// Types of names: records, aliases (manual 1.2.1) and the parameter lists of routines (manual 1.1.5).

#include "frontend/sema/analysis.h"
#include "frontend/sema/literal_value.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

bool Analyzer::isValueType(const Type& type) {
    switch (type.kind) {
    case TypeKind::Error:
    case TypeKind::Num:
    case TypeKind::Dnum:
    case TypeKind::Bool:
    case TypeKind::String: return true;
    case TypeKind::Record: return !type.containsNonValue;
    case TypeKind::NonValue:
    case TypeKind::SemiValue:
    case TypeKind::Switch:
    case TypeKind::AnyType: return false;
    }
    return false;
}

TypeSymbol* Analyzer::findType(NameId name) const {
    TypeSymbol* found = asType(scopes_[context_.module->id]->names.find(name));
    if (!found && !context_.module->predefined) found = asType(at(globals_, name));
    return found ? found : asType(at(predefined_, name));
}

// "VAR counter num;": nobody is to blame who uses 'counter'.
bool Analyzer::reportTypeBehindName(const DataDecl& decl) {
    if (!isName(decl.type) || !isName(decl.name)) return false;
    const NameId name = idOf(decl.type);
    if (!findType(idOf(decl.name)) || lookup(name)) return false;
    diag::Diagnostic& d =
        report(Code::UnknownType, range(decl.type),
               {text(decl.type), "; '" + text(decl.name) + "' is one: write it before the name"});
    d.fixes.push_back({"write the data type first",
                       {{range(decl.type), text(decl.name)}, {range(decl.name), text(decl.type)}},
                       true});
    maybeDeclared_.insert(name);
    facts().open = true; // others may use it
    return true;
}

// A name of data may equal the name of a type (`PROC place(pos pos)`): types are looked for on their own.
const Type* Analyzer::resolveType(TokenIndex token, const DataDecl* data) {
    if (token == kNoToken) return program_.errorType;
    if (context_.tree->tokens[token].kind != TokenKind::Identifier)
        return program_.errorType; // <ID>, reported
    const NameId name = idOf(token);
    TypeSymbol* found = findType(name);
    if (!found) {
        if (data && reportTypeBehindName(*data)) return program_.errorType;
        const Symbol* other = scopes_[context_.module->id]->names.find(name);
        if (!other) other = lookupOutside(name);
        if (other)
            noteDeclared(report(Code::NotAType, range(token), {text(token), describe(*other)}), *other);
        else
            reportUnknown(Code::UnknownType, token, name, Wanted::Type);
        return program_.errorType;
    }
    markUsed(*found);
    const Type* type = ensureType(*found);
    if (!isReal(*type) && !context_.module->predefined) {
        report(Code::PseudoType, range(token), {text(token)});
        return program_.errorType;
    }
    return type;
}

const Type* Analyzer::ensureType(TypeSymbol& symbol) {
    if (symbol.progress == Progress::Done) return symbol.type;
    const Context saved = context_;
    enterModule(symbol.module);
    const bool cycle = symbol.progress == Progress::Active;
    if (!symbol.type) symbol.type = &facts().symbols->types.emplace_back();
    if (cycle || depth_ >= kMaxDepth) {
        entangled_ = true;
        TokenIndex at = symbol.nameToken; // the part that leads back to it
        for (const auto& [whole, part] : resolvingParts_)
            if (cycle && whole == symbol.type) at = part;
        noteDeclared(report(cycle ? Code::TypeCycle : Code::TypeTooDeep, range(at), {symbol.name}), symbol);
        symbol.type->kind = TypeKind::Error;
        symbol.progress = Progress::Done;
        context_ = saved;
        return symbol.type;
    }
    symbol.progress = Progress::Active;
    ++depth_;
    const bool outerMuted = std::exchange(muted_, false);
    Type& type = *symbol.type;
    if (type.kind == TypeKind::Error) { // not one of the atomic types, which exist beforehand
        type.kind = TypeKind::Record;
        type.name = symbol.name;
        type.module = symbol.module;
        if (symbol.decl->kind == NodeKind::Record)
            resolveRecord(type, as<RecordDecl>(*symbol.decl));
        else
            resolveAlias(type, as<AliasDecl>(*symbol.decl));
        if (symbol.predefined) applyTypeAttributes(symbol);
    }
    --depth_;
    muted_ = outerMuted;
    symbol.progress = Progress::Done;
    context_ = saved;
    return symbol.type;
}

void Analyzer::resolveRecord(Type& type, const RecordDecl& decl) {
    NameMap<const RecordComponent> names;
    uint64_t leaves = 0;
    type.unclear = hasUnclearLine(decl);
    for (const RecordComponent* c : decl.components) {
        if (!isName(c->name)) {
            type.unclear = true;
            continue;
        }
        const NameId name = idOf(c->name);
        if (names.find(name)) report(Code::DuplicateComponent, range(c->name), {text(c->name), type.name});
        names.set(name, c);
        resolvingParts_.emplace_back(&type, c->type);
        const Type* part = resolveType(c->type);
        resolvingParts_.pop_back();
        type.components.push_back({text(c->name), part});
        if (!isValueType(*part)) type.containsNonValue = true;
        leaves = std::min<uint64_t>(leaves + part->leaves, kMaxLeaves + 1);
    }
    type.leaves = static_cast<uint32_t>(std::max<uint64_t>(leaves, 1));
    type.literalShape = literalShape(type);
}

void Analyzer::resolveAlias(Type& type, const AliasDecl& decl) {
    resolvingParts_.emplace_back(&type, decl.type);
    const Type* target = resolveType(decl.type);
    resolvingParts_.pop_back();
    if (target == &type || type.kind == TypeKind::Error) return; // a cycle, reported
    type.aliasOf = target;
    type.kind = target->kind;
    type.components = target->components;
    type.containsNonValue = target->containsNonValue;
    type.leaves = target->leaves;
}

void Analyzer::resolveSignature(RoutineSymbol& symbol) {
    if (symbol.progress != Progress::Pending) return;
    symbol.progress = Progress::Done;
    enterModule(symbol.module);
    const RoutineDecl& decl = *symbol.routineDecl;
    symbol.incomplete |= decl.broken;
    if (decl.routineKind == RoutineKind::Func) {
        symbol.returnType.type = resolveType(decl.returnType);
        const Type& type = *symbol.returnType.type;
        if (!isValueType(type) && !symbol.predefined) {
            report(Code::NonValueReturn, range(decl.returnType), {symbol.name, type.name});
            symbol.returnType.type = program_.errorType;
        }
    }
    for (const ParamDecl* param : decl.params)
        resolveParameter(symbol, *param);
    for (size_t i = 0; i + 1 < symbol.params.size(); ++i) {
        DataSymbol &a = *symbol.params[i], &b = *symbol.params[i + 1];
        if (!a.optional && !b.optional && a.group == b.group)
            a.requiredAlternative = b.requiredAlternative = true;
    }
    if (symbol.predefined) applyRoutineAttributes(symbol);
}

DataSymbol& Analyzer::newParameter(RoutineSymbol& routine) {
    const size_t index = routine.params.size();
    if (index >= routine.formerParams.size()) return facts().symbols->dataSymbols.emplace_back();
    DataSymbol& symbol = *routine.formerParams[index];
    symbol.reset();
    return symbol;
}

void Analyzer::resolveParameter(RoutineSymbol& routine, const ParamDecl& decl) {
    if (decl.placeholder || !isName(decl.name)) {
        if (decl.placeholder) placeholder(decl);
        routine.incomplete = true;
        return;
    }
    DataSymbol& symbol = newParameter(routine);
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.name = text(decl.name);
    symbol.nameId = idOf(decl.name);
    symbol.module = routine.module;
    symbol.decl = &decl;
    symbol.nameToken = decl.name;
    symbol.predefined = routine.predefined;
    symbol.storage = Storage::Parameter;
    symbol.mode = decl.mode;
    symbol.dataKind = decl.mode == ParamMode::Pers ? DataKind::Pers : DataKind::Var;
    symbol.optional = decl.optional;
    symbol.isSwitch = decl.isSwitch;
    symbol.group = decl.group;
    symbol.routine = &routine;
    symbol.index = static_cast<uint32_t>(routine.params.size());
    routine.params.push_back(&symbol);
    routine.incomplete |= !decl.isSwitch && decl.type == kNoToken; // what it takes is not known
    if (decl.isSwitch) {
        symbol.type.type = switchType_;
        if (!decl.optional) {
            const uint32_t begin = range(decl).begin;
            report(Code::SwitchNotOptional, range(decl.name), {symbol.name}).fix({begin, begin}, "\\");
        }
        symbol.optional = true;
        return;
    }
    symbol.type.type = resolveType(decl.type);
    symbol.type.rank = decl.rank > 3 ? 0 : decl.rank;
    if (decl.rank > 3) { // <DIM>, or more than three stars
        if (decl.rank == 255)
            placeholder(decl);
        else
            report(Code::TooManyDimensions, range(decl.name + 8), {std::to_string(decl.rank)}); // "{*,*,*,*"
        symbol.type.type = program_.errorType;
    }
    if (decl.mode == ParamMode::In && isHandle(*symbol.type.type) && isReal(*symbol.type.type)) {
        report(Code::NonValueInParameter, range(decl.type), {symbol.name, symbol.type.type->name});
        symbol.mode = ParamMode::Inout; // what is passed to it is right then
    }
}

} // namespace rapid::sema
