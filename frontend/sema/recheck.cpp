// Checking again what a changed file concerns, while the facts about other files stay (see session.h).

#include "frontend/sema/analyzer.h"
#include "frontend/sema/collect.h"
#include "frontend/source/same_ends.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

/// The part of a declaration that can concern other files. Constants and types count even where they are LOCAL: those
/// that others see may be made of them. `locals`: all that is LOCAL counts.
std::string_view visiblePart(const SyntaxTree& tree, const Decl& decl, bool locals) {
    TokenIndex last = decl.last;
    switch (decl.kind) {
    case NodeKind::Record:
    case NodeKind::Alias: break;
    case NodeKind::Data: {
        const auto& data = as<DataDecl>(decl);
        if (data.dataKind == DataKind::Const) break;
        if (data.scope == ScopeWord::Local && !locals) return {};
        if (data.init) last = data.init->first;
        break;
    }
    case NodeKind::Routine: {
        const auto& routine = as<RoutineDecl>(decl);
        if (routine.local && !locals) return {};
        for (last = routine.name; last < decl.last; ++last)
            if (routine.routineKind == RoutineKind::Trap || tree.tokens[last].kind == TokenKind::RightParen)
                break;
        break;
    }
    default: return {};
    }
    if (last == kNoToken || decl.first > last) return {};
    const bool value =
        decl.kind == NodeKind::Data && as<DataDecl>(decl).init && last == as<DataDecl>(decl).init->first;
    const uint32_t begin = tree.range(decl.first).begin;
    const uint32_t end = value ? tree.range(last).begin : tree.range(last).end;
    return tree.source->text().substr(begin, end - begin);
}

/// Declarations that begin and end at the same places, counted from the beginning of the texts or from their ends.
bool samePlace(const SyntaxTree& oldTree, const Decl& old, const SyntaxTree& newTree, const Decl& fresh,
               size_t shift) {
    const SourceRange before = oldTree.range(old), now = newTree.range(fresh);
    return old.kind == fresh.kind && before.begin + shift == now.begin && before.end + shift == now.end;
}

using Decls = std::span<Decl* const>;

/// Takes away what is the same letter by letter at both ends: nearly everything, after an edit of a line.
void dropSameEnds(const SyntaxTree& oldTree, Decls& old, const SyntaxTree& newTree, Decls& fresh) {
    const std::string_view before = oldTree.source->text(), now = newTree.source->text();
    const auto [head, tail] = sameEnds(before, now);
    while (!old.empty() && !fresh.empty() && oldTree.range(*old.front()).end < head &&
           samePlace(oldTree, *old.front(), newTree, *fresh.front(), 0)) {
        old = old.subspan(1);
        fresh = fresh.subspan(1);
    }
    const size_t shift = now.size() - before.size(); // modulo 2^64
    while (!old.empty() && !fresh.empty() && oldTree.range(*old.back()).begin > before.size() - tail &&
           samePlace(oldTree, *old.back(), newTree, *fresh.back(), shift)) {
        old = old.first(old.size() - 1);
        fresh = fresh.first(fresh.size() - 1);
    }
}

/// The next declaration from `i` on that others can see; the number of declarations if there is none.
size_t nextVisible(const SyntaxTree& tree, Decls decls, size_t i, bool locals, std::string_view& part) {
    for (; i < decls.size(); ++i)
        if (part = visiblePart(tree, *decls[i], locals); !part.empty()) return i;
    return i;
}

/// Whether two modules look alike to other files; `locals`: also in what is LOCAL.
bool sameFromOutside(const SyntaxTree& oldTree, const ModuleDecl& oldModule, const SyntaxTree& newTree,
                     const ModuleDecl& newModule, bool locals) {
    if (oldTree.text(oldModule.name) != newTree.text(newModule.name) ||
        oldModule.attributes != newModule.attributes)
        return false;
    Decls old = oldModule.decls, fresh = newModule.decls;
    dropSameEnds(oldTree, old, newTree, fresh);
    std::string_view oldPart, newPart;
    size_t i = nextVisible(oldTree, old, 0, locals, oldPart);
    size_t k = nextVisible(newTree, fresh, 0, locals, newPart);
    while (i < old.size() && k < fresh.size()) {
        if (oldPart != newPart) return false;
        i = nextVisible(oldTree, old, i + 1, locals, oldPart);
        k = nextVisible(newTree, fresh, k + 1, locals, newPart);
    }
    return i == old.size() && k == fresh.size();
}

} // namespace

TaskContext Analyzer::leaveTask() {
    return std::exchange(state_.task, {});
}

void Analyzer::enterTask(TaskContext task) {
    state_.task = std::move(task);
    state_.task.spareAssumed.clear();
}

// The shared part of files that are `open`: it begins again each time, and all of them are checked again.
void Analyzer::clearLooseEnds() {
    for (DataSymbol* symbol : state_.task.assumed)
        put<DataSymbol>(state_.task.configured, symbol->nameId, nullptr);
    state_.task.spareAssumed.insert(state_.task.spareAssumed.end(), state_.task.assumed.begin(),
                                    state_.task.assumed.end());
    state_.task.assumed.clear();
    state_.task.signalUses = {};
    state_.task.reportedNames.clear();
    state_.task.maybeDeclared.clear();
    state_.task.nameLists.reset();
    findBrokenTrees();
    state_.task.elsewhere = {};
    state_.task.comparisonsLeft = kMaxComparisons;
}

void Analyzer::findBrokenTrees() {
    state_.task.brokenTrees.clear();
    for (const TaskFile& file : state_.task.files)
        if (file.broken) state_.task.brokenTrees.push_back(state_.program.trees[file.slot].get());
}

Analyzer::Likeness Analyzer::replaceTree(size_t index, std::unique_ptr<SyntaxTree> tree, bool broken) {
    TaskFile& file = state_.task.files[index];
    std::unique_ptr<SyntaxTree>& place = state_.program.trees[file.slot];
    const auto isSame = [&](bool locals) {
        bool same = tree->modules.size() == place->modules.size();
        for (size_t i = 0; same && i < tree->modules.size(); ++i)
            same = sameFromOutside(*place, *place->modules[i], *tree, *tree->modules[i], locals);
        return same;
    };
    const Likeness likeness = !isSame(false) ? Likeness::None
                              : isSame(true) ? Likeness::WithLocals
                                             : Likeness::FromOutside;
    dropFacts(std::span<const size_t>(&index, 1)); // they point into the old tree
    place = std::move(tree);
    file.broken = broken;
    return likeness;
}

// Takes back what files say about the symbols of others.
void Analyzer::dropFacts(std::span<const size_t> files) {
    if (RoutineSymbol* entry = std::exchange(state_.task.task->entryRoutine, nullptr))
        entry->used = --entry->users > 0;
    for (const size_t index : files) {
        FileFacts& facts = *state_.program.facts[state_.task.files[index].slot];
        for (Symbol* symbol : std::exchange(facts.used, {}))
            symbol->used = --symbol->users > 0;
        for (DataSymbol* symbol : std::exchange(facts.assigned, {}))
            symbol->assigned = --symbol->writers > 0;
        facts.signals.clear();
    }
}

// New facts for a file, and its modules as the tree has them now.
void Analyzer::renewFacts(const TaskFile& file, std::shared_ptr<FileSymbols> symbols) {
    const SyntaxTree& tree = *state_.program.trees[file.slot];
    state_.program.facts[file.slot] =
        std::make_unique<FileFacts>(tree, state_.program.errorType, std::move(symbols), ++state_.lastStamp);
    FileFacts& facts = *state_.program.facts[file.slot];
    for (size_t i = 0; i < file.modules.size(); ++i) {
        Module& module = *file.modules[i];
        const uint32_t id = module.id;
        module = Module{};
        module.id = id;
        module.tree = &tree;
        module.decl = tree.modules[i];
        module.name = std::string(tree.text(module.decl->name));
        module.facts = &facts;
        module.exprs = &facts.exprs;
    }
}

// The declarations of files as their trees have them now, without their types. Returns their modules.
std::vector<Module*> Analyzer::declareAgain(std::span<const size_t> files) {
    dropFacts(files);
    std::vector<Module*> modules;
    std::vector<NameMap<Symbol>> earlier;
    for (const size_t index : files) {
        for (Module* module : state_.task.files[index].modules) {
            modules.push_back(module);
            earlier.push_back(std::exchange(state_.scopes[module->id]->names, {}));
            earlier.back().forEach([&](NameId name, Symbol* symbol) {
                if (at(state_.task.globals, name) == symbol) state_.task.globals[name] = nullptr;
                symbol->decl = nullptr;
            });
        }
    }
    for (const size_t index : files) {
        const TaskFile& file = state_.task.files[index];
        const FileFacts& old = *state_.program.facts[file.slot];
        const bool sameText =
            !file.modules.empty() && file.modules.front()->tree == state_.program.trees[file.slot].get();
        const auto uses = sameText ? old.signalUses : nullptr;
        renewFacts(file, old.symbols);
        state_.program.facts[file.slot]->signalUses = uses;
    }
    for (size_t i = 0; i < modules.size(); ++i)
        collector_.collectAgain(*modules[i], earlier[i]);
    return modules;
}

void Analyzer::recheckFiles(std::span<const size_t> files, Spent elsewhere) {
    clearLooseEnds();
    state_.task.elsewhere = elsewhere;
    state_.task.comparisonsLeft -= std::min(state_.task.comparisonsLeft, elsewhere.comparisons);
    const std::vector<Module*> modules = declareAgain(files);
    collector_.checkModuleNames(modules);
    checkModules(modules);
}

namespace {

/// The routines of a module whose text an offset can concern: in a text that is being typed a routine may have lost its end.
std::span<RoutineSymbol* const> routinesAround(const Module& module, uint32_t offset) {
    const std::span<RoutineSymbol* const> all = module.routines;
    const auto next = std::partition_point(all.begin(), all.end(), [&](const RoutineSymbol* routine) {
        return module.tree->range(*routine->decl).begin <= offset;
    });
    const size_t end = static_cast<size_t>(next - all.begin());
    const size_t first = end < 2 ? 0 : end - 2;
    return all.subspan(first, std::min(all.size(), end + 1) - first);
}

} // namespace

// What the task shares stays as the last check has left it, and the next one clears it: names of signals that are known by
// use are completed as well.
void Analyzer::sketchFile(size_t file, uint32_t offset) {
    const size_t slot = state_.task.files[file].slot;
    const Spent spent = state_.program.facts[slot]->spent; // it counts as it was until the file is checked
    const std::vector<Module*> modules = declareAgain(std::span<const size_t>(&file, 1));
    state_.program.facts[slot]->spent = spent;
    findBrokenTrees();
    // Reports are dropped. Suggestions for unknown names, and uses in the whole task that show what is a signal, would cost more than the check.
    state_.task.comparisonsLeft = 0;
    state_.task.nameLists.emplace();
    const bool usesKnown = std::exchange(state_.task.signalUses.known, true);
    resolveDeclarations(modules);
    for (Module* module : modules) {
        state_.enterModule(module);
        for (DataSymbol* data : module->data)
            data_.ensureValue(*data);
        for (RoutineSymbol* routine : routinesAround(*module, offset))
            routines_.checkRoutine(*routine);
    }
    state_.task.signalUses.known = usesKnown;
    state_.task.nameLists.reset();
    state_.task.unknownNames.clear();
    state_.reports.forgetMisfits();
}

std::vector<Symbol*> Analyzer::holdUses(size_t file) {
    std::vector<Symbol*> held;
    for (Symbol* symbol : state_.program.facts[state_.task.files[file].slot]->used)
        if (symbol->predefined) held.push_back(symbol); // others may go with the facts
    for (Symbol* symbol : held)
        ++symbol->users;
    return held;
}

void Analyzer::releaseUses(std::span<Symbol* const> held) {
    for (Symbol* symbol : held)
        symbol->used = --symbol->users > 0;
}

bool Analyzer::allowsAlone() const {
    const TaskContext& task = state_.task;
    const auto isBroken = [](const TaskFile& file) { return file.broken; };
    return !task.isLoose && task.assumed.empty() && task.reportedNames.empty() &&
           task.maybeDeclared.empty() && std::none_of(task.files.begin(), task.files.end(), isBroken);
}

FileOffer Analyzer::offerOf(size_t file) const {
    const FileFacts& facts = *state_.program.facts[state_.task.files[file].slot];
    FileOffer offer{{}, facts.signalUses, facts.spent};
    for (Symbol* symbol : facts.used) {
        const DataSymbol* data = asData(symbol);
        if (symbol->kind != SymbolKind::Label && !(data && data->routine)) offer.used.push_back(symbol);
    }
    std::sort(offer.used.begin(), offer.used.end());
    offer.used.erase(std::unique(offer.used.begin(), offer.used.end()), offer.used.end());
    return offer;
}

// By the first `files` of the task.
Spent Analyzer::spentBy(size_t files) const {
    Spent sum;
    for (size_t i = 0; i < files; ++i) {
        const Spent& spent = state_.program.facts[state_.task.files[i].slot]->spent;
        sum.comparisons += spent.comparisons;
        sum.unknown += spent.unknown;
    }
    return sum;
}

bool Analyzer::recheckAlone(size_t file, const FileOffer& before) {
    const auto isAmple = [&] { // no file is refused anything, however they share
        const Spent all = spentBy(state_.task.files.size());
        return all.comparisons < kMaxComparisons / 2 && all.unknown < kMaxUnknown / 2;
    };
    const bool wasAmple = isAmple();
    recheckFiles(std::span<const size_t>(&file, 1), spentBy(file));
    const bool dependsOnOrder = state_.task.dependsOnOrder;
    if (before.uses) signals_.gather();
    const FileOffer after = offerOf(file);
    const bool sameUses = !before.uses || *before.uses == *after.uses;
    const bool sameMeans = before.spent == after.spent || (wasAmple && isAmple());
    return allowsAlone() && !dependsOnOrder && sameUses && sameMeans && before.used == after.used;
}

void Analyzer::recheckTask() {
    std::vector<size_t> all(state_.task.files.size());
    for (size_t i = 0; i < all.size(); ++i)
        all[i] = i;
    dropFacts(all);
    state_.task.task->modules.clear();
    state_.task.globals.assign(state_.task.globals.size(), nullptr);
    state_.task.moduleNames = {};
    state_.task.dependsOnOrder = false;
    for (TaskFile& file : state_.task.files) {
        const SyntaxTree& tree = *state_.program.trees[file.slot];
        file.modules.resize(std::min(file.modules.size(), tree.modules.size()));
        for (Module* module : file.modules)
            state_.scopes[module->id]->names = {};
        renewFacts(file, std::make_shared<FileSymbols>());
        while (file.modules.size() < tree.modules.size())
            file.modules.push_back(collector_.addModule(tree, *tree.modules[file.modules.size()], false,
                                                        *state_.program.facts[file.slot]));
        state_.task.task->modules.insert(state_.task.task->modules.end(), file.modules.begin(),
                                         file.modules.end());
    }
    clearLooseEnds();
    checkFiles();
}

} // namespace rapid::sema
