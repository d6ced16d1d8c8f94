// Wording of diagnostics: names of types and things, places of declarations, suggestions.

#include "frontend/sema/analysis.h"

namespace rapid::sema {

using namespace syntax;

std::string Analyzer::text(const Node& node) const {
    const SourceRange r = range(node);
    constexpr uint32_t kLongest = 40;
    if (r.end - r.begin <= kLongest)
        return std::string(context_.tree->source->text().substr(r.begin, r.end - r.begin));
    const std::string_view all = context_.tree->source->text();
    uint32_t end = r.begin + kLongest - 3;
    while (end > r.begin && (static_cast<unsigned char>(all[end]) & 0xC0) == 0x80)
        --end; // not inside a character
    return std::string(all.substr(r.begin, end - r.begin)) + "...";
}

diag::Diagnostic& Analyzer::report(Code code, SourceRange where, std::initializer_list<std::string> args) {
    return sink_.report(code, context_.tree->source, where, args);
}

void Analyzer::noteDeclared(diag::Diagnostic& diagnostic, const Symbol& symbol) {
    if (symbol.predefined || !symbol.decl || symbol.nameToken == kNoToken) return;
    const SyntaxTree& tree = *symbol.module->tree;
    diagnostic.notes.push_back(
        {tree.source, tree.range(symbol.nameToken), "'" + symbol.name + "' is declared here"});
}

std::string Analyzer::typeName(const DataType& type) {
    std::string name = type.type ? type.type->name : "?";
    if (type.rank == 0) return name;
    name += '{';
    for (int i = 0; i < type.rank; ++i) {
        if (i > 0) name += ',';
        name += type.dims[i] > 0 ? std::to_string(type.dims[i]) : "*";
    }
    return name + '}';
}

std::string Analyzer::describe(const Symbol& symbol) {
    switch (symbol.kind) {
    case SymbolKind::Type: return "a data type";
    case SymbolKind::Module: return "a module";
    case SymbolKind::Label: return "a label";
    case SymbolKind::Routine: {
        const auto kind = static_cast<const RoutineSymbol&>(symbol).routineKind;
        return kind == RoutineKind::Proc   ? "a procedure"
               : kind == RoutineKind::Func ? "a function"
                                           : "a trap routine";
    }
    case SymbolKind::Data: break;
    }
    const auto& data = static_cast<const DataSymbol&>(symbol);
    switch (data.storage) {
    case Storage::Signal:
        return data.type.type->kind == TypeKind::SemiValue ? "a signal" : "a configured object";
    case Storage::SystemVariable: return "a system variable";
    case Storage::LoopVariable: return "a loop variable";
    case Storage::Parameter: return "a parameter";
    case Storage::ModuleData:
    case Storage::RoutineData: break;
    }
    return data.dataKind == DataKind::Const  ? "a constant"
           : data.dataKind == DataKind::Pers ? "a persistent"
                                             : "a variable";
}

bool Analyzer::isWanted(const Symbol& symbol, Wanted wanted) const {
    if (symbol.kind == SymbolKind::Data) return wanted == Wanted::Data;
    if (symbol.kind == SymbolKind::Type)
        return wanted == Wanted::Type && isReal(*static_cast<const TypeSymbol&>(symbol).type);
    if (symbol.kind != SymbolKind::Routine) return false;
    switch (static_cast<const RoutineSymbol&>(symbol).routineKind) {
    case RoutineKind::Proc: return wanted == Wanted::Procedure;
    case RoutineKind::Func: return wanted == Wanted::Function;
    case RoutineKind::Trap: return wanted == Wanted::Trap;
    }
    return false;
}

std::string Analyzer::suggestion(NameId name, Wanted wanted) {
    if (suggestionsLeft_ == 0) return {};
    --suggestionsLeft_;
    const std::string_view written = interner_.folded(name);
    unsigned limit = suggestionLimit(written.size());
    const Symbol* best = nullptr;
    const auto consider = [&](const Symbol* symbol) {
        if (!symbol || symbol->nameId == name || symbol->name.empty() || !isWanted(*symbol, wanted)) return;
        const unsigned distance = editDistance(written, interner_.folded(symbol->nameId), limit);
        if (distance > limit || (best && distance == limit)) return;
        best = symbol;
        limit = distance;
    };
    // The nearest scope first: on equal distance the earlier candidate wins.
    if (context_.routine)
        for (const NameId id : declaredInRoutine_)
            consider(at(routineNames_, id));
    scopes_[context_.module->id]->names.forEach([&](NameId, const Symbol* symbol) { consider(symbol); });
    for (const Symbol* symbol : globals_)
        consider(symbol);
    for (const DataSymbol* symbol : configured_)
        consider(symbol);
    for (const Symbol* symbol : predefined_)
        consider(symbol);
    // A name of one or two letters is near to everything of that length.
    if (!best || limit >= written.size()) return {};
    return "; did you mean '" + best->name + "'?";
}

std::string Analyzer::bestComponent(const Type& record, std::string_view name) {
    unsigned limit = suggestionLimit(name.size());
    const Type::Component* best = nullptr;
    for (const Type::Component& c : record.base()->components) {
        const unsigned distance = editDistance(name, c.name, limit);
        if (distance > limit || (best && distance == limit)) continue;
        best = &c;
        limit = distance;
    }
    return best && limit < name.size() ? "; did you mean '" + best->name + "'?" : std::string();
}

} // namespace rapid::sema
