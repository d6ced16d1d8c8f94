// Names that nothing declares: what may be said about them, and what was probably meant.

#include "frontend/sema/unknown.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/add_ins.h"
#include "frontend/sema/analyzer.h"
#include "frontend/sema/place.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

namespace rapid::sema {

using namespace syntax;

namespace {

constexpr TokenSet kDeclaring = {TokenKind::KwVar,  TokenKind::KwPers, TokenKind::KwConst, TokenKind::KwProc,
                                 TokenKind::KwFunc, TokenKind::KwTrap, TokenKind::KwRecord};

/// `(num n`, `(\switch fast`, `(VAR num n`: the beginning of parameters, which a call does not have.
bool beginsParameters(const SyntaxTree& tree, size_t token) {
    constexpr TokenSet kModes = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwInout};
    const auto kind = [&](size_t t) {
        return t < tree.tokens.size() ? tree.tokens[t].kind : TokenKind::EndOfFile;
    };
    if (kind(token) != TokenKind::LeftParen) return false;
    const size_t first = kind(token + 1) == TokenKind::Backslash ? token + 2 : token + 1;
    return kModes.has(kind(first)) ||
           (kind(first) == TokenKind::Identifier && kind(first + 1) == TokenKind::Identifier);
}

/// Whether a token is in the line of the one before it.
bool continuesLine(const SyntaxTree& tree, TokenIndex token) {
    return gapBefore(tree, token).find_first_of("\r\n") == std::string_view::npos;
}

/// A declaration that begins as it should, from its word on.
bool isWhole(const SyntaxTree& tree, size_t word) {
    constexpr TokenSet kAfterName = {TokenKind::Semicolon, TokenKind::Assign,     TokenKind::LeftBrace,
                                     TokenKind::LeftParen, TokenKind::RightParen, TokenKind::Comma,
                                     TokenKind::Backslash, TokenKind::Bar};
    const bool named = tree.tokens[word].kind == TokenKind::KwProc;
    const size_t after = word + (named ? 2 : 3); // one word, or data type and name
    if (after >= tree.tokens.size() || !kAfterName.has(tree.tokens[after].kind)) return false;
    for (size_t i = word + 1; i < after; ++i)
        if (tree.tokens[i].kind != TokenKind::Identifier) return false;
    return true;
}

/// di1, doGrip, gi_part: the usual way to name signals. Only used to word a remedy.
bool looksLikeSignal(std::string_view name) {
    static constexpr std::string_view kPrefixes[] = {"di", "do", "gi", "go", "ai", "ao"};
    for (const std::string_view prefix : kPrefixes)
        if (name.starts_with(prefix) && name.size() > 2) return true;
    return false;
}

/// "'a', 'b' or 'c'"; of many the first few.
std::string listed(const std::vector<std::string>& names) {
    constexpr size_t kShown = 3;
    std::string out;
    const size_t shown = names.size() > kShown + 1 ? kShown : names.size();
    for (size_t i = 0; i < shown; ++i) {
        if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
        out += "'" + names[i] + "'";
    }
    if (shown < names.size()) out += " or one of " + std::to_string(names.size() - shown) + " other modules";
    return out;
}

} // namespace

UnknownNames::UnknownNames(State& state, const Parts& parts)
    : CheckerPart(state), scopes_(parts.scopes), signals_(parts.signals), suggestions_(parts.suggestions) {}

// "CONST num n Rows:=4;", "PROC my-name()": all words of the line up to the value or the list of parameters, and the names
// they give together.
void UnknownNames::mayDeclareTorn(const SyntaxTree& tree, TokenIndex word) {
    constexpr TokenSet kEnd = {TokenKind::Semicolon, TokenKind::Assign, TokenKind::Equal,
                               TokenKind::LeftBracket, TokenKind::EndOfFile};
    constexpr TokenIndex kMost = 8;
    const auto kindAt = [&](TokenIndex i) { return tree.tokens[i].kind; };
    const bool data = kindAt(word) == TokenKind::KwVar || kindAt(word) == TokenKind::KwPers ||
                      kindAt(word) == TokenKind::KwConst;
    std::vector<std::string> names; // that end at the word before
    const size_t own = tokenText(kindAt(word)).size();
    if (tree.text(word).size() > own) task_.maybeDeclared.insert(names_.intern(tree.text(word).substr(own)));
    for (TokenIndex i = word + 1; i < word + kMost && !kEnd.has(kindAt(i)); ++i) {
        if (!continuesLine(tree, i)) return;
        if (!data && kindAt(i) == TokenKind::LeftParen) return;
        if (kindAt(i) != TokenKind::Identifier && kindAt(i) != TokenKind::NumLiteral && !isKeyword(kindAt(i)))
            continue;
        std::vector<std::string> longer = {std::string(tree.text(i))};
        for (const std::string& name : names) {
            longer.push_back(name + longer.front());
            longer.push_back(name + "_" + longer.front());
        }
        for (const std::string& name : longer)
            task_.maybeDeclared.insert(names_.intern(name));
        names = std::move(longer);
    }
}

// After a syntax error a name may be missing because its declaration could not be read: its use is not the
// mistake. Such a declaration still shows two words in a line, the second of which is the name, and the first is not a
// procedure, as in `MoveL p10` or `pick p10`; or parameters follow the name.
bool UnknownNames::mayReportUnknown(NameId name) {
    if (context_.module) facts().open = true;
    const auto isRoutine = [&](std::string_view word) {
        const NameId id = names_.intern(word);
        const Symbol* known = at(task_.globals, id);
        if (!known) known = at(state_.predefined, id);
        return known && known->kind == SymbolKind::Routine;
    };
    for (const SyntaxTree* tree : std::exchange(task_.brokenTrees, {})) {
        for (TokenIndex i = 0; tree && i + 1 < tree->tokens.size(); ++i) {
            const TokenKind before = tree->tokens[i].kind;
            const bool declares = before == TokenKind::Identifier || before == TokenKind::KwProc ||
                                  before == TokenKind::KwTrap || before == TokenKind::KwRecord;
            if (declares && tree->tokens[i + 1].kind == TokenKind::Identifier &&
                continuesLine(*tree, i + 1) && !isRoutine(tree->text(i)))
                task_.maybeDeclared.insert(names_.intern(tree->text(i + 1)));
            if (before == TokenKind::Identifier && beginsParameters(*tree, i + 1))
                task_.maybeDeclared.insert(names_.intern(tree->text(i)));
            if (kDeclaring.has(before) && !isWhole(*tree, i)) mayDeclareTorn(*tree, i);
        }
    }
    return !task_.maybeDeclared.contains(name);
}

// Whether a FOR of this routine, before `token`, counts a variable of that name.
bool UnknownNames::countedAbove(TokenIndex token, NameId name) {
    const TokenIndex first = context_.routine->decl->first;
    if (first >= token || task_.comparisonsLeft < token - first) return false;
    task_.comparisonsLeft -= token - first;
    for (TokenIndex i = first; i + 1 < token; ++i)
        if (context_.tree->tokens[i].kind == TokenKind::KwFor &&
            context_.tree->tokens[i + 1].kind == TokenKind::Identifier && idOf(i + 1) == name)
            return true;
    return false;
}

// "G ripOpen;", "p-Pick": the word and the next one together are a known name. True also at the second word.
bool UnknownNames::reportTorn(TokenIndex token) {
    if (token == tornUntil_ && tornTree_ == context_.tree) return true;
    const auto& tokens = context_.tree->tokens;
    const bool hyphen = tokens[token + 1].kind == TokenKind::Minus;
    const TokenIndex last = hyphen ? token + 2 : token + 1;
    if (last >= tokens.size() || tokens[last].kind != TokenKind::Identifier) return false;
    const SourceRange whole{range(token).begin, range(last).end};
    const std::string_view shown = context_.tree->source->text().substr(whole.begin, whole.end - whole.begin);
    constexpr size_t kLongest = 40;
    const bool blank = shown.find_first_of(" \t\r\n") != std::string_view::npos;
    if (shown.size() > kLongest || blank == hyphen || shown.find_first_of("\r\n!") != std::string_view::npos)
        return false;
    const std::string head(text(token)), tail(text(last));
    const Symbol* joined = scopes_.lookup(names_.intern(head + tail));
    const Symbol* linked = hyphen ? scopes_.lookup(names_.intern(head + "_" + tail)) : nullptr;
    const Symbol* meant = joined ? joined : linked;
    if (!meant) return false;
    tornUntil_ = last;
    tornTree_ = context_.tree;
    report(say::UnexpectedToken, whole,
           {"'" + std::string(shown) + "'", "'" + meant->name + "': a name is one word"})
        .fix(whole, meant->name, !scopes_.lookup(idOf(last)) && !(joined && linked));
    return true;
}

std::pair<const Module*, const Symbol*> UnknownNames::localElsewhere(NameId name, Wanted wanted) {
    if (!task_.task || !suggestions_.nameLists().ofModules.contains(name)) return {};
    for (const Module* module : task_.task->modules) {
        const Symbol* local =
            module == context_.module ? nullptr : state_.scopes[module->id]->names.find(name);
        if (local && suggestions_.isWanted(*local, wanted)) return {module, local};
    }
    return {};
}

Meant UnknownNames::reportUnknown(diag::Message<2> message, TokenIndex token, NameId name, Wanted wanted,
                                  std::string_view otherHint) {
    if (!mayReportUnknown(name) || reportTorn(token)) return Meant::Unknown;
    Suggestion best = suggestions_.suggestion(name, wanted);
    std::string hint(otherHint);
    if (!best.name.empty()) hint = didYouMean(best.name);
    if (wanted == Wanted::Data && (!best.symbol || best.symbol->predefined)) {
        if (std::string others = suggestions_.inSeries(names_.folded(name)); !others.empty()) {
            hint = std::move(others);
            best = {};
        }
    }
    const Meant meant = best.isKeyword ? Meant::Keyword : Meant::Unknown;
    if (const std::string_view where =
            addInOf(names_.folded(name), wanted == Wanted::Type, !best.name.empty());
        !where.empty()) {
        if (task_.reportedNames.insert(name).second)
            report(say::MayBeDeclared, range(token), {text(token), std::string(where), ""});
        return Meant::Elsewhere;
    }
    if (task_.incomplete) {
        if (task_.reportedNames.insert(name).second) reportMayBeDeclared(token, hint);
        return Meant::Elsewhere;
    }
    // A routine that is missing is one mistake; a name that looks misspelt is one each time.
    const bool routine = wanted != Wanted::Data && wanted != Wanted::Type;
    if (routine && context_.routine && best.name.empty() && !routine_.unknownRoutines.insert(name).second)
        return meant;
    if (const auto [module, local] = localElsewhere(name, wanted); local) {
        noteDeclared(report(say::LocalElsewhere, range(token), {text(token), module->name}), *local);
        return Meant::Unknown;
    }
    diag::Diagnostic& d = report(message, range(token), {text(token), hint});
    if (!best.name.empty()) d.fix(range(token), best.name, false);
    if (reports_.isUnsaid(d) ||
        task_.unknownNames.size() + task_.earlierUnknownNames.size() + task_.elsewhere.unknown >= kMaxUnknown)
        return meant;
    const bool declared = best.symbol && !best.symbol->predefined;
    task_.unknownNames.push_back({context_.module, name, message.code, d.cause, range(token),
                                  !best.name.empty(), declared ? best.symbol : nullptr, false});
    return meant;
}

void UnknownNames::reportMayBeDeclared(TokenIndex token, const std::string& hint) {
    const std::string where = !task_.missingModules.empty() ? listed(task_.missingModules)
                              : task_.bindsLate ? "a module that is loaded later (BindRef of the task is off)"
                                                : "a module that is not here, such as a system module";
    report(say::MayBeDeclared, range(token), {text(token), where, hint});
}

// An unknown name as data: a signal where one is expected or where it is used as one elsewhere, otherwise an error.
Symbol* UnknownNames::reportUnknownData(TokenIndex token, NameId name, const Type* handle) {
    facts().open = true;
    const KnownType wanted = handle ? handle->base()->known : KnownType::None;
    const bool camera = wanted == KnownType::Camera;
    const bool object = camera || wanted == KnownType::MechanicalUnit;
    const Type* type = handle && handle->kind == TypeKind::SemiValue ? handle : nullptr;
    if (!type && !object && context_.routine) type = signals_.signalTypeByUse(name);
    const bool open = !type && !object && context_.routine;
    if (open && (!task_.incomplete || state_.options.assumeSignals))
        type = signals_.signalTypeByName(text(token));
    const bool perhaps = open && !type && comparisonsTell();
    if (perhaps) type = signals_.signalTypeByComparison(text(token), name);
    // A signal that cannot come: the name is left to the modules that are missing, which may declare it.
    if (task_.incomplete && state_.options.configurationKnown && !state_.options.assumeSignals)
        type = nullptr;
    if (!type && !object) {
        if (task_.moduleNames.find(name)) {
            report(say::NotData, range(token), {text(token), "a module"});
        } else if (!context_.routine || !context_.routine->incomplete) { // else it may be a parameter
            const char* hint = "";
            if (context_.routine && countedAbove(token, name))
                hint = "; a loop variable is known only between FOR and ENDFOR";
            else if (looksLikeSignal(names_.folded(name)))
                hint = state_.options.configurationKnown
                           ? "; if it is a signal, define it in EIO.cfg and pass that file with --config"
                           : "; if it is a signal, pass the configuration with --config=EIO.cfg";
            reportUnknown(say::UnknownName, token, name, Wanted::Data, hint);
        }
        if (context_.routine) scopes_.declareUnknown(name);
        return nullptr;
    }
    if (task_.reportedNames.insert(name).second && mayReportUnknown(name)) {
        if (task_.incomplete && !perhaps && !state_.options.assumeSignals)
            reportMayBeDeclared(token, {});
        else if (camera)
            report(say::CameraUnknown, range(token), {text(token)});
        else if (object)
            report(say::MechanicalUnitUnknown, range(token), {text(token)});
        else
            reportSignal(token, name, *type, perhaps);
    }
    return scopes_.configuredObject(name, text(token), object ? handle : type, true);
}

// Whether a comparison with a number is enough to take a name for a signal: without a configuration, and where no module
// that is known to be missing may declare it.
bool UnknownNames::comparisonsTell() const {
    if (state_.options.assumeSignals) return true;
    return !state_.options.configurationKnown && task_.missingModules.empty();
}

// A signal that no configuration defines. `perhaps`: nothing but a comparison says that it is one.
void UnknownNames::reportSignal(TokenIndex token, NameId name, const Type& type, bool perhaps) {
    if (state_.options.assumeSignals) return; // the command says which ones it assumes
    const std::string written = text(token);
    if (!state_.options.configurationKnown) {
        report(say::SignalUnknown, range(token),
               {perhaps ? "'" + written + "'" : "signal '" + written + "'",
                perhaps ? "but may be a signal" : "and is assumed to be configured"});
        return;
    }
    const Suggestion near = suggestions_.suggestion(name, Wanted::Signal);
    const bool fits = near.symbol && static_cast<const DataSymbol*>(near.symbol)->type.type == &type;
    diag::Diagnostic& d =
        report(say::SignalUndefined, range(token), {written, fits ? didYouMean(near.name) : std::string()});
    if (fits) d.fix(range(token), near.name, false);
}

} // namespace rapid::sema
