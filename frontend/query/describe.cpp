#include "frontend/query/describe.h"

#include "frontend/syntax/tree_walk.h"

#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

std::string typeText(const DataType& type) {
    if (!type.type) return "?";
    std::string text = type.type->name.empty() ? "?" : type.type->name;
    if (!type.isArray()) return text;
    text += '{';
    for (int i = 0; i < type.rank && i < 3; ++i) {
        if (i) text += ',';
        text += type.dims[i] > 0 ? std::to_string(type.dims[i]) : "*";
    }
    return text + '}';
}

namespace {

std::string_view word(DataKind kind) {
    switch (kind) {
    case DataKind::Pers: return "PERS ";
    case DataKind::Const: return "CONST ";
    case DataKind::Var: break;
    }
    return "VAR ";
}

std::string_view word(ParamMode mode) {
    switch (mode) {
    case ParamMode::Var: return "VAR ";
    case ParamMode::Pers: return "PERS ";
    case ParamMode::Inout: return "INOUT ";
    case ParamMode::Ref: return "REF ";
    case ParamMode::In: break;
    }
    return "";
}

/// The name of a type; of an unknown one the word in the declaration.
std::string nameOf(const Type* type, const Symbol& symbol, TokenIndex word) {
    if (type && type->kind != TypeKind::Error && !type->name.empty()) return type->name;
    const bool written = word != kNoToken && symbol.module && symbol.module->tree;
    return written ? std::string(symbol.module->tree->text(word)) : "?";
}

/// The type without dimensions, and these.
std::pair<std::string, std::string> parts(const DataType& type, const Symbol& symbol) {
    DataType element = type;
    element.rank = 0;
    return {nameOf(type.type, symbol, symbol.decl ? typeTokenOf(*symbol.decl) : kNoToken),
            typeText(type).substr(typeText(element).size())};
}

std::string typeDeclaration(const TypeSymbol& symbol) {
    const Type* type = symbol.type;
    const std::string local = symbol.isLocal ? "LOCAL " : "";
    if (!type) return local + "RECORD " + symbol.name;
    if (type->aliasOf) return fmt::format("{}ALIAS {} {}", local, type->aliasOf->name, symbol.name);
    if (type->kind != TypeKind::Record || type->components.empty())
        return symbol.predefined ? symbol.name : local + "RECORD " + symbol.name;
    std::string text = local + "RECORD " + symbol.name;
    const auto* decl =
        symbol.decl && symbol.decl->kind == NodeKind::Record ? &as<RecordDecl>(*symbol.decl) : nullptr;
    for (size_t i = 0; i < type->components.size(); ++i) {
        const Type::Component& component = type->components[i];
        const TokenIndex word = decl && i < decl->components.size() ? decl->components[i]->type : kNoToken;
        text += fmt::format("\n   {} {};", nameOf(component.type, symbol, word), component.name);
    }
    return text + "\nENDRECORD";
}

std::string dataDeclaration(const DataSymbol& data) {
    const auto [type, dims] = parts(data.type, data);
    switch (data.storage) {
    case Storage::Parameter: return parameterText(data);
    case Storage::LoopVariable:
    case Storage::Signal:
    case Storage::SystemVariable:
        return fmt::format("{}{} {}", data.storage == Storage::Signal ? "" : "VAR ", type, data.name);
    case Storage::ModuleData:
    case Storage::RoutineData: break;
    }
    const std::string_view scope = data.isLocal ? "LOCAL " : data.scope == ScopeWord::Task ? "TASK " : "";
    return fmt::format("{}{}{} {}{}", scope, word(data.dataKind), type, data.name, dims);
}

} // namespace

std::string parameterText(const DataSymbol& parameter) {
    if (parameter.isSwitch) return (parameter.optional ? "\\switch " : "switch ") + parameter.name;
    auto [type, dims] = parts(parameter.type, parameter);
    return fmt::format("{}{}{} {}{}", parameter.optional ? "\\" : "", word(parameter.mode), type,
                       parameter.name, dims);
}

RoutineLabel routineLabel(const RoutineSymbol& routine) {
    RoutineLabel label;
    std::string& text = label.text;
    if (routine.isLocal) text = "LOCAL ";
    switch (routine.routineKind) {
    case RoutineKind::Trap: text += "TRAP " + routine.name; return label;
    case RoutineKind::Func: {
        const auto [type, dims] = parts(routine.returnType, routine);
        text += fmt::format("FUNC {}{} {}", type, dims, routine.name);
        break;
    }
    case RoutineKind::Proc: text += "PROC " + routine.name; break;
    }
    text += '(';
    const DataSymbol* before = nullptr;
    for (const DataSymbol* parameter : routine.params) {
        const bool alternative = before && (before->optional || parameter->requiredAlternative) &&
                                 parameter->optional == before->optional && parameter->group == before->group;
        std::string own = parameterText(*parameter);
        if (alternative) {
            text += " | ";
            if (own.starts_with('\\')) own.erase(0, 1);
        } else if (before && !parameter->optional) {
            text += ',';
        }
        label.parameters.push_back(
            {parameter, static_cast<uint32_t>(text.size()), static_cast<uint32_t>(text.size() + own.size())});
        text += own;
        before = parameter;
    }
    text += ')';
    return label;
}

std::string declarationText(const Snapshot&, const Symbol& symbol) {
    switch (symbol.kind) {
    case SymbolKind::Type: return typeDeclaration(static_cast<const TypeSymbol&>(symbol));
    case SymbolKind::Data: return dataDeclaration(static_cast<const DataSymbol&>(symbol));
    case SymbolKind::Routine: return routineLabel(static_cast<const RoutineSymbol&>(symbol)).text;
    case SymbolKind::Label: return symbol.name + ":";
    case SymbolKind::Module: break;
    }
    return "MODULE " + symbol.name;
}

std::string declarationText(const Snapshot& snapshot, const Meaning& meaning) {
    if (meaning.symbol) return declarationText(snapshot, *meaning.symbol);
    if (meaning.module) {
        static constexpr std::string_view kWords[] = {"SYSMODULE", "NOVIEW", "NOSTEPIN", "VIEWONLY",
                                                      "READONLY"};
        std::string attributes;
        for (size_t i = 0; i < std::size(kWords); ++i)
            if (meaning.module->decl && meaning.module->decl->attributes >> i & 1U)
                attributes += (attributes.empty() ? "" : ",") + std::string(kWords[i]);
        return "MODULE " + meaning.module->name + (attributes.empty() ? "" : "(" + attributes + ")");
    }
    if (!meaning.record) return {};
    const Type::Component& component = meaning.record->components[static_cast<size_t>(meaning.component)];
    return fmt::format("{} {}.{}", component.type ? component.type->name : "?", meaning.record->name,
                       component.name);
}

} // namespace rapid::query
