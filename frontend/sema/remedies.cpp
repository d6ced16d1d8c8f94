// Proposals that make a value fit: the end of a message, and a replacement text.

#include "frontend/sema/remedies.h"
#include "frontend/sema/place.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

bool readsAsNumber(std::string_view text) {
    const bool digits =
        std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
    return digits && !text.empty() && text.size() < 12 && std::count(text.begin(), text.end(), '.') < 2 &&
           text.find_first_of("0123456789") != std::string_view::npos;
}

} // namespace

Remedies::Remedies(State& state, const Parts& parts) : CheckerPart(state), scopes_(parts.scopes) {}

// Predefined data that the number means: "100" for speeddata is v100.
std::string Remedies::namedByNumber(std::string_view number, const Type& want) {
    for (const char* letter : {"v", "z"}) {
        const DataSymbol* data = asData(at(state_.predefined, names_.intern(letter + std::string(number))));
        if (data && scopes_.lookup(data->nameId) == data && data->type.rank == 0 &&
            data->type.type->base() == want.base())
            return data->name;
    }
    return {};
}

/// All of it, for a fix; text() shortens.
std::string Remedies::written(const Expr& e) const {
    const SourceRange whole = range(e);
    return std::string(context_.tree->source->text().substr(whole.begin, whole.end - whole.begin));
}

/// For a message, which is one line.
std::string Remedies::inWords(const Expr& e) const {
    const bool line = written(e).find_first_of("\r\n") == std::string::npos;
    return line ? text(e) : "...";
}

Remedy Remedies::numberRemedy(const Expr& e, const DataType& found, const Type& want) {
    const bool literal = e.kind == NodeKind::NumLiteral;
    switch (want.kind) {
    case TypeKind::String:
        if (literal) return {": write a text between double quotes", '"' + written(e) + '"'};
        return {std::string(": make a text of the number with ") +
                    (found.type->kind == TypeKind::Dnum ? "DnumToStr" : "NumToStr"),
                ""};
    case TypeKind::Bool: {
        if (!literal) return {": compare it, as in " + inWords(e) + " <> 0", ""};
        const std::string value = as<NumLiteralExpr>(e).value == 0 ? "FALSE" : "TRUE";
        return {": write " + value, value};
    }
    case TypeKind::Record: {
        const std::string name = literal ? namedByNumber(text(e), want) : std::string();
        if (!name.empty()) return {didYouMean(name), name};
        break;
    }
    default: break;
    }
    return {};
}

// A record of which only a part is wanted, or a target of the other kind.
Remedy Remedies::recordRemedy(const Expr& e, const DataType& found, const DataType& want) {
    if (isKnown(*found.type, KnownType::Target) && isKnown(*want.type, KnownType::JointTarget))
        return {": CalcJointT gives the joint angles of a robtarget", ""};
    if (isKnown(*found.type, KnownType::JointTarget) && isKnown(*want.type, KnownType::Target))
        return {": CalcRobT gives the robtarget of joint angles", ""};
    const Type::Component* part = nullptr;
    for (const Type::Component& c : found.type->base()->components) {
        if (c.type->base() != want.type->base()) continue;
        if (part) return {};
        part = &c;
    }
    if (!part) return {};
    if (!isPlaceExpr(e)) return {": only its component '" + part->name + "' is one", ""};
    return {didYouMean(inWords(e) + "." + part->name), written(e) + "." + part->name};
}

/// How to make what was found what is wanted, if there is a usual way.
Remedy Remedies::remedyFor(const Expr& whole, const DataType& found, const DataType& want) {
    const Expr& e = bare(whole);
    if (!found.type || !want.type) return {};
    if (want.rank > 0) {
        const bool element = found.rank == 0 && found.type->base() == want.type->base();
        return {element ? ": it goes into one element, or each gets a value of its own" : "", ""};
    }
    if (found.rank > 0) {
        if (found.type->base() != want.type->base() || !isPlaceExpr(e)) return {};
        std::string index = "{1";
        for (uint8_t i = 1; i < found.rank; ++i)
            index += ",1";
        return {": choose an element, as in " + inWords(e) + index + "}", ""};
    }
    const TypeKind from = found.type->base()->kind, to = want.type->base()->kind;
    if (found.type->isNumeric()) {
        if (to == TypeKind::Num) return {": convert it with DnumToNum", ""};
        if (to == TypeKind::Dnum) return {": convert it with NumToDnum", ""};
        return numberRemedy(e, found, *want.type);
    }
    if (from == TypeKind::String && want.type->isNumeric()) {
        const bool literal = e.kind == NodeKind::StringLiteral;
        const std::string value = literal ? decodeStringLiteral(written(e)) : std::string();
        if (readsAsNumber(value)) return {": a number is written without quotes", value};
        return {": StrToVal reads a value from a text", ""};
    }
    if (from == TypeKind::Bool && want.type->isNumeric() && e.kind == NodeKind::BoolLiteral) {
        std::string value = as<BoolLiteralExpr>(e).value ? "1" : "0";
        return {": write " + value, value};
    }
    if (from == TypeKind::String && to == TypeKind::Bool) return {": StrToVal reads a value from a text", ""};
    if (e.kind == NodeKind::Component && found.rank == 0) { // "p10.trans" where "p10" would do
        const Expr& record = *as<ComponentExpr>(e).base;
        const DataType& base = info(record).type();
        if (base.rank == 0 && base.type && base.type->base() == want.type->base())
            return {didYouMean(inWords(record)), written(record)};
    }
    if (to == TypeKind::String && isValueType(*found.type)) return {": ValToStr makes a text of it", ""};
    return from == TypeKind::Record ? recordRemedy(e, found, want) : Remedy();
}

// For arguments, also another instruction of the same family: WaitDO for WaitDI, MoveAbsJ for MoveL.
Remedy Remedies::remedyFor(const RoutineSymbol& routine, const Expr& e, const DataType& found,
                           const DataSymbol& param) {
    const DataType& want = param.type;
    if (found.type && routine.predefined && found.rank == 0 && want.rank == 0) {
        const bool moves = routine.name.starts_with("Move");
        if (moves && isKnown(*found.type, KnownType::JointTarget) && isKnown(*want.type, KnownType::Target))
            return {": MoveAbsJ moves to a jointtarget", ""};
        if (moves && isKnown(*found.type, KnownType::Target) && isKnown(*want.type, KnownType::JointTarget))
            return {": MoveJ and MoveL move to a robtarget", ""};
        const Remedy sibling = signalRemedy(routine, found, want);
        if (!sibling.words.empty()) return sibling;
    }
    if (want.rank > 0 && found.rank == 0) return {};
    Remedy remedy = remedyFor(e, found, want);
    if (param.mode == ParamMode::In || param.mode == ParamMode::Ref) return remedy;
    // Parameters that pass data on take no value, and PERS and INOUT no part of a persistent.
    const bool part = isPlaceExpr(bare(e)) && (found.rank > 0 || !remedy.instead.empty());
    return part && param.mode == ParamMode::Var ? remedy : Remedy();
}

// "SetDO go1, 5;": what ends in the kind of the signal takes it.
Remedy Remedies::signalRemedy(const RoutineSymbol& routine, const DataType& found, const DataType& want) {
    constexpr std::string_view kSignal = "signal";
    const std::string_view have = found.type->base()->name, need = want.type->base()->name;
    if (found.type->kind != TypeKind::SemiValue || want.type->kind != TypeKind::SemiValue) return {};
    if (!have.starts_with(kSignal) || !need.starts_with(kSignal)) return {};
    const std::string kind = foldName(have.substr(kSignal.size())),
                      other = foldName(need.substr(kSignal.size()));
    const std::string folded = foldName(routine.name);
    const size_t where = folded.rfind(other);
    if (where == std::string::npos || other.size() != kind.size()) return {};
    const std::string name = folded.substr(0, where) + kind + folded.substr(where + other.size());
    const RoutineSymbol* sibling = asRoutine(at(state_.predefined, names_.intern(name)));
    if (sibling && sibling->routineKind == routine.routineKind)
        return {": " + sibling->name + " takes one", ""};
    const bool sets =
        folded.starts_with("set") || folded.starts_with("pulse") || folded.starts_with("invert");
    if (sets && kind.ends_with('i')) return {": an input cannot be set", ""};
    return {};
}

// A target cannot be displaced by an operator.
std::string targetRemedy(BinaryOp op, const DataType& operand) {
    const bool moves = op == BinaryOp::Add || op == BinaryOp::Sub;
    return moves && isKnown(*operand.type, KnownType::Target)
               ? ": Offs and RelTool give a robtarget that is moved"
               : "";
}

std::string operatorRemedy(BinaryOp op, Typed left, Typed right) {
    const bool texts[] = {left.isScalar(TypeKind::String), right.isScalar(TypeKind::String)};
    if (texts[0] && texts[1])
        return op >= BinaryOp::Lt && op <= BinaryOp::Ge ? ": compare texts by StrOrder" : "";
    if (!texts[0] && !texts[1]) return targetRemedy(op, left.info->type());
    if (op != BinaryOp::Add) return {};
    const Typed other = texts[0] ? right : left;
    if (other.isScalar(TypeKind::Num)) return ": make a text of the number with NumToStr";
    if (other.isScalar(TypeKind::Dnum)) return ": make a text of the number with DnumToStr";
    return ": make a text of the value with ValToStr";
}

void Remedies::offer(diag::Diagnostic& diagnostic, const Expr& e, const Remedy& remedy) {
    diagnostic.message += remedy.words;
    if (!remedy.instead.empty()) diagnostic.fix(range(e), remedy.instead, false);
}

// "TPWrite text, n;" for "TPWrite text, \Num:=n;": the optional parameter that a value without a place was meant for.
std::string Remedies::optionalFor(const RoutineSymbol& routine, const Expr& e) {
    if (e.kind != NodeKind::Name || !isName(as<NameExpr>(e).name)) return {};
    return optionalFor(routine, idOf(as<NameExpr>(e).name));
}

std::string Remedies::optionalFor(const RoutineSymbol& routine, NameId name) {
    const DataSymbol* data = asData(scopes_.lookup(name));
    if (!data || !data->type.type) return {};
    for (const DataSymbol* param : routine.params) {
        if (!param->optional || param->isSwitch || !param->type.type) continue;
        if (equivalent(data->type, param->type)) return "\\" + param->name + ":=";
    }
    return {};
}

void Remedies::fixCall(diag::Diagnostic& diagnostic, const Expr& e, const std::string& name, bool certain) {
    const SourceRange whole = range(e);
    const Symbol* function = scopes_.lookup(names_.intern(name));
    if (!function || !function->predefined) return; // a name of the program hides it
    diagnostic.fixes.push_back({"write " + name + "(...)",
                                {{{whole.begin, whole.begin}, name + "("}, {{whole.end, whole.end}, ")"}},
                                certain});
}

std::string numDnumRemedy(Typed t, const DataType& want) {
    if (t.info->type().rank > 0 || want.rank > 0) return {};
    if (t.info->type().type->kind == TypeKind::Num && want.type->kind == TypeKind::Dnum) return "NumToDnum";
    if (t.info->type().type->kind == TypeKind::Dnum && want.type->kind == TypeKind::Num) return "DnumToNum";
    return {};
}

} // namespace rapid::sema
