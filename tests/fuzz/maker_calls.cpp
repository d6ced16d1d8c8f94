// Calls: of routines of the program, of built-ins with arguments that fit their declarations, by name.

#include "tests/fuzz/program_maker.h"
#include "tests/fuzz/program_runner.h"

#include <algorithm>

namespace rapid::fuzz {

/// Data to be passed by reference.
std::string ProgramMaker::reference(const TypeOf& type, int rank, Access access, int depth) {
    const bool whole = access == Access::ByPers || access == Access::Pers;
    std::vector<const Datum*> fitting;
    for (const Datum& datum : locals_) {
        if (datum.type != &type || datum.rank != rank || datum.isSwitch || datum.optional) continue;
        const bool pers = datum.access == Access::ByPers;
        const bool variable = datum.access == Access::Var || datum.access == Access::ByVar;
        if (whole                     ? pers
            : access == Access::Inout ? variable || pers || datum.access == Access::Inout
                                      : variable)
            fitting.push_back(&datum);
    }
    if (!fitting.empty() && choose_.chance(60)) return choose_.of(fitting)->name;
    if (!whole && rank == 0 && depth > 0 && choose_.chance(30)) {
        std::vector<const Datum*> arrays; // an element
        for (const Datum& datum : globals_)
            if (datum.type == &type && datum.rank > 0 && datum.access == Access::Var)
                arrays.push_back(&datum);
        if (!arrays.empty()) {
            const Datum& array = *choose_.of(arrays);
            return array.name + index(array, depth - 1);
        }
    }
    return global(type, rank, whole ? Access::Pers : Access::Var).name;
}

std::string ProgramMaker::argument(const Datum& param, int depth) {
    if (param.access != Access::In) return reference(*param.type, param.rank, param.access, depth);
    if (param.rank == 0) return expr(*param.type, depth);
    return arrayValue(*param.type, param.rank, param.dims, depth);
}

std::string ProgramMaker::arguments(const Sub& sub, int depth) {
    std::string text;
    bool first = true;
    int given = -1; // group
    for (const Datum& param : sub.params) {
        if (param.optional) {
            // Passed on from an optional parameter of the caller.
            for (const Datum& own : locals_)
                if (own.optional && own.type == param.type && own.rank == param.rank &&
                    own.isSwitch == param.isSwitch && own.access == param.access && param.group != given &&
                    choose_.chance(40)) {
                    text += "\\" + param.name + "?" + own.name;
                    given = param.group;
                    break;
                }
            if (param.group == given || !choose_.chance(40)) continue;
            given = param.group;
            text += "\\" + param.name;
            if (!param.isSwitch) text += ":=" + argument(param, depth);
            continue;
        }
        if (!first || !text.empty()) text += ",";
        first = false;
        if (choose_.chance(10)) text += param.name + ":=";
        text += argument(param, depth);
    }
    return text;
}

std::string ProgramMaker::anyArgument(const sema::DataSymbol& param, int depth, bool& possible) {
    using sema::ParamClass;
    const bool array = param.accepts == ParamClass::Array;
    const bool number = param.accepts == ParamClass::Numeric;
    const bool atomic = number || param.accepts == ParamClass::Atomic;
    if (param.accepts == ParamClass::Signal || param.accepts == ParamClass::SignalOrString) return "do1";
    for (int attempt = 0; attempt < 5; ++attempt) {
        const TypeOf& type = *choose_.of(types_);
        if (atomic && type.kind == Kind::Record) continue;
        if (number && type.kind != Kind::Num && type.kind != Kind::Dnum) continue;
        const int rank = array ? 1 : 0;
        const bool isPers = param.mode == syntax::ParamMode::Pers;
        return reference(type, rank, isPers ? Access::ByPers : Access::ByVar, depth);
    }
    possible = false;
    return "";
}

std::string ProgramMaker::builtInArgument(const sema::DataSymbol& param, int depth, bool& possible) {
    using syntax::ParamMode;
    if (param.type.type->kind == sema::TypeKind::AnyType) return anyArgument(param, depth, possible);
    const TypeOf* type = catalog_.typeOf(*param.type.type);
    if (!type) {
        possible = false;
        return "";
    }
    if (type->kind == Kind::Signal) return type->name.substr(6) + std::to_string(1 + choose_.below(2));
    if (type->name == "mecunit") return "ROB_1";
    if (type->name == "taskid") return "T_ROB1Id";
    const int rank = param.type.rank;
    if (param.mode == ParamMode::Pers) return reference(*type, rank, Access::ByPers, depth);
    if (param.mode != ParamMode::In || type->kind == Kind::Handle || !type->isValue)
        return reference(*type, rank, Access::ByVar, depth);
    if (rank > 0) return arrayValue(*type, rank, {}, depth);
    return expr(*type, depth);
}

std::string ProgramMaker::builtInCall(const sema::RoutineSymbol& routine, int depth, bool& possible) {
    if (dependsOnWallTime(routine.name)) made_.hasTime = true;
    std::string text;
    bool anyRequired = false;
    uint32_t given = UINT32_MAX;
    for (const sema::DataSymbol* param : routine.params) {
        if (param->group == given) continue;
        if (param->optional) {
            if (!choose_.chance(20)) continue;
            given = param->group;
            text += "\\" + param->name;
            if (!param->isSwitch) text += ":=" + builtInArgument(*param, depth, possible);
            continue;
        }
        if (param->requiredAlternative) {
            const bool last =
                param == routine.params.back() || routine.params[param->index + 1]->group != param->group;
            if (!last && choose_.chance(50)) continue;
            given = param->group;
        }
        if (anyRequired || !text.empty()) text += ",";
        anyRequired = true;
        text += builtInArgument(*param, depth, possible);
    }
    return text;
}

std::string ProgramMaker::functionCall(const TypeOf& type, int depth) {
    if (constantOnly_ || part_ == Part::Undo) return "";
    if (choose_.chance(40)) {
        std::vector<const Sub*> fitting;
        for (const Sub& sub : subs_)
            if (sub.result == &type && (!sub.isLocal || sub.module == module_)) fitting.push_back(&sub);
        if (!fitting.empty()) {
            const Sub& sub = *choose_.of(fitting);
            return sub.name + "(" + arguments(sub, depth) + ")";
        }
    }
    const auto& functions = catalog_.functions(type);
    if (functions.empty()) return "";
    const sema::RoutineSymbol& routine = *choose_.of(functions);
    bool possible = true;
    const std::string args = builtInCall(routine, depth, possible);
    return possible ? routine.name + "(" + args + ")" : "";
}

std::string ProgramMaker::procedureCall() {
    if (choose_.chance(45)) {
        std::vector<const Sub*> fitting;
        for (const Sub& sub : subs_)
            if (!sub.result && !sub.isTrap && (!sub.isLocal || sub.module == module_))
                fitting.push_back(&sub);
        if (!fitting.empty()) {
            const Sub& sub = *choose_.of(fitting);
            return sub.name + " " + arguments(sub, 2) + ";";
        }
    }
    const sema::RoutineSymbol& routine = *choose_.of(catalog_.procedures());
    if (routine.flow != sema::Flow::Continues && !choose_.chance(20)) return "";
    if (part_ == Part::Undo && routine.effects != sema::Effects::Pure) return "";
    if (routine.flow == sema::Flow::Retries) return "";
    bool possible = true;
    const std::string args = builtInCall(routine, 2, possible);
    return possible ? routine.name + " " + args + ";" : "";
}

std::string ProgramMaker::lateCall() {
    std::vector<const Sub*> fitting;
    for (const Sub& sub : subs_)
        if (!sub.result && !sub.isTrap && !sub.isLocal) fitting.push_back(&sub);
    if (fitting.empty() || choose_.chance(10)) return "%\"nowhere\"%;";
    const Sub& sub = *choose_.of(fitting);
    for (const Datum& param : sub.params)
        if (param.type->kind == Kind::Record && param.access == Access::In) return "%\"" + sub.name + "\"%;";
    return "%\"" + sub.name + "\"% " + arguments(sub, 2) + ";";
}

} // namespace rapid::fuzz
