// Types of names: records, aliases (manual 1.2.1) and the parameter lists of routines (manual 1.1.5).

#include "frontend/sema/resolve_types.h"
#include "frontend/diag/messages/names.h"
#include "frontend/sema/attributes.h"
#include "frontend/sema/literal_value.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

TypeResolver::TypeResolver(State& state, const Parts& parts)
    : CheckerPart(state), scopes_(parts.scopes), unknown_(parts.unknown) {}

// "VAR counter num;": uses of 'counter' are not reported.
bool TypeResolver::reportTypeAfterName(const DataDecl& decl) {
    if (!isName(decl.type) || !isName(decl.name)) return false;
    const NameId name = idOf(decl.type);
    if (!scopes_.findType(idOf(decl.name)) || scopes_.lookup(name)) return false;
    diag::Diagnostic& d =
        report(say::UnknownType, range(decl.type),
               {text(decl.type), "; '" + text(decl.name) + "' is one: write it before the name"});
    d.fixes.push_back({"write the data type first",
                       {{range(decl.type), text(decl.name)}, {range(decl.name), text(decl.type)}},
                       true});
    task_.maybeDeclared.insert(name);
    facts().open = true; // others may use it
    return true;
}

// A name of data may equal the name of a type (`PROC place(pos pos)`): types are looked for on their own.
const Type* TypeResolver::resolveType(TokenIndex token, const DataDecl* data) {
    if (token == kNoToken) return program_.errorType;
    if (context_.tree->tokens[token].kind != TokenKind::Identifier)
        return program_.errorType; // <ID>, reported
    const NameId name = idOf(token);
    TypeSymbol* found = scopes_.findType(name);
    if (!found) {
        if (data && reportTypeAfterName(*data)) return program_.errorType;
        const Symbol* other = state_.scopes[context_.module->id]->names.find(name);
        if (!other) other = scopes_.lookupOutside(name);
        if (other)
            noteDeclared(report(say::NotAType, range(token), {text(token), describe(*other)}), *other);
        else
            unknown_.reportUnknown(say::UnknownType, token, name, Wanted::Type);
        return program_.errorType;
    }
    scopes_.markUsed(*found);
    const Type* type = ensureType(*found);
    if (!isReal(*type) && !context_.module->predefined) {
        report(say::PseudoType, range(token), {text(token)});
        return program_.errorType;
    }
    return type;
}

const Type* TypeResolver::ensureType(TypeSymbol& symbol) {
    if (symbol.progress == Progress::Done) return symbol.type;
    const Context saved = context_;
    state_.enterModule(symbol.module);
    const bool cycle = symbol.progress == Progress::Active;
    if (!symbol.type) symbol.type = &facts().symbols->types.emplace_back();
    if (cycle || state_.depth >= kMaxDepth) {
        task_.dependsOnOrder = true;
        TokenIndex at = symbol.nameToken; // the part that leads back to it
        for (const auto& [whole, part] : resolvingParts_)
            if (cycle && whole == symbol.type) at = part;
        noteDeclared(report(cycle ? say::TypeCycle : say::TypeTooDeep, range(at), {symbol.name}), symbol);
        symbol.type->kind = TypeKind::Error;
        symbol.progress = Progress::Done;
        context_ = saved;
        return symbol.type;
    }
    symbol.progress = Progress::Active;
    ++state_.depth;
    const bool outerMuted = reports_.mute(false);
    Type& type = *symbol.type;
    if (type.kind == TypeKind::Error) { // not one of the atomic types, which exist beforehand
        type.kind = TypeKind::Record;
        type.name = symbol.name;
        type.module = symbol.module;
        if (symbol.decl->kind == NodeKind::Record)
            resolveRecord(type, as<RecordDecl>(*symbol.decl));
        else
            resolveAlias(type, as<AliasDecl>(*symbol.decl));
        if (symbol.predefined) applyTypeAttributes(*context_.tree, symbol);
    }
    --state_.depth;
    reports_.mute(outerMuted);
    symbol.progress = Progress::Done;
    context_ = saved;
    return symbol.type;
}

void TypeResolver::resolveRecord(Type& type, const RecordDecl& decl) {
    NameMap<const RecordComponent> names;
    uint64_t leaves = 0;
    type.unclear = reports_.hasUnclearLine(decl);
    for (const RecordComponent* c : decl.components) {
        if (!isName(c->name)) {
            type.unclear = true;
            continue;
        }
        const NameId name = idOf(c->name);
        if (names.find(name)) report(say::DuplicateComponent, range(c->name), {text(c->name), type.name});
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
    type.sortComponents();
}

void TypeResolver::resolveAlias(Type& type, const AliasDecl& decl) {
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

void TypeResolver::resolveSignature(RoutineSymbol& symbol) {
    if (symbol.progress != Progress::Pending) return;
    symbol.progress = Progress::Done;
    state_.enterModule(symbol.module);
    const RoutineDecl& decl = *symbol.routineDecl;
    symbol.incomplete |= decl.broken;
    if (decl.routineKind == RoutineKind::Func) {
        symbol.returnType.type = resolveType(decl.returnType);
        const Type& type = *symbol.returnType.type;
        if (!isValueType(type) && !symbol.predefined) {
            report(say::NonValueReturn, range(decl.returnType), {symbol.name, type.name});
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
    if (symbol.predefined) applyRoutineAttributes(*context_.tree, symbol);
}

DataSymbol& TypeResolver::newParameter(RoutineSymbol& routine) {
    const size_t index = routine.params.size();
    if (index >= routine.formerParams.size()) return facts().symbols->dataSymbols.emplace_back();
    DataSymbol& symbol = *routine.formerParams[index];
    symbol.reset();
    return symbol;
}

void TypeResolver::resolveParameter(RoutineSymbol& routine, const ParamDecl& decl) {
    if (decl.placeholder || !isName(decl.name)) {
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
        symbol.type.type = state_.switchType;
        if (!decl.optional) {
            const uint32_t begin = range(decl).begin;
            report(say::SwitchNotOptional, range(decl.name), {symbol.name}).fix({begin, begin}, "\\");
        }
        symbol.optional = true;
        return;
    }
    symbol.type.type = resolveType(decl.type);
    symbol.type.rank = decl.rank > 3 ? 0 : decl.rank;
    if (decl.rank > 3) { // <DIM>, or more than three stars
        if (decl.rank != 255)
            report(say::TooManyDimensions, range(decl.name + 8), {std::to_string(decl.rank)}); // "{*,*,*,*"
        symbol.type.type = program_.errorType;
    }
    if (decl.mode == ParamMode::In && isHandle(*symbol.type.type) && isReal(*symbol.type.type)) {
        report(say::NonValueInParameter, range(decl.type), {symbol.name, symbol.type.type->name});
        symbol.mode = ParamMode::Inout; // what is passed to it is right then
    }
}

} // namespace rapid::sema
