// Wording of diagnostics: names of types and things.

#include "frontend/sema/wording.h"

#include "frontend/sema/names.h"

namespace rapid::sema {

using namespace syntax;

std::string typeName(const DataType& type) {
    std::string name = type.type ? type.type->name : "?";
    if (type.rank == 0) return name;
    name += '{';
    for (int i = 0; i < type.rank; ++i) {
        if (i > 0) name += ',';
        name += type.dims[i] > 0 ? std::to_string(type.dims[i]) : "*";
    }
    return name + '}';
}

/// "cell:" for a type that module "cell" declares, nothing for a predefined one.
static std::string moduleOf(const Type& type) {
    return type.module && !type.module->predefined ? type.module->name + ":" : std::string();
}

std::array<std::string, 2> typeNames(const DataType& found, const DataType& wanted) {
    std::array<std::string, 2> names = {typeName(found), typeName(wanted)};
    if (foldName(names[0]) != foldName(names[1])) return names;
    return {moduleOf(*found.type) + names[0], moduleOf(*wanted.type) + names[1]};
}

std::string describe(const Symbol& symbol) {
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

/// "1 member", "3 members"
std::string counted(size_t count, std::string_view noun, std::string_view plural) {
    const std::string many = plural.empty() ? std::string(noun) + "s" : std::string(plural);
    return std::to_string(count) + " " + (count == 1 ? std::string(noun) : many);
}

std::string didYouMean(std::string_view name) {
    return "; did you mean '" + std::string(name) + "'?";
}

std::string describeExpr(const Expr& e) {
    switch (e.kind) {
    case NodeKind::NumLiteral:
    case NodeKind::StringLiteral:
    case NodeKind::BoolLiteral: return "a literal";
    case NodeKind::Call: return "a function call";
    case NodeKind::Aggregate: return "an aggregate";
    case NodeKind::Paren: return "an expression in parentheses";
    case NodeKind::Binary: {
        const BinaryOp op = as<BinaryExpr>(e).op;
        return op >= BinaryOp::Lt && op <= BinaryOp::Ge ? "a comparison" : "an expression";
    }
    default: return "an expression";
    }
}

} // namespace rapid::sema
