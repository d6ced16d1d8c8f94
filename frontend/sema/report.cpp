// Wording of diagnostics: names of types and things, places of declarations.

#include "frontend/sema/analysis.h"

#include <fmt/format.h>

#include <algorithm>

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
    if (muted_ || isUnclear(where)) return unsaid_ = diag::Diagnostic();
    return (collect_ ? *collect_ : sink_).report(code, context_.tree->source, where, args);
}

/// In a line that could not be read as a whole: what seems wrong there follows from that.
bool Analyzer::isUnclear(SourceRange where) const {
    if (where.begin < quietLine_.end && where.begin >= quietLine_.begin) return true;
    const std::vector<uint32_t>& lines = context_.tree->unclearLines;
    if (lines.empty()) return false;
    const auto after = std::upper_bound(lines.begin(), lines.end(), where.begin);
    if (after == lines.begin()) return false;
    const uint32_t begin = *(after - 1);
    if (where.begin - begin > SyntaxTree::kUnclearReach) return false;
    const std::string_view between = context_.tree->source->text().substr(begin, where.begin - begin);
    return between.find_first_of("\r\n") == std::string_view::npos;
}

bool Analyzer::hasUnclearLine(const Node& node) const {
    const std::vector<uint32_t>& lines = context_.tree->unclearLines;
    const SourceRange whole = range(node);
    const auto line = std::lower_bound(lines.begin(), lines.end(), whole.begin);
    return line != lines.end() && *line < whole.end;
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

std::string Analyzer::valueText(const Expr& e) {
    const ConstValue* value = info(e).constant;
    const Expr& inner = e.kind == NodeKind::Unary ? *as<UnaryExpr>(e).operand : e;
    if (inner.kind == NodeKind::NumLiteral || !value || value->kind != ConstValue::Kind::Number)
        return text(e);
    return fmt::format("{} = {}", text(e), value->number);
}

/// "cell:" for a type that module "cell" declares, nothing for a predefined one.
static std::string moduleOf(const Type& type) {
    return type.module && !type.module->predefined ? type.module->name + ":" : std::string();
}

std::array<std::string, 2> Analyzer::typeNames(const DataType& found, const DataType& wanted) {
    std::array<std::string, 2> names = {typeName(found), typeName(wanted)};
    if (foldName(names[0]) != foldName(names[1])) return names;
    return {moduleOf(*found.type) + names[0], moduleOf(*wanted.type) + names[1]};
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
    if (symbol.kind == SymbolKind::Data) {
        const auto& data = static_cast<const DataSymbol&>(symbol);
        if (data.assumed) return false; // nothing declares it
        return wanted == Wanted::Data || (wanted == Wanted::Signal && data.storage == Storage::Signal);
    }
    if (symbol.kind == SymbolKind::Type) {
        const Type* type = static_cast<const TypeSymbol&>(symbol).type; // null: not resolved yet
        return wanted == Wanted::Type && (!type || isReal(*type));
    }
    if (symbol.kind != SymbolKind::Routine) return false;
    switch (static_cast<const RoutineSymbol&>(symbol).routineKind) {
    case RoutineKind::Proc: return wanted == Wanted::Procedure;
    case RoutineKind::Func: return wanted == Wanted::Function;
    case RoutineKind::Trap: return wanted == Wanted::Trap;
    }
    return false;
}

void Analyzer::fixCall(diag::Diagnostic& diagnostic, const Expr& e, const std::string& name, bool certain) {
    const SourceRange whole = range(e);
    const Symbol* function = lookup(interner_.intern(name));
    if (!function || !function->predefined) return; // a name of the program hides it
    diagnostic.fixes.push_back({"write " + name + "(...)",
                                {{{whole.begin, whole.begin}, name + "("}, {{whole.end, whole.end}, ")"}},
                                certain});
}

/// "1 member", "3 members"
std::string Analyzer::counted(size_t count, std::string_view noun, std::string_view plural) {
    const std::string many = plural.empty() ? std::string(noun) + "s" : std::string(plural);
    return std::to_string(count) + " " + (count == 1 ? std::string(noun) : many);
}

} // namespace rapid::sema
