#include "frontend/edit/rename.h"

#include "frontend/edit/apply_edits.h"
#include "frontend/sema/names.h"
#include "frontend/sema/references.h"
#include "frontend/syntax/lexer.h"
#include "frontend/syntax/limits.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace rapid::edit {

using namespace syntax;
using sema::Reference;
using sema::Symbol;
using sema::SymbolKind;

namespace {

/// A declaration as a place, equal in the checks before and after: files keep their number of tokens.
struct Site {
    std::string path;
    TokenIndex token = kNoToken;
    auto operator<=>(const Site&) const = default;
};

bool isConfigured(const Symbol& symbol) {
    return symbol.kind == SymbolKind::Data &&
           static_cast<const sema::DataSymbol&>(symbol).storage == sema::Storage::Signal;
}

/// Predefined names and configured objects have no place in the files of the program: their name represents it.
bool isOutside(const Symbol& symbol) {
    return symbol.predefined || isConfigured(symbol) || !symbol.module;
}

Site siteOf(const Symbol& symbol) {
    if (isOutside(symbol)) return {sema::foldName(symbol.name), kNoToken};
    return {symbol.module->tree->source->path(), symbol.nameToken};
}

std::string placeOf(const SyntaxTree& tree, TokenIndex token) {
    const LineColumn at = tree.source->lineColumn(tree.tokens[token].offset);
    return fmt::format("{}:{}:{}", tree.source->path(), at.line, at.column);
}

/// "MODULE.NAME" or "MODULE.ROUTINE.NAME"
std::string pathOf(const Symbol& symbol) {
    const sema::RoutineSymbol* routine = nullptr;
    if (symbol.kind == SymbolKind::Data) routine = static_cast<const sema::DataSymbol&>(symbol).routine;
    if (symbol.kind == SymbolKind::Label) routine = static_cast<const sema::LabelSymbol&>(symbol).routine;
    const std::string module = symbol.module ? symbol.module->name + "." : "";
    return routine ? module + routine->name + "." + symbol.name : module + symbol.name;
}

bool isSharedPersistent(const Symbol& symbol) {
    if (symbol.kind != SymbolKind::Data || symbol.isLocal) return false;
    const auto& data = static_cast<const sema::DataSymbol&>(symbol);
    return data.storage == sema::Storage::ModuleData && data.dataKind == DataKind::Pers &&
           data.scope == ScopeWord::None;
}

size_t characters(std::string_view name) {
    return static_cast<size_t>(std::count_if(
        name.begin(), name.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// The meaning of the names of a program, without the program: a large one does not stay in memory during the second check.
class Meanings {
  public:
    /// A name and the declaration it means, of which `place` is the file or, outside of the files, the name itself.
    struct Meaning {
        TokenIndex token = kNoToken;
        uint32_t place = 0;
        TokenIndex declared = kNoToken;
        bool operator==(const Meaning&) const = default;
    };

    Meaning of(const Reference& reference) {
        const Symbol& symbol = *reference.symbol;
        const bool outside = isOutside(symbol);
        const void* key = outside ? static_cast<const void*>(&symbol) : symbol.module->tree;
        const auto [known, isNew] = known_.try_emplace(key, 0);
        if (isNew) {
            const std::string name = siteOf(symbol).path;
            known->second = numbers_.try_emplace(name, static_cast<uint32_t>(numbers_.size())).first->second;
        }
        return {reference.token, known->second, outside ? kNoToken : symbol.nameToken};
    }

    void keep(const std::vector<Reference>& references) {
        kept_.reserve(references.size());
        for (const Reference& reference : references)
            kept_.push_back(of(reference));
        known_.clear(); // the addresses of the next program are others
    }

    const std::vector<Meaning>& kept() const { return kept_; }

  private:
    std::vector<Meaning> kept_;
    std::unordered_map<std::string, uint32_t> numbers_; ///< of places
    std::unordered_map<const void*, uint32_t> known_;   ///< the same by tree or symbol
};

class Renamer {
  public:
    Renamer(const std::vector<sema::TaskInput>& tasks, const sema::CheckOptions& options,
            std::string_view path, std::string_view newName)
        : tasks_(tasks), options_(options), path_(path), newName_(newName) {}

    EditSet run(std::unique_ptr<const sema::CheckedProgram> program) {
        if (std::string bad = newNameProblem(newName_, *program); !bad.empty()) return refuse(std::move(bad));
        auto references = sema::collectReferences(*program);
        if (std::string bad = choose(*program, references); !bad.empty()) return refuse(std::move(bad));
        collectEdits(references);
        noteNamesOfRunTime(*program);
        before_.keep(references);
        references = {};
        program.reset();
        if (std::string bad = verify(); !bad.empty()) return refuse(std::move(bad));
        return std::move(set_);
    }

  private:
    static EditSet refuse(std::string problem) {
        EditSet set;
        set.problem = std::move(problem);
        return set;
    }

    static std::string foldedPathOf(const Symbol& symbol) { return sema::foldName(pathOf(symbol)); }

    bool matches(const Symbol& symbol) const {
        const std::string full = foldedPathOf(symbol), wanted = sema::foldName(path_);
        if (full == wanted) return true;
        return wanted.find('.') == std::string::npos && sema::foldName(symbol.name) == wanted;
    }

    /// Finds the declarations that `path_` means; a problem if it means none or several.
    std::string choose(const sema::CheckedProgram& program, const std::vector<Reference>& references) {
        std::map<Site, const Symbol*> found;
        const Symbol* outside = nullptr;
        for (const Reference& reference : references) {
            if (!matches(*reference.symbol)) continue;
            const Site site = siteOf(*reference.symbol);
            if (site.token == kNoToken)
                outside = reference.symbol;
            else
                found.emplace(site, reference.symbol);
        }
        if (found.empty() && outside)
            return fmt::format("'{}' is {}: it cannot be renamed here", outside->name,
                               outside->predefined ? "predefined" : "a name of the configuration");
        if (found.empty()) return fmt::format("no declaration is named '{}'", path_);
        const Symbol& first = *found.begin()->second;
        const bool shared = std::all_of(found.begin(), found.end(),
                                        [](const auto& entry) { return isSharedPersistent(*entry.second); });
        // Loops of one routine may have variables of the same name, which a path cannot distinguish.
        const bool same = std::all_of(found.begin(), found.end(), [&](const auto& entry) {
            return entry.first.path == found.begin()->first.path &&
                   foldedPathOf(*entry.second) == foldedPathOf(first);
        });
        if (found.size() > 1 && !shared && !same) return severalThings(found);
        for (const auto& task : program.tasks)
            for (const auto& [site, symbol] : found)
                if (task->entryRoutine && siteOf(*task->entryRoutine) == site)
                    return fmt::format("task {} starts with '{}': it cannot be renamed", task->name,
                                       symbol->name);
        addTargets(first, references);
        for (const auto& [site, symbol] : found)
            targets_.insert(site);
        return {};
    }

    /// Tasks may have modules of the same name: then the files tell them apart.
    std::string severalThings(const std::map<Site, const Symbol*>& found) const {
        std::map<std::string, std::set<std::string>> files; // by path
        for (const auto& [site, symbol] : found)
            files[pathOf(*symbol)].insert(site.path);
        std::vector<std::string> all;
        bool inOneFile = true;
        for (const auto& [path, places] : files) {
            for (const std::string& place : places)
                all.push_back(places.size() == 1 ? path : fmt::format("{} in {}", path, place));
            inOneFile = inOneFile && places.size() == 1;
        }
        return fmt::format("'{}' names several things: {} {}", path_,
                           inOneFile ? "choose one of" : "name the files of one task; there are",
                           fmt::join(all, ", "));
    }

    /// The chosen declaration and, for a shared persistent, those of the same name in the other tasks.
    void addTargets(const Symbol& chosen, const std::vector<Reference>& references) {
        oldName_ = sema::foldName(chosen.name);
        oldPath_ = pathOf(chosen);
        isRoutine_ = chosen.kind == SymbolKind::Routine;
        isParameter_ = chosen.kind == SymbolKind::Data &&
                       static_cast<const sema::DataSymbol&>(chosen).storage == sema::Storage::Parameter;
        targets_.insert(siteOf(chosen));
        if (!isSharedPersistent(chosen)) return;
        for (const Reference& reference : references)
            if (reference.isDeclaration && isSharedPersistent(*reference.symbol) &&
                sema::foldName(reference.symbol->name) == oldName_)
                targets_.insert(siteOf(*reference.symbol));
    }

    void collectEdits(const std::vector<Reference>& references) {
        std::map<std::string, std::map<uint32_t, TextEdit>> byFile;
        std::map<std::string, std::shared_ptr<const SourceFile>> files;
        for (const Reference& reference : references) {
            if (!targets_.contains(siteOf(*reference.symbol))) continue;
            const SyntaxTree& tree = *reference.module->tree;
            if (tree.text(reference.token) == newName_) continue;
            const SourceRange range = tree.range(reference.token);
            byFile[tree.source->path()][range.begin] = {range, newName_};
            files[tree.source->path()] = tree.source;
        }
        for (auto& [path, edits] : byFile) {
            FileEdits& file = set_.files.emplace_back();
            file.file = files[path];
            for (auto& [at, edit] : edits)
                file.edits.push_back(std::move(edit));
        }
    }

    /// Checks the changed program and compares what every name means.
    std::string verify() {
        std::unordered_map<std::string, std::shared_ptr<const SourceFile>> sources;
        for (const FileEdits& file : set_.files) {
            auto result = applyEdits(*file.file, file.edits);
            if (!result.ok()) return file.file->path() + ": " + result.problem;
            sources[file.file->path()] =
                std::make_shared<const SourceFile>(file.file->path(), std::move(result.bytes));
        }
        std::vector<sema::TaskInput> changed = tasks_;
        for (sema::TaskInput& task : changed)
            for (auto& file : task.files)
                if (const auto found = sources.find(file->path()); found != sources.end())
                    file = found->second;
        diag::Sink sink;
        const auto after = sema::check(changed, options_, sink);
        for (const diag::Diagnostic& diagnostic : sink.sorted())
            if (diagnostic.severity == diag::Severity::Error) return clash(diagnostic);
        return compare(sema::collectReferences(*after));
    }

    std::string clash(const diag::Diagnostic& diagnostic) const {
        const std::string where = diagnostic.file
                                      ? fmt::format("{}:{}: ", diagnostic.file->path(),
                                                    diagnostic.file->lineColumn(diagnostic.range.begin).line)
                                      : "";
        return fmt::format("'{}' clashes: {}{}", newName_, where, diagnostic.message);
    }

    std::string compare(const std::vector<Reference>& after) {
        const auto& before = before_.kept();
        for (size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
            const Reference& now = after[i];
            if (before_.of(now) == before[i]) continue;
            const std::string_view name = now.module->tree->text(now.token);
            return fmt::format("at {} the name '{}' would mean '{}' instead of '{}': choose another name",
                               placeOf(*now.module->tree, now.token), name, pathOf(*now.symbol),
                               oldPathOf(before[i], after));
        }
        return before.size() == after.size() ? "" : "a name would lose its meaning: choose another name";
    }

    /// The name of what was meant before: its declaration has only been renamed.
    std::string oldPathOf(const Meanings::Meaning& meant, const std::vector<Reference>& after) {
        for (const Reference& reference : after) {
            const Meanings::Meaning now = before_.of(reference);
            if (now.place != meant.place || now.declared != meant.declared) continue;
            return targets_.contains(siteOf(*reference.symbol)) ? oldPath_ : pathOf(*reference.symbol);
        }
        return oldPath_;
    }

    /// Strings may name routines and data (late binding, GetDataVal ...); what is known at run time only is pointed at.
    void noteNamesOfRunTime(const sema::CheckedProgram& program) {
        std::unordered_set<const SyntaxTree*> ofUser;
        for (const auto& task : program.tasks)
            for (const sema::Module* module : task->modules)
                ofUser.insert(module->tree);
        for (size_t i = 0; i < program.trees.size(); ++i) {
            const auto& tree = program.trees[i];
            if (!ofUser.contains(tree.get())) continue;
            for (TokenIndex t = 0; t < tree->tokens.size(); ++t)
                if (tree->tokens[t].kind == TokenKind::StringLiteral && spelt(*tree, t) == oldName_)
                    note(*tree, t, fmt::format("the string {} stays as it is", tree->text(t)));
            if (isRoutine_ || isParameter_)
                for (const ModuleDecl* module : tree->modules)
                    noteLateCalls(*tree, *program.facts[i], *module);
        }
    }

    static std::string spelt(const SyntaxTree& tree, TokenIndex string) {
        return sema::foldName(decodeStringLiteral(tree.text(string)));
    }

    void note(const SyntaxTree& tree, TokenIndex token, std::string_view what) {
        std::string text = fmt::format("{}: {}", placeOf(tree, token), what);
        if (std::find(set_.notes.begin(), set_.notes.end(), text) == set_.notes.end())
            set_.notes.push_back(std::move(text));
    }

    void noteLateCalls(const SyntaxTree& tree, const sema::FileFacts& facts, const Node& node) {
        if (node.kind == NodeKind::CallStmt) {
            const auto& call = as<CallStmt>(node);
            const auto bound = facts.calls.find(&node);
            const bool byNumber = bound != facts.calls.end() && bound->second.routine &&
                                  bound->second.routine->role == sema::Role::CallByVar && !call.args.empty();
            if (isRoutine_ && call.lateName) noteBeginnings(tree, *call.lateName);
            if (isRoutine_ && byNumber) noteBeginnings(tree, *call.args.front());
            if (isParameter_ && call.lateName)
                for (const Argument* arg : call.args)
                    if (arg->name != kNoToken && sema::foldName(tree.text(arg->name)) == oldName_)
                        note(tree, arg->name,
                             fmt::format("the argument '{}' of a call by name stays as it is",
                                         tree.text(arg->name)));
            return;
        }
        forEachChild(node, [&](const Node& child) { noteLateCalls(tree, facts, child); });
    }

    /// `%"proc"+NumToStr(n,0)%`, `CallByVar "proc",n`: "proc1" may be meant.
    void noteBeginnings(const SyntaxTree& tree, const Node& name) {
        for (TokenIndex t = name.first; t <= name.last; ++t) {
            if (tree.tokens[t].kind != TokenKind::StringLiteral) continue;
            const std::string beginning = spelt(tree, t);
            if (!beginning.empty() && beginning != oldName_ && oldName_.starts_with(beginning))
                note(tree, t,
                     fmt::format("the string {}, with which the old name begins, stays as it is",
                                 tree.text(t)));
        }
    }

    const std::vector<sema::TaskInput>& tasks_;
    const sema::CheckOptions& options_;
    std::string path_;
    std::string newName_;
    std::string oldName_; ///< folded
    std::string oldPath_;
    Meanings before_;
    bool isRoutine_ = false, isParameter_ = false;
    std::set<Site> targets_;
    EditSet set_;
};

} // namespace

namespace {

/// The name in a message of one line: control characters and DEL as `\xNN`.
std::string shown(std::string_view name) {
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < ' ' || byte == 0x7F)
            text += fmt::format("\\x{:02X}", byte);
        else
            text += c;
    }
    return text;
}

} // namespace

std::string newNameProblem(std::string_view name, const sema::CheckedProgram& program, bool component) {
    const std::string text(name);
    const LexResult lexed = lex(text);
    const bool word =
        lexed.tokens.size() == 2 && lexed.errors.empty() && lexed.tokens[0].length == name.size();
    if (word && isKeyword(lexed.tokens[0].kind))
        return fmt::format("'{}' is a word of the language: choose another name", name);
    if (!word || lexed.tokens[0].kind != TokenKind::Identifier)
        return fmt::format(
            "'{}' is not a name: expected letters of ISO 8859-1, digits and '_', a letter first",
            shown(name));
    if (characters(name) > syntax::kMaxNameLength)
        return fmt::format("'{}' has more than {} characters", name, syntax::kMaxNameLength);
    if (component) return {};
    const std::string folded = sema::foldName(name);
    for (const sema::Module* module : program.predefinedModules) {
        const auto has = [&](const auto& symbols) {
            return std::any_of(symbols.begin(), symbols.end(),
                               [&](const auto* symbol) { return sema::foldName(symbol->name) == folded; });
        };
        if (has(module->types) || has(module->data) || has(module->routines))
            return fmt::format("'{}' is predefined: choose another name, so that it is not hidden", name);
    }
    return {};
}

EditSet rename(std::unique_ptr<const sema::CheckedProgram> program, const std::vector<sema::TaskInput>& tasks,
               const sema::CheckOptions& options, std::string_view path, std::string_view newName) {
    return Renamer(tasks, options, path, newName).run(std::move(program));
}

} // namespace rapid::edit
