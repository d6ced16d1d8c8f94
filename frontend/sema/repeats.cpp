// One mistake, one message: several errors of one cause are reported once, with a note for each place.

#include "frontend/sema/repeats.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/one_mistake.h"
#include "frontend/sema/scopes.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace rapid::sema {

using namespace syntax;

namespace {

using diag::Diagnostic;
void addNotes(Diagnostic& lead, std::span<const Diagnostic> places, std::string_view words) {
    constexpr size_t kShown = 20;
    for (size_t i = 0; i < places.size() && i < kShown; ++i) {
        std::string text = words.empty() ? places[i].message : std::string(words);
        if (i + 1 == kShown && places.size() > kShown)
            text += "; and in " + std::to_string(places.size() - kShown) + " more places";
        lead.notes.push_back({places[i].file, places[i].range, std::move(text)});
    }
}

/// The edits that all members ask for, as one.
void joinFixes(Diagnostic& lead, std::span<const Diagnostic> others) {
    if (lead.fixes.empty()) return;
    Diagnostic::Fix joined = lead.fixes.front();
    for (const Diagnostic& d : others) {
        if (d.fixes.empty() || d.fixes.front().message != joined.message) return;
        joined.edits.insert(joined.edits.end(), d.fixes.front().edits.begin(), d.fixes.front().edits.end());
        joined.certain &= d.fixes.front().certain;
    }
    lead.fixes.front() = std::move(joined);
}

Diagnostic leadOf(const Repeat& repeat) {
    if (repeat.declared.empty()) {
        Diagnostic lead = repeat.members.front();
        const std::span<const Diagnostic> others = std::span(repeat.members).subspan(1);
        joinFixes(lead, others);
        addNotes(lead, others, "the same here");
        return lead;
    }
    const Repeat::Declared& what = repeat.declared.front();
    diag::Sink sink;
    Diagnostic& lead = sink.report(say::DeclaredOtherwise, repeat.members.front().file, what.type,
                                   {what.name, what.found, what.needed});
    if (!what.replacement.empty()) lead.fix(what.type, what.replacement, false);
    addNotes(lead, repeat.members, {});
    return lead;
}

/// Those that explain most first. Which of two declarations that contradict each other is wrong is not known.
void putInOrder(std::vector<Repeat>& repeats) {
    const auto begin = [](const Repeat& r) { return r.members.front().range.begin; };
    std::sort(repeats.begin(), repeats.end(), [&](const Repeat& a, const Repeat& b) {
        if (a.members.size() != b.members.size()) return a.members.size() > b.members.size();
        if (begin(a) != begin(b)) return begin(a) < begin(b);
        return !a.declared.empty() && !b.declared.empty() &&
               a.declared.front().type.begin < b.declared.front().type.begin;
    });
    const auto same = [](const Repeat& a, const Repeat& b) {
        return std::equal(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(),
                          [](const Diagnostic& x, const Diagnostic& y) { return x.cause == y.cause; });
    };
    for (size_t i = 0; i + 1 < repeats.size(); ++i)
        if (same(repeats[i], repeats[i + 1])) {
            repeats[i].declared.clear();
            repeats[i + 1].declared.clear();
        }
}

/// A name of which a bracket became part: 'list3' of "list{3}" without its '{'.
bool ranInto(std::string_view name, std::string_view longer) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    return longer.size() > name.size() && foldName(longer.substr(0, name.size())) == foldName(name) &&
           std::all_of(longer.begin() + static_cast<std::ptrdiff_t>(name.size()), longer.end(), isDigit);
}

/// "VAR num := 5;": no word in it can be its name.
bool lostName(const SyntaxTree& tree, const DataDecl& decl) {
    const bool noName =
        decl.name == kNoToken || tree.tokens[decl.name].kind == TokenKind::NumLiteral; // "1st"
    if (!noName || decl.type == kNoToken) return false;
    for (TokenIndex i = decl.type + 1; i <= decl.last; ++i) {
        const TokenKind kind = tree.tokens[i].kind;
        if (kind == TokenKind::Assign || kind == TokenKind::LeftBrace) break;
        if (kind == TokenKind::Identifier) return false;
    }
    return true;
}

/// ENDFOR without its FOR, which declared a variable. One right below another in the same column was written twice.
size_t lostLoops(const SyntaxTree& tree, const RoutineDecl& routine) {
    const auto columnOf = [&](TokenIndex i) { return tree.source->lineColumn(tree.tokens[i].offset).column; };
    size_t open = 0, lost = 0;
    for (TokenIndex i = routine.first; i <= routine.last; ++i) {
        if (tree.tokens[i].kind == TokenKind::KwFor) {
            ++open;
            const TokenKind next = tree.tokens[i + 1].kind; // no loop variable
            if (next == TokenKind::NumLiteral || next == TokenKind::KwFrom) ++lost;
        }
        if (tree.tokens[i].kind != TokenKind::KwEndfor) continue;
        const bool twice = i > routine.first && tree.tokens[i - 1].kind == TokenKind::KwEndfor &&
                           columnOf(i - 1) == columnOf(i);
        if (open > 0)
            --open;
        else if (!twice)
            ++lost;
    }
    return lost;
}

/// "VA": the beginning of a declaration that is being typed.
bool isUnfinished(const SyntaxTree& tree, const Decl& decl) {
    return decl.kind == NodeKind::ErrorDecl && decl.first == decl.last &&
           tree.tokens[decl.first].kind == TokenKind::Identifier;
}

/// The rest of a routine without the first word, or without the first line: up to its END word.
bool isRestOfRoutine(const SyntaxTree& tree, const Decl& decl) {
    constexpr TokenSet kEnds = {TokenKind::KwEndproc, TokenKind::KwEndfunc, TokenKind::KwEndtrap};
    if (decl.kind != NodeKind::ErrorDecl || kEnds.has(tree.tokens[decl.first].kind)) return false;
    for (TokenIndex i = decl.first; i <= decl.last; ++i)
        if (kEnds.has(tree.tokens[i].kind)) return true;
    return false;
}

} // namespace

Repeats::Repeats(State& state, const Parts& parts) : CheckerPart(state), scopes_(parts.scopes) {}

// Names in `where` are explained when there are no more of them than declarations that lost their names.
bool Repeats::explainUnknown(const Module& module, SourceRange where, bool routines, size_t lost) {
    if (lost == 0) return true;
    const auto concerned = [&](const UnknownName& unknown) {
        const bool data = unknown.code == say::UnknownName.code;
        return unknown.module == &module && !unknown.explained && !unknown.looksMisspelt &&
               unknown.code != say::UnknownType.code && data != routines &&
               unknown.where.begin >= where.begin && unknown.where.end <= where.end;
    };
    std::unordered_set<NameId> names;
    for (const UnknownName& unknown : task_.unknownNames)
        if (concerned(unknown)) names.insert(unknown.name);
    if (names.size() > lost) return false;
    for (UnknownName& unknown : task_.unknownNames)
        unknown.explained |= concerned(unknown);
    return true;
}

// "VAR num := 5;" and "PROC (num n)" are reported: whoever uses what they declare is not to blame.
// "PROC worknum n)": what calls "work" is right.
void Repeats::explainByType(const Module& module, std::string_view declared) {
    const std::string whole = foldName(declared);
    for (UnknownName& unknown : task_.unknownNames) {
        const std::string_view name = names_.folded(unknown.name);
        if (unknown.module != &module || whole.size() <= name.size() || !whole.starts_with(name)) continue;
        const Symbol* rest = scopes_.lookup(names_.intern(whole.substr(name.size())));
        unknown.explained |= rest && rest->kind == SymbolKind::Type;
    }
}

void Repeats::explainUnknown(const Module& module) {
    const SyntaxTree& tree = *module.tree;
    for (UnknownName& unknown : task_.unknownNames)
        if (unknown.module == &module && unknown.near && unknown.near->users == 0 && unknown.near->decl &&
            unknown.near->decl->broken && ranInto(names_.folded(unknown.name), unknown.near->name))
            unknown.explained = true;
    size_t lostData = 0, lostRoutines = 0;
    std::unordered_set<NameId> names; // of routines without their first words
    for (const Decl* decl : module.decl->decls) {
        if (isUnfinished(tree, *decl)) ++lostData;
        if (decl->kind == NodeKind::Data) lostData += lostName(tree, as<DataDecl>(*decl));
        if (isRestOfRoutine(tree, *decl)) {
            if (tree.tokens[decl->first].kind == TokenKind::Identifier &&
                tree.tokens[decl->first + 1].kind == TokenKind::LeftParen)
                names.insert(names_.intern(tree.text(decl->first)));
            else
                ++lostRoutines;
        }
        if (decl->kind != NodeKind::Routine) continue;
        const auto& routine = as<RoutineDecl>(*decl);
        if (routine.broken && routine.name != kNoToken) explainByType(module, tree.text(routine.name));
        lostRoutines += routine.name == kNoToken || tree.tokens[routine.name].kind == TokenKind::NumLiteral;
        size_t own = lostLoops(tree, routine);
        for (const DataDecl* data : routine.data)
            own += lostName(tree, *data);
        if (!explainUnknown(module, tree.range(*decl), false, own)) lostData += own;
    }
    for (UnknownName& unknown : task_.unknownNames)
        unknown.explained |= unknown.module == &module && names.contains(unknown.name);
    const SourceRange whole = tree.range(*module.decl);
    explainUnknown(module, whole, false, lostData);
    explainUnknown(module, whole, true, lostRoutines);
}

// What a name means that is missing in several routines: a declaration at module level, unless routines declare the
// name each for itself.
void Repeats::gatherUnknown(std::span<Module* const> modules) {
    for (const Module* module : modules)
        explainUnknown(*module);
    for (UnknownName& unknown : task_.unknownNames) { // what is inside of routines is soon forgotten
        const DataSymbol* data = asData(const_cast<Symbol*>(unknown.near));
        if (data && data->routine) unknown.near = nullptr;
    }
    std::map<std::pair<const Module*, NameId>, size_t> count;
    for (const UnknownName& unknown : task_.unknownNames)
        if (unknown.code == say::UnknownName.code) ++count[{unknown.module, unknown.name}];
    for (const Module* module : modules)
        for (const RoutineSymbol* routine : module->routines) {
            const auto drop = [&](const DataSymbol* own) {
                if (const auto found = count.find({module, own->nameId}); found != count.end())
                    found->second = 0;
            };
            for (const DataSymbol* param : routine->params)
                drop(param);
            for (const DataSymbol* data : routine->data)
                drop(data);
        }
    std::erase_if(task_.unknownNames, [&](const UnknownName& unknown) {
        if (!unknown.module || unknown.module->facts != modules.front()->facts)
            return false; // a value that another file needed
        const bool once = !unknown.explained && unknown.code == say::UnknownName.code &&
                          count[{unknown.module, unknown.name}] < 2;
        if (!once) task_.earlierUnknownNames.push_back(unknown);
        return true;
    });
}

// While the routines of a file are known: which of its errors have one cause.
void Repeats::gatherRepeats(std::span<Module* const> modules, size_t first) {
    if (state_.sink.all().size() < first + 2) return;
    const SourceFile* file = modules.front()->tree->source.get();
    std::vector<const Diagnostic*> said;
    for (size_t i = first; i < state_.sink.all().size(); ++i) {
        const Diagnostic& d = state_.sink.all()[i];
        if (d.file.get() == file && d.severity == diag::Severity::Error) said.push_back(&d);
    }
    if (said.size() < 2) return;
    std::vector<Repeat> found = findRepeats(program_, modules, said, reports_.misfits());
    putInOrder(found);
    for (Repeat& repeat : found) {
        if (repeat.guard) modules.front()->facts->open = true; // others may use it some day
        repeats_.push_back(std::move(repeat));
    }
}

// When all files are known.
void Repeats::mergeCauses() {
    std::vector<Repeat> repeats = std::exchange(repeats_, {});
    std::erase_if(repeats, [](const Repeat& r) { return r.guard && r.guard->users > 1; });
    std::unordered_map<diag::CauseId, std::optional<Diagnostic>> fate; // by cause: what is reported instead
    std::map<std::tuple<const Module*, NameId, Code>, Repeat> byName;
    std::unordered_map<diag::CauseId, Repeat*> unknown; // by cause
    std::vector<UnknownName> names = std::exchange(task_.earlierUnknownNames, {});
    names.insert(names.end(), task_.unknownNames.begin(), task_.unknownNames.end());
    task_.unknownNames.clear();
    for (const UnknownName& name : names) {
        if (name.explained) fate[name.cause] = std::nullopt;
        // A name that looks misspelt is a mistake each time, unless it is the declaration that is misspelt.
        if (name.explained || (name.looksMisspelt && (!name.near || name.near->users > 0))) continue;
        unknown[name.cause] = &byName[{name.module, name.name, name.code}];
    }
    if (unknown.size() > 1)
        for (const Diagnostic& d : state_.sink.all())
            if (const auto found = unknown.find(d.cause); found != unknown.end())
                found->second->members.push_back(d);
    for (auto& [key, repeat] : byName) {
        std::sort(repeat.members.begin(), repeat.members.end(),
                  [](const Diagnostic& a, const Diagnostic& b) { return a.range.begin < b.range.begin; });
        repeats.push_back(std::move(repeat));
    }
    for (Repeat& repeat : repeats) {
        std::erase_if(repeat.members, [&](const Diagnostic& d) { return fate.contains(d.cause); });
        if (repeat.members.size() < 2) continue;
        for (const Diagnostic& d : repeat.members)
            fate[d.cause] = std::nullopt;
        fate[repeat.members.front().cause] = leadOf(repeat);
    }
    if (fate.empty()) return mergeLineCauses(state_.sink);
    state_.sink.revise([&](Diagnostic& d) {
        const auto found = fate.find(d.cause);
        if (found == fate.end()) return true;
        if (!found->second) return false;
        d = *std::exchange(found->second, std::nullopt); // once, were it there twice
        return true;
    });
    mergeLineCauses(state_.sink);
}

void mergeLineCauses(diag::Sink& sink) {
    std::map<diag::CauseId, SourceRange> ends; // of lines without their semicolon
    for (const Diagnostic& d : sink.all())
        if (d.code == say::MissingSemicolon.code) ends.emplace(d.cause, d.range);
    if (ends.empty()) return;
    std::set<diag::CauseId> merged;
    sink.revise([&](Diagnostic& d) {
        const auto end = d.severity == diag::Severity::Error ? ends.find(d.line) : ends.end();
        if (end != ends.end() && merged.insert(d.line).second) // the first report about the line
            d.notes.push_back({d.file, end->second, "and ';' is missing here"});
        return true;
    });
    if (merged.empty()) return;
    sink.revise([&](const Diagnostic& d) {
        return d.code != say::MissingSemicolon.code || !merged.contains(d.cause);
    });
}

} // namespace rapid::sema
