// Declarations: types, data, routines, modules.

#include "tests/fuzz/program_maker.h"

#include <algorithm>
#include <cctype>

namespace rapid::fuzz {

namespace {

std::string folded(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
    return out;
}

Kind kindOf(const sema::Type& type) {
    switch (type.kind) {
    case sema::TypeKind::Num: return Kind::Num;
    case sema::TypeKind::Dnum: return Kind::Dnum;
    case sema::TypeKind::Bool: return Kind::Bool;
    case sema::TypeKind::String: return Kind::String;
    case sema::TypeKind::Record: return Kind::Record;
    case sema::TypeKind::SemiValue: return Kind::Signal;
    default: return Kind::Handle;
    }
}

/// Not called: they wait for people or other machines, end everything, or are generated in forms of their own.
bool isLeftOut(std::string_view folded) {
    constexpr std::string_view kBegins[] = {"ui",   "tpread", "socket",    "egm",      "rmq",
                                            "load", "unload", "startload", "waitload", "saveconf"};
    constexpr std::string_view kNames[] = {
        "present",    "dim",       "argname",          "raisetouser",    "waituntil",
        "connect",    "warmstart", "systemstopaction", "startmoveretry", "callbyvar",
        "skipwarn",   "save",      "erasemodule",      "waitsynctask",   "motionplannerno",
        "readanybin", "errraise",  "waitrob",          "exitcycle",      "stop"};
    for (const std::string_view begin : kBegins)
        if (folded.starts_with(begin)) return true;
    return std::find(std::begin(kNames), std::end(kNames), folded) != std::end(kNames);
}

} // namespace

// ---- Catalog ---------------------------------------------------------------------------------------------------------

Catalog::Catalog(const sema::CheckedProgram& library, bool (*implemented)(std::string_view name)) {
    for (const sema::Type* type : {library.num, library.dnum, library.boolean, library.string})
        add(*type);
    for (const sema::Module* module : library.predefinedModules)
        for (const sema::TypeSymbol* symbol : module->types)
            if (symbol->type->kind != sema::TypeKind::Switch && symbol->type->kind != sema::TypeKind::AnyType)
                add(*symbol->type);
    for (const sema::Module* module : library.predefinedModules) {
        for (const sema::DataSymbol* data : module->data)
            if (data->dataKind == syntax::DataKind::Const && !data->type.isArray() &&
                typeOf(*data->type.type))
                constants_[typeOf(*data->type.type)].push_back(data->name);
        for (const sema::RoutineSymbol* routine : module->routines) {
            const bool hasCode =
                !routine->native || !sema::hasCode(routine->role) || implemented(routine->name);
            if (!hasCode || isLeftOut(folded(routine->name))) continue;
            if (routine->routineKind == syntax::RoutineKind::Proc)
                procedures_.push_back(routine);
            else if (const TypeOf* result = typeOf(*routine->returnType.type))
                functions_[result].push_back(routine);
        }
    }
}

const TypeOf* Catalog::add(const sema::Type& type) {
    const auto known = byName_.find(folded(type.name));
    if (known != byName_.end()) return known->second;
    TypeOf made;
    made.name = type.name;
    made.kind = kindOf(type);
    made.isValue = made.kind != Kind::Handle && made.kind != Kind::Signal && !type.containsNonValue;
    for (const sema::Type::Component& part : type.base()->components)
        made.parts.emplace_back(part.name, add(*part.type));
    types_.push_back(std::move(made));
    return byName_[folded(type.name)] = &types_.back();
}

const TypeOf* Catalog::type(std::string_view name) const {
    const auto found = byName_.find(folded(name));
    return found == byName_.end() ? nullptr : found->second;
}

const TypeOf* Catalog::typeOf(const sema::Type& type) const {
    return this->type(type.name);
}

const std::vector<const sema::RoutineSymbol*>& Catalog::functions(const TypeOf& result) const {
    static const std::vector<const sema::RoutineSymbol*> none;
    const auto found = functions_.find(&result);
    return found == functions_.end() ? none : found->second;
}

const std::vector<std::string>& Catalog::constants(const TypeOf& type) const {
    static const std::vector<std::string> none;
    const auto found = constants_.find(&type);
    return found == constants_.end() ? none : found->second;
}

// ---- Program ---------------------------------------------------------------------------------------------------------

ProgramMaker::ProgramMaker(const Catalog& catalog, const uint8_t* data, size_t size)
    : catalog_(catalog), choose_(data, size) {}

MadeProgram ProgramMaker::make() {
    const size_t moduleCount = 1 + choose_.below(3);
    modules_.resize(moduleCount);
    made_.optimise = choose_.below(4) == 3;
    budget_ = 40 + static_cast<int>(choose_.below(250));
    makeTypes();
    makeData();
    makeSubs(0);
    const size_t own = subs_.size();
    for (size_t i = 0; i < own; ++i)
        writeSub(subs_[i], i);
    writeMain();
    made_.tasks.emplace_back();
    for (size_t i = 0; i < moduleCount; ++i)
        made_.tasks.back().push_back(makeModule(static_cast<int>(i)));
    if (choose_.chance(10)) {
        made_.tasks.push_back(
            {"MODULE Other\n  PERS num sharedNum:=1;\n  PROC main()\n    FOR i FROM 1 TO 3 DO\n"
             "      sharedNum:=sharedNum+1;\n      WaitTime 0.05;\n    ENDFOR\n"
             "  ENDPROC\nENDMODULE\n"});
    }
    return std::move(made_);
}

void ProgramMaker::makeTypes() {
    for (const char* name : {"num", "num", "num", "dnum", "bool", "bool", "string", "string", "pos", "orient",
                             "pose", "byte", "robtarget", "speeddata", "jointtarget", "tooldata", "errnum"})
        if (const TypeOf* type = catalog_.type(name)) types_.push_back(type);
    const size_t records = choose_.below(4);
    for (size_t i = 0; i < records; ++i) {
        TypeOf made;
        made.name = "rec" + std::to_string(i);
        made.kind = Kind::Record;
        modules_[0].types += "  RECORD " + made.name + "\n";
        const size_t parts = 1 + choose_.below(4);
        for (size_t k = 0; k < parts; ++k) {
            made.parts.emplace_back("c" + std::to_string(k), choose_.of(types_));
            modules_[0].types += "    " + made.parts.back().second->name + " c" + std::to_string(k) + ";\n";
        }
        modules_[0].types += "  ENDRECORD\n";
        ownTypes_.push_back(std::move(made));
        types_.push_back(&ownTypes_.back());
    }
}

const TypeOf* ProgramMaker::anyType(bool) {
    return choose_.of(types_);
}

Datum ProgramMaker::randomDatum(const std::string& prefix, bool param) {
    Datum datum;
    datum.name = prefix + std::to_string(names_++);
    datum.type = anyType();
    datum.rank = choose_.chance(30) ? 1 + static_cast<int>(choose_.below(3)) : 0;
    for (int k = 0; k < datum.rank; ++k)
        datum.dims[static_cast<size_t>(k)] = param ? 0 : 1 + static_cast<int>(choose_.below(3));
    return datum;
}

void ProgramMaker::makeData() {
    const size_t count = 3 + choose_.below(10);
    for (size_t i = 0; i < count; ++i) {
        Datum datum = randomDatum("g", false);
        constexpr Access kKinds[] = {Access::Var, Access::Var, Access::Pers, Access::Const};
        datum.access = kKinds[choose_.below(4)];
        const int module = static_cast<int>(choose_.below(modules_.size()));
        const std::string text = declare(datum); // refers to earlier constants alone
        modules_[static_cast<size_t>(module)].data += "  " + text + "\n";
        globals_.push_back(std::move(datum));
    }
    for (const char* name : {"num", "string", "bool"})
        global(*catalog_.type(name), 0, Access::Var);
}

std::string ProgramMaker::declare(const Datum& datum) {
    const char* word = datum.access == Access::Const  ? "CONST "
                       : datum.access == Access::Pers ? "PERS "
                                                      : "VAR ";
    std::string text = word + datum.type->name + " " + datum.name;
    if (datum.rank > 0) {
        text += "{";
        for (int k = 0; k < datum.rank; ++k)
            text += (k > 0 ? "," : "") + std::to_string(datum.dims[static_cast<size_t>(k)]);
        text += "}";
    }
    const bool needsValue = datum.access == Access::Const || datum.access == Access::Pers;
    if (datum.type->isValue && (needsValue || choose_.chance(50))) {
        constantOnly_ = true;
        text += ":=" + (datum.rank > 0 ? aggregate(*datum.type, datum.rank, datum.dims, 2)
                                       : literal(*datum.type, true));
        constantOnly_ = false;
    }
    return text + ";";
}

/// Data of the type that every routine sees; made when there is none.
const Datum& ProgramMaker::global(const TypeOf& type, int rank, Access access) {
    std::vector<const Datum*> fitting;
    for (const Datum& datum : globals_)
        if (datum.type == &type && datum.rank == rank && datum.access == access) fitting.push_back(&datum);
    if (!fitting.empty() && !choose_.chance(10)) return *choose_.of(fitting);
    Datum datum;
    datum.name = "x" + std::to_string(names_++);
    datum.type = &type;
    datum.rank = rank;
    datum.access = access;
    for (int k = 0; k < rank; ++k)
        datum.dims[static_cast<size_t>(k)] = 1 + static_cast<int>(choose_.below(3));
    modules_[0].data += "  " + declare(datum) + "\n";
    globals_.push_back(std::move(datum));
    return globals_.back();
}

void ProgramMaker::makeSubs(int) {
    const size_t count = 1 + choose_.below(6);
    for (size_t i = 0; i < count; ++i) {
        Sub sub;
        sub.name = "r" + std::to_string(i);
        sub.module = static_cast<int>(choose_.below(modules_.size()));
        sub.isLocal = modules_.size() == 1 && choose_.chance(20);
        if (choose_.chance(40)) sub.result = anyType();
        sub.isTrap = !sub.result && choose_.chance(10);
        const size_t params = sub.isTrap ? 0 : choose_.below(5);
        int group = 0;
        for (size_t k = 0; k < params; ++k) {
            Datum param = randomDatum("p", true);
            constexpr Access kModes[] = {Access::In,    Access::In,    Access::In,
                                         Access::ByVar, Access::Inout, Access::ByPers};
            param.access = kModes[choose_.below(6)];
            param.optional = choose_.chance(30);
            param.isSwitch = param.optional && choose_.chance(25);
            if (param.isSwitch) param.rank = 0;
            const bool joins =
                param.optional && !sub.params.empty() && sub.params.back().optional && choose_.chance(30);
            param.group = joins ? group : ++group;
            sub.params.push_back(std::move(param));
        }
        subs_.push_back(std::move(sub));
    }
}

std::string ProgramMaker::signature(const Sub& sub) {
    if (sub.isTrap) return "TRAP " + sub.name;
    std::string text = sub.isLocal ? "LOCAL " : "";
    text += sub.result ? "FUNC " + sub.result->name + " " + sub.name + "(" : "PROC " + sub.name + "(";
    int group = 0;
    for (size_t i = 0; i < sub.params.size(); ++i) {
        const Datum& param = sub.params[i];
        const bool joins = i > 0 && param.group == group;
        if (joins)
            text += " | ";
        else if (param.optional)
            text += " \\";
        else if (i > 0)
            text += ",";
        group = param.group;
        if (param.isSwitch) {
            text += "switch " + param.name;
            continue;
        }
        if (param.access == Access::ByVar) text += "VAR ";
        if (param.access == Access::Inout) text += "INOUT ";
        if (param.access == Access::ByPers) text += "PERS ";
        text += param.type->name + " " + param.name;
        constexpr const char* kRanks[] = {"", "{*}", "{*,*}", "{*,*,*}"};
        text += kRanks[param.rank];
    }
    return text + ")";
}

void ProgramMaker::writeSub(const Sub& sub, size_t number) {
    sub_ = &sub;
    subNumber_ = number;
    module_ = sub.module;
    locals_.clear();
    counters_.clear();
    body_.clear();
    for (const Datum& param : sub.params)
        locals_.push_back(param);
    std::string data;
    const size_t count = choose_.below(4);
    for (size_t i = 0; i < count; ++i) {
        Datum datum = randomDatum("l", false);
        datum.access = choose_.chance(20) ? Access::Const : Access::Var;
        data += "    " + declare(datum) + "\n";
        locals_.push_back(std::move(datum));
    }
    indent_ = 2;
    loopDepth_ = 0;
    part_ = Part::Body;
    // Calls in circles come to an end.
    if (number > 0 || true) {
        line("calls:=calls+1;");
        if (sub.result)
            line("IF calls>60 RETURN " + literal(*sub.result, true) + ";");
        else
            line("IF calls>60 RETURN;");
    }
    statements(1 + static_cast<int>(choose_.below(7)), 0);
    if (sub.result) line("RETURN " + expr(*sub.result, 3) + ";");
    std::string body = std::exchange(body_, {});
    const std::string rest = handlers(sub);
    const char* end = sub.isTrap ? "  ENDTRAP\n" : sub.result ? "  ENDFUNC\n" : "  ENDPROC\n";
    modules_[static_cast<size_t>(sub.module)].routines +=
        "  " + signature(sub) + "\n" + data + counters_ + body + rest + end;
}

std::string ProgramMaker::handlers(const Sub& sub) {
    std::string text;
    if (!sub.result && !sub.isTrap && choose_.chance(10)) {
        part_ = Part::Backward;
        statements(1, 2);
        text += "  BACKWARD\n" + std::exchange(body_, {});
    }
    if (choose_.chance(75)) {
        part_ = Part::Error;
        std::string head = "  ERROR\n";
        if (choose_.chance(20))
            head = choose_.chance(50) ? "  ERROR (ERR_DIVZERO,5)\n" : "  ERROR (LONG_JMP_ALL_ERR)\n";
        statements(static_cast<int>(choose_.below(3)), 2);
        line("tries:=tries+1;");
        line("IF tries>40 THEN");
        line(sub.result ? "  RETURN " + literal(*sub.result, true) + ";" : "  RETURN;");
        line("ENDIF");
        switch (choose_.below(6)) {
        case 0:
        case 1:
        case 2: line("TRYNEXT;"); break;
        case 3: line("IF tries<20 RETRY;"), line("TRYNEXT;"); break;
        case 4: line(sub.result ? "RETURN " + expr(*sub.result, 2) + ";" : "RETURN;"); break;
        default: line(choose_.chance(50) ? "RAISE;" : "RAISE 7;"); break;
        }
        text += head + std::exchange(body_, {});
    }
    if (!sub.isTrap && choose_.chance(15)) {
        part_ = Part::Undo;
        statements(1 + static_cast<int>(choose_.below(2)), 2);
        text += "  UNDO\n" + std::exchange(body_, {});
    }
    part_ = Part::Body;
    return text;
}

void ProgramMaker::dumpData(std::string& out) {
    for (const Datum& datum : globals_) {
        if (!datum.type->isValue || datum.access == Access::Const) continue;
        std::string element = datum.name;
        if (datum.rank > 0) {
            element += "{";
            for (int k = 0; k < datum.rank; ++k)
                element += (k > 0 ? "," : "") + std::to_string(1 + choose_.below(static_cast<size_t>(
                                                                       datum.dims[static_cast<size_t>(k)])));
            element += "}";
        }
        out += "    TPWrite \"" + datum.name + " \"+StrPart(ValToStr(" + element + ")+\"  \",1,2);\n";
        out += "    TPWrite ValToStr(" + element + ");\n";
    }
}

void ProgramMaker::writeMain() {
    Sub main;
    main.name = "main";
    sub_ = &main;
    subNumber_ = subs_.size();
    module_ = 0;
    locals_.clear();
    counters_.clear();
    body_.clear();
    indent_ = 2;
    statements(3 + static_cast<int>(choose_.below(8)), 0);
    for (size_t i = 0; i < subs_.size(); ++i) {
        const Sub& sub = subs_[i];
        if (sub.isTrap || (sub.isLocal && sub.module != 0)) continue;
        line("calls:=0;");
        if (sub.result)
            line(reference(*sub.result, 0, Access::Var, 1) + ":=" + sub.name + "(" + arguments(sub, 2) +
                 ");");
        else
            line(sub.name + " " + arguments(sub, 2) + ";");
    }
    std::string dump;
    dumpData(dump);
    modules_[0].routines +=
        "  PROC main()\n" + counters_ + body_ +
        "    show;\n  ERROR\n    tries:=tries+1;\n"
        "    IF tries>60 EXIT;\n    TPWrite \"error \"\\Num:=ERRNO;\n    TRYNEXT;\n  ENDPROC\n"
        "  PROC show()\n" +
        dump + "  ERROR\n    TRYNEXT;\n  ENDPROC\n";
}

std::string ProgramMaker::makeModule(int number) {
    const Text& text = modules_[static_cast<size_t>(number)];
    std::string module = "MODULE Mod" + std::to_string(number) + "\n" + text.types;
    if (number == 0) module += "  VAR num calls:=0;\n  VAR num tries:=0;\n  PERS num sharedNum:=1;\n";
    return module + text.data + text.routines + "ENDMODULE\n";
}

} // namespace rapid::fuzz
