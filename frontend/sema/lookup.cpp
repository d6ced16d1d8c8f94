// What a name means: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2). Signals that
// nobody declares are part of the controller's configuration and are recognised by how they are used.

#include "frontend/sema/analysis.h"

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
    const bool camera = handle && handle->base()->name == "cameradev";
    const bool object = camera || (handle && handle->base()->name == "mecunit");
    const Type* type = handle && handle->kind == TypeKind::SemiValue ? handle : nullptr;
    if (!type && !object && context_.routine) type = signalTypeByUse(name);
    const bool open = !type && !object && context_.routine;
    if (open && (!incomplete_ || options_.assumeSignals)) type = signalTypeByName(text(token));
    const bool perhaps = open && !type && comparisonsTell();
    if (perhaps) type = signalTypeByComparison(text(token), name);
    // A signal that cannot come: the name is left to the modules that are missing, which may declare it.
    if (incomplete_ && options_.configurationKnown && !options_.assumeSignals) type = nullptr;
    if (!type && !object) {
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
    if (reportedNames_.insert(name).second && mayReportUnknown(name)) {
        if (incomplete_ && !perhaps && !options_.assumeSignals)
            reportMayBeDeclared(token, {});
        else if (object)
            report(camera ? Code::CameraUnknown : Code::MechanicalUnitUnknown, range(token), {text(token)});
        else
            reportSignal(token, name, *type, perhaps);
    }
    return configuredObject(name, text(token), object ? handle : type, true);
}

// Whether a comparison with a number is enough to take a name for a signal: without a configuration, and where no module
// that is known to be missing may declare it.
bool Analyzer::comparisonsTell() const {
    if (options_.assumeSignals) return true;
    return !options_.configurationKnown && missingModules_.empty();
}

// A signal that no configuration defines. `perhaps`: nothing but a comparison says that it is one.
void Analyzer::reportSignal(TokenIndex token, NameId name, const Type& type, bool perhaps) {
    if (options_.assumeSignals) return; // the command says which ones it assumes
    const std::string written = text(token);
    if (!options_.configurationKnown) {
        report(Code::SignalUnknown, range(token),
               {perhaps ? "'" + written + "'" : "signal '" + written + "'",
                perhaps ? "may be a signal" : "is taken as configured"});
        return;
    }
    const Suggestion near = suggestion(name, Wanted::Signal);
    const bool fits = near.symbol && static_cast<const DataSymbol*>(near.symbol)->type.type == &type;
    diag::Diagnostic& d =
        report(Code::SignalUndefined, range(token), {written, fits ? didYouMean(near.name) : std::string()});
    if (fits) d.fix(range(token), near.name, false);
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
    symbol.index = kNoIndex;
    put<Symbol>(routineNames_, name, &symbol);
    declaredInRoutine_.push_back(name);
}

} // namespace rapid::sema
