// Attributes of library declarations (builtin_words.def). The generator of the standard library has refused unknown words.

#include "frontend/sema/attributes.h"
#include "frontend/syntax/declaration_comment.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

DeclarationComment commentOf(const SyntaxTree& tree, const Node& decl) {
    if (decl.first == kNoToken || decl.first == 0) return {};
    const uint32_t begin = tree.range(decl.first - 1).end;
    return readDeclarationComment(tree.source->text().substr(begin, tree.range(decl.first).begin - begin));
}

/// Calls visit(part) for each part of a list.
template <class F> void forEachPart(std::string_view list, char separator, F&& visit) {
    while (!list.empty()) {
        const size_t end = std::min(list.find(separator), list.size());
        std::string_view part = list.substr(0, end);
        while (part.starts_with(' '))
            part.remove_prefix(1);
        visit(part);
        list.remove_prefix(std::min(end + 1, list.size()));
    }
}

DataSymbol* findParam(const RoutineSymbol& symbol, std::string_view name) {
    for (DataSymbol* param : symbol.params)
        if (param->name == name) return param;
    return nullptr;
}

/// "Signal is signal, Data is value"
void restrictParameters(const RoutineSymbol& symbol, std::string_view list) {
    forEachPart(list, ',', [&](std::string_view one) {
        const size_t is = one.find(" is ");
        DataSymbol* param = is == std::string_view::npos ? nullptr : findParam(symbol, one.substr(0, is));
        if (param) param->accepts = valueOf(kParamClassWords, one.substr(is + 4)).value_or(ParamClass::Any);
    });
}

/// "Len", or "8"
void setTextLength(RoutineSymbol& symbol, std::string_view value) {
    symbol.textLengthParam = findParam(symbol, value);
    for (const char c : value)
        if (c >= '0' && c <= '9')
            symbol.textLength = static_cast<uint8_t>(symbol.textLength * 10 + (c - '0'));
}

void applyAttribute(RoutineSymbol& symbol, std::string_view key, std::string_view value) {
    if (key == "effects") symbol.effects = valueOf(kEffectsWords, value).value_or(Effects::None);
    if (key == "flow") symbol.flow = valueOf(kFlowWords, value).value_or(Flow::Continues);
    if (key == "role") symbol.role = valueOf(kRoleWords, value).value_or(Role::None);
    if (key == "option") symbol.option = std::string(value);
    if (key == "confidence") symbol.uncertain = value != "high";
    if (key == "length") setTextLength(symbol, value);
    if (key == "where") restrictParameters(symbol, value);
    if (key == "raises") {
        symbol.raises = true;
        symbol.raisedErrors = std::string(value);
    }
    if (key == "traits")
        forEachPart(value, ' ', [&](std::string_view word) {
            if (const auto trait = valueOf(kTraitWords, word)) symbol.traits.add(*trait);
        });
    if (key == "deferred")
        if (DataSymbol* param = findParam(symbol, value)) param->deferred = true;
}

Meaning meaningOf(const DeclarationComment& comment) {
    return valueOf(kMeaningWords, comment.get("meaning")).value_or(Meaning::None);
}

TypeClass classOf(const DeclarationComment& comment) {
    return valueOf(kTypeClassWords, comment.get("class")).value_or(TypeClass::Plain);
}

} // namespace

void applyTypeAttributes(const SyntaxTree& tree, TypeSymbol& symbol) {
    const DeclarationComment comment = commentOf(tree, *symbol.decl);
    const TypeClass typeClass = classOf(comment);
    TypeKind& kind = symbol.type->kind;
    symbol.type->known = valueOf(kKnownTypeWords, comment.get("known")).value_or(KnownType::None);
    if (typeClass == TypeClass::NonValue) {
        kind = TypeKind::NonValue;
        for (const char digit : comment.get("bytes"))
            symbol.type->bytes = symbol.type->bytes * 10 + static_cast<uint32_t>(digit - '0');
    }
    if (typeClass == TypeClass::SemiValue) kind = TypeKind::SemiValue;
    if (typeClass == TypeClass::Pseudo) kind = TypeKind::AnyType;
    symbol.type->uncertain =
        kind == TypeKind::Record && !comment.get("option").empty() && comment.get("confidence") != "high";
}

void applyDataAttributes(const SyntaxTree& tree, DataSymbol& symbol) {
    const DeclarationComment comment = commentOf(tree, *symbol.decl);
    if (classOf(comment) == TypeClass::SystemVariable) symbol.storage = Storage::SystemVariable;
    symbol.meaning = meaningOf(comment);
    symbol.languageError =
        valueOf(kLanguageErrorWords, comment.get("raisedby")).value_or(LanguageError::None);
}

void applyRoutineAttributes(const SyntaxTree& tree, RoutineSymbol& symbol) {
    const DeclarationComment comment = commentOf(tree, *symbol.decl);
    for (const Attribute& attribute : comment.attributes)
        applyAttribute(symbol, attribute.key, attribute.value);
}

} // namespace rapid::sema
