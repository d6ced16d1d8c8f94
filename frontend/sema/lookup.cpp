// What a name means: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2). Signals that
// nobody declares are part of the controller's configuration and are recognised by how they are used.

#include "frontend/sema/analysis.h"

#include <cctype>

namespace rapid::sema {

using namespace syntax;

namespace {
/// di1, doGrip, gi_part: the usual way to name signals. Only used to word a remedy.
bool looksLikeSignal(std::string_view name) {
    static constexpr std::string_view kPrefixes[] = {"di", "do", "gi", "go", "ai", "ao"};
    for (const std::string_view prefix : kPrefixes)
        if (name.starts_with(prefix) && name.size() > 2) return true;
    return false;
}

/// The part of a name that tells the kind of a signal: all of diStart, what follows in PLC_di_Start and sdoStart, the end
/// of Part_Gi.
std::string_view kindOnwards(std::string_view name) {
    static constexpr std::string_view kKinds[] = {"di", "do", "gi", "go", "ai", "ao"};
    const std::string folded = foldName(name);
    const std::string_view text = folded;
    for (const std::string_view kind : kKinds) {
        if (name.size() > 3 && name[0] == 's' && name.substr(1).starts_with(kind)) return name.substr(1);
        const std::string part = "_" + std::string(kind) + "_";
        if (const size_t at = text.find(part); at != std::string_view::npos && at > 0)
            return name.substr(at + 1);
        const bool isWord = name.ends_with("_do") || name.ends_with("_go"); // to_do, let_go
        if (text.size() > 3 && text.ends_with(part.substr(0, 3)) && !isWord)
            return name.substr(name.size() - 2);
    }
    return name;
}

/// The type of a signal by the habit of naming them: diStart, DO_Clamp, gi1, PLC_do_Ready, sdoArcOn. Empty: the name has
/// another form.
std::string_view signalTypeByName(std::string_view name) {
    const std::string_view whole = name;
    name = kindOnwards(whole);
    const bool isEnd = name.size() == 2 && whole.size() > 3;
    if (name.size() < 3 && !isEnd) return {};
    const auto lower = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
    const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const bool marked =
        isEnd || name[2] == '_' || isDigit(name[2]) || (isUpper(name[2]) && !isUpper(name[1]));
    if (!marked) return {};
    static constexpr std::string_view kTypes[] = {"signaldi", "signaldo", "signalgi",
                                                  "signalgo", "signalai", "signalao"};
    for (const std::string_view type : kTypes)
        if (lower(name[0]) == type[6] && lower(name[1]) == type[7]) return type;
    return {};
}
} // namespace

Symbol* Analyzer::lookup(NameId name) const {
    if (context_.routine)
        if (Symbol* found = at(routineNames_, name)) return found;
    return lookupOutside(name);
}

Symbol* Analyzer::lookupOutside(NameId name) const {
    if (Symbol* found = scopes_[context_.module->id]->names.find(name)) return found;
    if (!context_.module->predefined) {
        if (Symbol* found = at(globals_, name)) return found;
        if (DataSymbol* found = at(configured_, name)) return found;
    }
    return at(predefined_, name);
}

DataSymbol* Analyzer::configuredObject(NameId name, std::string spelling, const Type* type, bool assumed) {
    DataSymbol* spare = nullptr;
    if (assumed && !spareAssumed_.empty()) {
        spare = spareAssumed_.back();
        spareAssumed_.pop_back();
        spare->reset();
    }
    DataSymbol& symbol = spare ? *spare : program_.dataSymbols.emplace_back();
    symbol.assumed = assumed;
    if (assumed) assumed_.push_back(&symbol);
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.name = std::move(spelling);
    symbol.nameId = name;
    symbol.storage = Storage::Signal;
    symbol.type.type = type;
    put(configured_, name, &symbol);
    return &symbol;
}

void Analyzer::declareConfiguration() {
    for (const SignalInfo& signal : options_.signals) {
        const TypeSymbol* type = asType(at(predefined_, interner_.intern(signal.type)));
        if (type) configuredObject(interner_.intern(signal.name), signal.name, type->type, false);
    }
    // Each task has an identity, and the robot of the first motion task is always there.
    const auto declare = [&](const std::string& name, const char* typeName) {
        const TypeSymbol* type = asType(at(predefined_, interner_.intern(typeName)));
        const NameId id = interner_.intern(name);
        if (type && !at(predefined_, id) && !at(configured_, id))
            configuredObject(id, name, type->type, false);
    };
    for (const std::string& task : taskNames_)
        declare(task + "Id", "taskid");
    declare("ROB_1", "mecunit");
}

// An unknown name as data: a signal where one is expected or where it is used as one elsewhere, otherwise an error.
Symbol* Analyzer::reportUnknownData(TokenIndex token, NameId name, const Type* handle) {
    facts().open = true;
    const bool mecunit = handle && handle->base()->name == "mecunit";
    const Type* type = handle && handle->kind == TypeKind::SemiValue ? handle : nullptr;
    if (!type && !mecunit && context_.routine) type = signalTypeByUse(name);
    if (!type && !mecunit && context_.routine && !incomplete_) {
        const std::string_view typeName = signalTypeByName(text(token));
        if (const TypeSymbol* signal =
                typeName.empty() ? nullptr : asType(at(predefined_, interner_.intern(typeName))))
            type = signal->type;
    }
    if (!type && !mecunit) {
        if (moduleNames_.find(name)) {
            report(Code::NotData, range(token), {text(token), "a module"});
        } else if (!context_.routine || !context_.routine->incomplete) { // else it may be a parameter
            const char* hint = "";
            if (context_.routine && countedAbove(token, name))
                hint = "; a loop variable is known only between FOR and ENDFOR";
            else if (looksLikeSignal(interner_.folded(name)))
                hint = options_.configurationKnown
                           ? "; if it is a signal, define it in EIO.cfg and pass that with --config"
                           : "; if it is a signal, pass the configuration with --config=EIO.cfg";
            reportUnknown(Code::UnknownName, token, name, Wanted::Data, hint);
        }
        if (context_.routine) declareUnknown(name);
        return nullptr;
    }
    const bool isError = !mecunit && options_.configurationKnown;
    if (reportedNames_.insert(name).second && mayReportUnknown(name)) {
        const Code code = mecunit   ? Code::MechanicalUnitUnknown
                          : isError ? Code::SignalUndefined
                                    : Code::SignalUnknown;
        if (incomplete_)
            reportMayBeDeclared(token, {});
        else
            report(code, range(token), {text(token)});
    }
    return configuredObject(name, text(token), mecunit ? handle : type, true);
}

// From now on the routine has data of this name and of the type that fits everything: one mistake, one diagnostic.
void Analyzer::declareUnknown(NameId name) {
    DataSymbol& symbol = facts().locals.emplace_back();
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.nameId = name;
    symbol.module = context_.module;
    symbol.storage = Storage::RoutineData;
    symbol.type.type = program_.errorType;
    symbol.routine = context_.routine;
    put<Symbol>(routineNames_, name, &symbol);
    declaredInRoutine_.push_back(name);
}

const Type* Analyzer::signalTypeByUse(NameId name) {
    if (!signalUsesKnown_) {
        signalUsesKnown_ = true;
        gatherSignalUses();
    }
    return signalUses_.find(name);
}

void Analyzer::gatherSignalUses() {
    const Context saved = context_;
    for (Module* module : task_->modules) {
        enterModule(module);
        for (const RoutineSymbol* routine : module->routines) {
            const RoutineDecl& decl = *routine->routineDecl;
            gatherSignalUses(decl.body);
            gatherSignalUses(decl.backward);
            for (const ErrorClause* clause : decl.errors)
                gatherSignalUses(clause->body);
            gatherSignalUses(decl.undo);
        }
    }
    context_ = saved;
}

void Analyzer::gatherSignalUses(StmtList list) {
    for (const Stmt* s : list) {
        switch (s->kind) {
        case NodeKind::CallStmt: {
            const auto& call = as<CallStmt>(*s);
            const RoutineSymbol* routine =
                call.lateName ? nullptr : asRoutine(lookupOutside(idOf(call.name)));
            if (routine) gatherSignalUses(*routine, call.args);
            for (const Argument* a : call.args)
                gatherSignalUses(a->value);
            break;
        }
        case NodeKind::Assign: gatherSignalUses(as<AssignStmt>(*s).value); break;
        case NodeKind::Return: gatherSignalUses(as<ReturnStmt>(*s).value); break;
        case NodeKind::If:
            for (const IfBranch* b : as<IfStmt>(*s).branches) {
                gatherSignalUses(b->condition);
                gatherSignalUses(b->body);
            }
            gatherSignalUses(as<IfStmt>(*s).elseBody);
            break;
        case NodeKind::CompactIf: {
            gatherSignalUses(as<CompactIfStmt>(*s).condition);
            Stmt* body = as<CompactIfStmt>(*s).body;
            if (body) gatherSignalUses(StmtList(&body, 1));
            break;
        }
        case NodeKind::For: gatherSignalUses(as<ForStmt>(*s).body); break;
        case NodeKind::While:
            gatherSignalUses(as<WhileStmt>(*s).condition);
            gatherSignalUses(as<WhileStmt>(*s).body);
            break;
        case NodeKind::Test:
            gatherSignalUses(as<TestStmt>(*s).subject);
            for (const TestCase* c : as<TestStmt>(*s).cases)
                gatherSignalUses(c->body);
            gatherSignalUses(as<TestStmt>(*s).defaultBody);
            break;
        default: break;
        }
    }
}

void Analyzer::gatherSignalUses(const Expr* e) {
    if (!e) return;
    switch (e->kind) {
    case NodeKind::Call: {
        const auto& call = as<CallExpr>(*e);
        if (const RoutineSymbol* routine = asRoutine(lookupOutside(idOf(call.name))))
            gatherSignalUses(*routine, call.args);
        for (const Argument* a : call.args)
            gatherSignalUses(a->value);
        break;
    }
    case NodeKind::Paren: gatherSignalUses(as<ParenExpr>(*e).inner); break;
    case NodeKind::Unary: gatherSignalUses(as<UnaryExpr>(*e).operand); break;
    case NodeKind::Binary:
        for (; e->kind == NodeKind::Binary; e = as<BinaryExpr>(*e).left)
            gatherSignalUses(as<BinaryExpr>(*e).right);
        gatherSignalUses(e);
        break;
    default: break;
    }
}

void Analyzer::gatherSignalUses(const RoutineSymbol& routine, std::span<Argument* const> args) {
    size_t next = nextRequired(routine, 0);
    const Type* partner = nullptr; // AliasIO(name, signal): a signal of that type
    for (const Argument* a : args) {
        if (!a->value || a->value->kind != NodeKind::Name || !routine.predefined) continue;
        DataSymbol* data = asData(lookupOutside(idOf(as<NameExpr>(*a->value).name)));
        if (!data || data->storage != Storage::ModuleData) continue;
        ensureData(*data);
        if (data->type.type->kind == TypeKind::SemiValue) partner = data->type.type;
    }
    for (const Argument* a : args) {
        const DataSymbol* param = nullptr;
        if (a->argKind == ArgKind::Required) {
            if (next < routine.params.size()) param = routine.params[next];
            next = nextRequired(routine, alternativesEnd(routine, next));
        } else if (a->name != kNoToken) {
            const NameId name = idOf(a->name);
            for (const DataSymbol* p : routine.params)
                if (p->nameId == name) param = p;
        }
        if (!param || !a->value || a->value->kind != NodeKind::Name) continue;
        const NameId name = idOf(as<NameExpr>(*a->value).name);
        const bool either =
            param->accepts == ParamClass::SignalOrString || param->accepts == ParamClass::Signal;
        const Type* type = either ? partner : param->type.type;
        if (type && type->kind == TypeKind::SemiValue && !signalUses_.find(name) && !lookupOutside(name))
            signalUses_.set(name, type);
    }
}

} // namespace rapid::sema
