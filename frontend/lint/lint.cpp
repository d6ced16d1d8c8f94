// The warnings of a task: walks over its routines, then what only the whole task can tell.

#include "frontend/lint/lint.h"

#include "config/letter_case.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/lint/backward.h"
#include "frontend/lint/error_routes.h"
#include "frontend/lint/presence.h"
#include "frontend/lint/rings.h"
#include "frontend/lint/walker.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/limits.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;
using sema::Module;
using sema::RoutineSymbol;
using sema::Symbol;
using sema::SymbolKind;
using sema::Task;
using sema::TypeSymbol;

diag::Diagnostic* Reporter::report(Code code, const SyntaxTree& tree, SourceRange where,
                                   std::span<const std::string> args) {
    if (!levels_.isOn(code)) return nullptr;
    // A file that several tasks load is walked over for each of them.
    if (severalTasks_ && !reported_.insert({code, tree.source->path(), where.begin}).second) return nullptr;
    return &sink_.report(code, tree.source, where, args);
}

Predefined::Predefined(const sema::CheckedProgram& program) {
    const auto add = [&](const Symbol* symbol) {
        if (symbol->nameId >= byName.size()) byName.resize(symbol->nameId + 1, nullptr);
        byName[symbol->nameId] = symbol;
    };
    for (const Module* module : program.predefinedModules) {
        for (const TypeSymbol* type : module->types)
            add(type);
        for (const DataSymbol* data : module->data)
            add(data);
        for (const RoutineSymbol* routine : module->routines)
            add(routine);
    }
}

namespace {

/// "dummy", "nUnused": the name says that the data is not meant to be used.
bool isPlaceholderName(std::string_view name) {
    return config::containsName(name, "dummy") || config::containsName(name, "unused");
}

bool equalValues(const sema::ConstValue& a, const sema::ConstValue& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
    case sema::ConstValue::Kind::None: return true;
    case sema::ConstValue::Kind::Number: return a.number == b.number;
    case sema::ConstValue::Kind::Bool: return a.boolean == b.boolean;
    case sema::ConstValue::Kind::String: return a.text() == b.text();
    case sema::ConstValue::Kind::Aggregate: break;
    }
    return std::equal(a.members().begin(), a.members().end(), b.members().begin(), b.members().end(),
                      equalValues);
}

/// The predefined data itself, declared once more; of constants with the same value.
bool isSameData(const DataSymbol& data, const DataSymbol& predefined) {
    if (data.type.type != predefined.type.type || data.dataKind != predefined.dataKind) return false;
    return data.dataKind != DataKind::Const || equalValues(data.value(), predefined.value());
}

/// Places of errors and of placeholders by file: what contains one is not judged.
class Errors {
  public:
    explicit Errors(const diag::Sink& sink) : sink_(sink) {}
    /// Takes in what has been reported since.
    void update() {
        for (; seen_ < sink_.all().size(); ++seen_) {
            const diag::Diagnostic& d = sink_.all()[seen_];
            if ((d.severity == diag::Severity::Error || d.code == diag::say::Placeholder.code) && d.file)
                places_[d.file.get()].insert(d.range.begin);
        }
    }
    bool any() const { return sink_.hasErrors() || !places_.empty(); }
    bool in(const SyntaxTree& tree) const { return places_.count(tree.source.get()) > 0; }
    bool in(const SyntaxTree& tree, SourceRange range) const {
        const auto file = places_.find(tree.source.get());
        if (file == places_.end()) return false;
        const auto first = file->second.lower_bound(range.begin);
        return first != file->second.end() && *first < range.end;
    }

  private:
    const diag::Sink& sink_;
    size_t seen_ = 0;
    std::map<const SourceFile*, std::set<uint32_t>> places_;
};

/// Files that several tasks load, and modules of which several tasks have the same copy: what one task does not use,
/// another one may.
class SharedFiles {
  public:
    void find(const sema::CheckedProgram& program) {
        if (program.tasks.size() < 2) return;
        struct Owner {
            const Task* task;
            const std::string* path;
        };
        std::unordered_map<std::string_view, Owner> owners; // by text
        for (const auto& task : program.tasks)
            for (const Module* module : task->modules) {
                const SourceFile& file = *module->tree->source;
                const Owner first = owners.try_emplace(file.text(), task.get(), &file.path()).first->second;
                if (first.task != task.get()) shared_.insert({*first.path, file.path()});
            }
    }
    bool has(const SyntaxTree& tree) const {
        return !shared_.empty() && shared_.count(tree.source->path()) > 0;
    }

  private:
    std::set<std::string> shared_;
};

/// Texts in the strings of the task's files that may name a routine: "name" and "module:name", in lower case.
std::unordered_set<std::string> namesInTexts(const Task& task) {
    std::unordered_set<std::string> names;
    std::unordered_set<const SyntaxTree*> seen;
    const auto add = [&](std::string_view text) {
        if (text.size() > syntax::kStringCapacity) return;
        text.remove_prefix(std::min(text.size(), text.rfind(':') + 1));
        const size_t first = text.find_first_not_of(' ');
        if (first != std::string_view::npos)
            names.insert(sema::foldName(text.substr(first, text.find_last_not_of(' ') - first + 1)));
    };
    for (const Module* module : task.modules) {
        if (!seen.insert(module->tree).second) continue;
        for (const Token& token : module->tree->tokens) {
            if (token.kind != TokenKind::StringLiteral && token.kind != TokenKind::PlainAggregate) continue;
            std::string_view text = module->tree->source->text().substr(token.offset, token.length);
            for (size_t open = text.find('"'); open != std::string_view::npos; open = text.find('"', open)) {
                const size_t close = std::min(text.find('"', open + 1), text.size());
                add(text.substr(open + 1, close - open - 1));
                open = close + 1;
            }
        }
    }
    return names;
}

class TaskLint {
  public:
    TaskLint(const sema::CheckedProgram& program, const Task& task, const Predefined& predefined,
             const Errors& errors, const SharedFiles& shared, const std::set<std::string>& configured,
             Reporter& reporter)
        : task_(task), predefined_(predefined), errors_(errors), shared_(shared), reporter_(reporter),
          walker_(program, task, reporter, facts_), configured_(configured) {}

    /// Everything that needs the inside of the routines.
    void file(std::span<Module* const> modules) {
        for (const Module* module : modules) {
            for (const RoutineSymbol* routine : module->routines) {
                if (isWrong(*routine)) continue;
                walker_.routine(*routine);
                errorRoutes_.routine(*routine);
                judgePresence(*routine, reporter_);
                judgeBackward(*routine, reporter_);
                routineData(*routine);
            }
        }
        interruptsOfRoutines();
    }

    void finish() {
        complete_ = task_.entryRoutine && !task_.incomplete && !errors_.any();
        suspicions();
        fractions();
        interrupts();
        errorRoutes_.judge(reporter_);
        for (const Module* module : task_.modules)
            declarations(*module);
        rings();
    }

  private:
    bool isWrong(const RoutineSymbol& routine) const {
        const SyntaxTree& tree = *routine.module->tree;
        return errors_.in(tree, tree.range(*routine.routineDecl));
    }
    void suspicions();
    void fractions();
    bool isNamedOutside(const RoutineSymbol& routine);
    std::unordered_map<const RoutineSymbol*, uint8_t> wholeConduct() const;
    void interrupts();
    void interruptsOfRoutines();
    void routineData(const RoutineSymbol& routine);
    void declarations(const Module& module);
    bool mayBeUsedElsewhere(const Symbol& symbol) const;
    void data(const DataSymbol& data);
    void routine(const RoutineSymbol& routine);
    bool isOnlyForCallers(const RoutineSymbol& routine);
    void rings();
    void type(const TypeSymbol& type);
    void hiding(const Symbol& symbol, const char* kind);
    template <size_t N>
    diag::Diagnostic* report(diag::Message<N> message, const Symbol& symbol, diag::MessageArgs<N> args) {
        return reporter_.report(message, *symbol.module->tree, symbol.module->tree->range(symbol.nameToken),
                                args);
    }

    const Task& task_;
    const Predefined& predefined_;
    const Errors& errors_;
    const SharedFiles& shared_;
    Reporter& reporter_;
    TaskFacts facts_;
    Walker walker_;
    ErrorRoutes errorRoutes_;
    bool complete_ = false; ///< all modules are there and free of errors
    const std::set<std::string>& configured_;
    std::optional<std::unordered_set<std::string>> texts_; ///< names in strings, once they are asked for
};

/// The effects of routines, together with all that they call: from the callees to the callers.
std::unordered_map<const RoutineSymbol*, uint8_t> TaskLint::wholeConduct() const {
    std::unordered_map<const RoutineSymbol*, uint8_t> conduct;
    std::unordered_map<const RoutineSymbol*, std::vector<const RoutineSymbol*>> callers;
    std::vector<const RoutineSymbol*> work;
    for (const auto& [routine, own] : facts_.routines) {
        conduct[routine] = own.conduct;
        if (own.conduct != 0) work.push_back(routine);
        for (size_t i = own.firstCall; i < own.endCall; ++i) {
            const RoutineSymbol* callee = facts_.calls[i];
            callers[callee].push_back(routine);
            if (facts_.routines.count(callee) > 0 || conduct.count(callee) > 0) continue;
            conduct[callee] = kWaits | kEnds | kRaises; // not looked at: anything
            work.push_back(callee);
        }
    }
    while (!work.empty()) {
        const RoutineSymbol* callee = work.back();
        work.pop_back();
        const uint8_t found = conduct[callee];
        for (const RoutineSymbol* caller : callers[callee]) {
            uint8_t& known = conduct[caller];
            if ((known | found) == known) continue;
            known |= found;
            work.push_back(caller);
        }
    }
    return conduct;
}

void TaskLint::suspicions() {
    if (facts_.suspicions.empty() || facts_.callsByName) return;
    const auto conduct = wholeConduct();
    for (const Suspicion& s : facts_.suspicions) {
        bool refuted = false;
        for (size_t i = s.firstCall; i < s.endCall && !refuted; ++i)
            refuted = (conduct.at(facts_.calls[i]) & s.refutedBy) != 0;
        if (refuted) continue;
        const std::span<const std::string> args(&s.arg, s.arg.empty() ? 0 : 1);
        reporter_.report(s.code, *s.tree, s.where, args);
    }
}

void TaskLint::fractions() {
    for (const FractionUse& use : facts_.fractions) {
        bool met = facts_.numbers.contains({use.data, use.value});
        forEachFraction(use.data->value(), [&](double initial) { met |= initial == use.value; });
        if (!met) reporter_.report(say::FractionEquality, *use.tree, use.where, {use.operation, use.text});
    }
}

void TaskLint::interrupts() {
    std::unordered_set<const Symbol*> reported;
    for (const InterruptUse& use : facts_.interrupts) {
        const DataSymbol& interrupt = *use.interrupt;
        if (interrupt.predefined || interrupt.storage == sema::Storage::Parameter ||
            facts_.connected.count(&interrupt) > 0 || mayBeUsedElsewhere(interrupt) ||
            !reported.insert(&interrupt).second)
            continue;
        reporter_.report(say::InterruptNotConnected, *use.tree, use.where,
                         {use.native->name, interrupt.name});
    }
}

/// Data of routines are not used by other files, which may forget these symbols.
void TaskLint::interruptsOfRoutines() {
    const auto isOwn = [](const Symbol* symbol) {
        return symbol->kind == SymbolKind::Data && static_cast<const DataSymbol*>(symbol)->routine != nullptr;
    };
    std::vector<InterruptUse> others;
    for (const InterruptUse& use : facts_.interrupts)
        if (!isOwn(use.interrupt)) others.push_back(use);
    std::erase_if(facts_.interrupts, [&](const InterruptUse& use) { return !isOwn(use.interrupt); });
    interrupts();
    facts_.interrupts = std::move(others);
    std::erase_if(facts_.connected, isOwn);
}

/// Whether something that is not known here may use it: another module, an operator, an event.
bool TaskLint::mayBeUsedElsewhere(const Symbol& symbol) const {
    if (errors_.in(*symbol.module->tree) || shared_.has(*symbol.module->tree)) return true;
    if (symbol.isLocal) return false;
    const bool ownData =
        symbol.kind == SymbolKind::Data && static_cast<const DataSymbol&>(symbol).routine != nullptr;
    if (ownData) return false;
    // System modules hold what many programs share.
    return !complete_ || (symbol.module->decl->attributes & kAttrSysmodule) != 0;
}

void TaskLint::declarations(const Module& module) {
    for (const TypeSymbol* t : module.types)
        type(*t);
    for (const DataSymbol* d : module.data)
        data(*d);
    for (const RoutineSymbol* r : module.routines)
        routine(*r);
}

void TaskLint::type(const TypeSymbol& type) {
    hiding(type, "data type");
    if (!type.used && !mayBeUsedElsewhere(type)) report(say::UnusedType, type, {type.name});
}

void TaskLint::data(const DataSymbol& data) {
    const bool pers = data.dataKind == DataKind::Pers;
    const bool constant = data.dataKind == DataKind::Const;
    const char* kind = constant ? "constant" : pers ? "persistent" : "variable";
    hiding(data, kind);
    const double* wrong = data.init && isByte(data.type) ? firstBeyondByte(data.value()) : nullptr;
    if (wrong) {
        const SyntaxTree& tree = *data.module->tree;
        reporter_.report(say::ByteOutOfRange, tree, tree.range(*data.init), {fmt::format("{}", *wrong)});
    }
    if (data.used || facts_.dataByName || mayBeUsedElsewhere(data)) return;
    // Persistents are the door to the outside: displays, other computers, jogging.
    const sema::Type* t = data.type.type;
    if (pers && (!data.isLocal || t->known == sema::KnownType::Tool ||
                 t->known == sema::KnownType::WorkObject || t->known == sema::KnownType::Load))
        return;
    report(say::UnusedVariable, data, {kind, data.name});
}

/// `\switch on | switch off`: checking one of them decides both.
bool otherAlternativeRead(const RoutineSymbol& routine, const DataSymbol& param) {
    if (!param.isSwitch) return false;
    return std::any_of(routine.params.begin(), routine.params.end(),
                       [&](const DataSymbol* other) { return other->group == param.group && other->used; });
}

void TaskLint::routine(const RoutineSymbol& routine) {
    const bool proc = routine.routineKind == RoutineKind::Proc;
    const bool trap = routine.routineKind == RoutineKind::Trap;
    hiding(routine, proc ? "procedure" : trap ? "trap routine" : "function");
    if (!routine.used) {
        if (trap && !mayBeUsedElsewhere(routine))
            report(say::TrapNotConnected, routine, {routine.name});
        else if (isOnlyForCallers(routine))
            report(say::UnusedRoutine, routine, {proc ? "procedure" : "function", routine.name, ""});
    }
    if (isWrong(routine)) return;
    for (const DataSymbol* param : routine.params) {
        hiding(*param, "parameter");
        if (!param->used && !otherAlternativeRead(routine, *param) && !isPlaceholderName(param->name) &&
            !facts_.callsByName && !routine.routineDecl->body.empty())
            report(say::UnusedParameter, *param, {param->name, routine.name});
    }
}

/// Whether a string of the program or the configuration names it: event data, menus, service routines.
bool TaskLint::isNamedOutside(const RoutineSymbol& routine) {
    if (!texts_) texts_ = namesInTexts(task_);
    const std::string folded = sema::foldName(routine.name);
    return texts_->contains(folded) || configured_.contains(folded);
}

/// Whether nothing but calls in the modules of the task can start it.
bool TaskLint::isOnlyForCallers(const RoutineSymbol& routine) {
    if (routine.routineKind == RoutineKind::Trap || facts_.callsByName || &routine == task_.entryRoutine)
        return false;
    const bool takesArguments = std::any_of(routine.params.begin(), routine.params.end(),
                                            [](const DataSymbol* p) { return !p->optional; });
    const bool mayBeStarted = // operators and events call PROCs
        routine.routineKind == RoutineKind::Proc && !routine.isLocal && !takesArguments;
    return !mayBeStarted && !mayBeUsedElsewhere(routine) && !isNamedOutside(routine);
}

void TaskLint::rings() {
    if (facts_.callsByName || !reporter_.isOn(say::UnusedRoutine.code)) return;
    RoutineList roots,
        candidates; // a routine that is never called is reported by itself, its callees are not
    for (const Module* module : task_.modules)
        for (const RoutineSymbol* routine : module->routines)
            (routine->used && isOnlyForCallers(*routine) ? candidates : roots).push_back(routine);
    for (const RoutineList& ring : ringsOf(facts_, roots, std::move(candidates))) {
        const RoutineSymbol& first = *ring.front();
        std::string by = " but by itself";
        if (ring.size() > 1) by = " but by '" + ring[1]->name + "', and that only from here";
        report(say::UnusedRoutine, first,
               {first.routineKind == RoutineKind::Proc ? "procedure" : "function", first.name, by});
    }
}

void TaskLint::routineData(const RoutineSymbol& routine) {
    for (const DataSymbol* data : routine.data) {
        const bool loop = data->storage == sema::Storage::LoopVariable;
        const bool constant = data->dataKind == DataKind::Const;
        hiding(*data, loop ? "loop variable" : constant ? "constant" : "variable");
        if (loop || data->used) continue;
        diag::Diagnostic* d =
            report(say::UnusedVariable, *data, {constant ? "constant" : "variable", data->name});
        // Many declare the variable of a FOR.
        const auto same =
            std::find_if(routine.data.begin(), routine.data.end(), [&](const DataSymbol* other) {
                return other->storage == sema::Storage::LoopVariable && other->nameId == data->nameId;
            });
        if (d && same != routine.data.end())
            d->notes.push_back({routine.module->tree->source, routine.module->tree->range((*same)->nameToken),
                                "FOR declares its own '" + data->name + "' here"});
    }
}

void TaskLint::hiding(const Symbol& symbol, const char* kind) {
    const Symbol* hidden =
        symbol.nameId < predefined_.byName.size() ? predefined_.byName[symbol.nameId] : nullptr;
    if (!hidden || symbol.nameToken == kNoToken) return;
    const auto* data = symbol.kind == SymbolKind::Data ? static_cast<const DataSymbol*>(&symbol) : nullptr;
    // Optional parameters are often named as those of the instructions they are passed on to (\InPos).
    if (data && data->optional && hidden->kind == SymbolKind::Data) return;
    const char* what = "the predefined data";
    if (hidden->kind == SymbolKind::Type) what = "the predefined data type";
    if (hidden->kind == SymbolKind::Routine) {
        const auto& routine = static_cast<const RoutineSymbol&>(*hidden);
        if (!routine.option.empty()) return; // not there on every controller
        // Inside a routine data is not mistaken for an instruction or a function; what calls it there is an error.
        if (data && data->routine) return;
        what = routine.routineKind == RoutineKind::Func ? "the predefined function"
                                                        : "the predefined instruction";
    }
    // Controllers keep predefined data such as tool0 and reg1 in modules of their own, and backups hold these.
    if (hidden->kind == SymbolKind::Data && data && !data->routine &&
        isSameData(*data, static_cast<const DataSymbol&>(*hidden)))
        return;
    report(say::HiddenPredefinedName, symbol, {kind, symbol.name, what});
}

} // namespace

struct Lint::State {
    State(const WarningLevels& levels, diag::Sink& sink, bool severalTasks)
        : isOn(levels.anyLint()), errors(sink), reporter(levels, sink, severalTasks) {}
    bool isOn;
    Errors errors;
    Reporter reporter;
    SharedFiles shared; ///< known at the end
    std::set<std::string> configured;
    std::optional<Predefined> predefined;
    std::map<const Task*, std::unique_ptr<TaskLint>> tasks;

    TaskLint& at(const sema::CheckedProgram& program, const Task& task) {
        if (!predefined) predefined.emplace(program);
        std::unique_ptr<TaskLint>& found = tasks[&task];
        if (!found)
            found =
                std::make_unique<TaskLint>(program, task, *predefined, errors, shared, configured, reporter);
        return *found;
    }
};

Lint::Lint(const WarningLevels& levels, diag::Sink& sink, bool severalTasks, std::set<std::string> configured)
    : state_(std::make_unique<State>(levels, sink, severalTasks)) {
    state_->configured = std::move(configured);
}

Lint::~Lint() = default;

void Lint::file(const sema::CheckedProgram& program, const Task& task, std::span<Module* const> modules) {
    if (!state_->isOn) return;
    state_->errors.update();
    state_->at(program, task).file(modules);
}

void Lint::finish(const sema::CheckedProgram& program) {
    if (!state_->isOn) return;
    state_->errors.update();
    state_->shared.find(program);
    for (const auto& task : program.tasks)
        state_->at(program, *task).finish();
}

void lint(const sema::CheckedProgram& program, const WarningLevels& levels, diag::Sink& sink) {
    Lint all(levels, sink, program.tasks.size() > 1);
    for (const auto& task : program.tasks)
        all.file(program, *task, task->modules);
    all.finish(program);
}

} // namespace rapid::lint
