// Names that nothing declares: what may be said about them, and what was probably meant.

#include "frontend/sema/unknown.h"
#include "frontend/sema/add_ins.h"
#include "frontend/sema/analyzer.h"
#include "frontend/sema/parts.h"
#include "frontend/sema/place.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/token_set.h"

namespace rapid::sema {

using namespace syntax;

namespace {

constexpr TokenSet kDeclaring = {TokenKind::KwVar,  TokenKind::KwPers, TokenKind::KwConst, TokenKind::KwProc,
                                 TokenKind::KwFunc, TokenKind::KwTrap, TokenKind::KwRecord};

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
    const std::string_view text = tree.source->text();
    std::vector<std::string> names; // that end at the word before
    const size_t own = tokenText(kindAt(word)).size();
    if (tree.text(word).size() > own)
        state_.task.maybeDeclared.insert(state_.names.intern(tree.text(word).substr(own)));
    for (TokenIndex i = word + 1; i < word + kMost && !kEnd.has(kindAt(i)); ++i) {
        const uint32_t gap = tree.range(i - 1).end;
        if (text.substr(gap, tree.tokens[i].offset - gap).find_first_of("\r\n") != std::string_view::npos)
            return;
        if (!data && kindAt(i) == TokenKind::LeftParen) return;
        if (kindAt(i) != TokenKind::Identifier && kindAt(i) != TokenKind::NumLiteral && !isKeyword(kindAt(i)))
            continue;
        std::vector<std::string> longer = {std::string(tree.text(i))};
        for (const std::string& name : names) {
            longer.push_back(name + longer.front());
            longer.push_back(name + "_" + longer.front());
        }
        for (const std::string& name : longer)
            state_.task.maybeDeclared.insert(state_.names.intern(name));
        names = std::move(longer);
    }
}

// After a syntax error a name may be missing because its declaration could not be read: whoever uses it is not to
// blame. Such a declaration still shows two words in a row, the second of which is the name.
bool UnknownNames::mayReportUnknown(NameId name) {
    if (state_.context.module) facts().open = true;
    for (const SyntaxTree* tree : std::exchange(state_.task.brokenTrees, {})) {
        for (size_t i = 0; tree && i + 1 < tree->tokens.size(); ++i) {
            const TokenKind before = tree->tokens[i].kind;
            const bool declares = before == TokenKind::Identifier || before == TokenKind::KwProc ||
                                  before == TokenKind::KwTrap || before == TokenKind::KwRecord;
            if (declares && tree->tokens[i + 1].kind == TokenKind::Identifier)
                state_.task.maybeDeclared.insert(
                    state_.names.intern(tree->text(static_cast<TokenIndex>(i + 1))));
            if (kDeclaring.has(before) && !isWhole(*tree, i))
                mayDeclareTorn(*tree, static_cast<TokenIndex>(i));
        }
    }
    return !state_.task.maybeDeclared.contains(name);
}

// Whether a FOR of this routine, ahead of `token`, counts a variable of that name.
bool UnknownNames::countedAbove(TokenIndex token, NameId name) {
    const TokenIndex first = state_.context.routine->decl->first;
    if (first >= token || state_.task.comparisonsLeft < token - first) return false;
    state_.task.comparisonsLeft -= token - first;
    for (TokenIndex i = first; i + 1 < token; ++i)
        if (state_.context.tree->tokens[i].kind == TokenKind::KwFor &&
            state_.context.tree->tokens[i + 1].kind == TokenKind::Identifier && idOf(i + 1) == name)
            return true;
    return false;
}

// "G ripOpen;", "p-Pick": the word and the one behind it are a name that is known. True also at the second word.
bool UnknownNames::reportTorn(TokenIndex token) {
    if (token == tornUntil_ && tornTree_ == state_.context.tree) return true;
    const auto& tokens = state_.context.tree->tokens;
    const bool hyphen = tokens[token + 1].kind == TokenKind::Minus;
    const TokenIndex last = hyphen ? token + 2 : token + 1;
    if (last >= tokens.size() || tokens[last].kind != TokenKind::Identifier) return false;
    const SourceRange whole{range(token).begin, range(last).end};
    const std::string_view shown =
        state_.context.tree->source->text().substr(whole.begin, whole.end - whole.begin);
    constexpr size_t kLongest = 40;
    const bool blank = shown.find_first_of(" \t\r\n") != std::string_view::npos;
    if (shown.size() > kLongest || blank == hyphen || shown.find_first_of("\r\n!") != std::string_view::npos)
        return false;
    const std::string head(text(token)), tail(text(last));
    const Symbol* joined = scopes_.lookup(state_.names.intern(head + tail));
    const Symbol* linked = hyphen ? scopes_.lookup(state_.names.intern(head + "_" + tail)) : nullptr;
    const Symbol* meant = joined ? joined : linked;
    if (!meant) return false;
    tornUntil_ = last;
    tornTree_ = state_.context.tree;
    report(Code::UnexpectedToken, whole,
           {"'" + std::string(shown) + "'", "'" + meant->name + "': a name is one word"})
        .fix(whole, meant->name, !scopes_.lookup(idOf(last)) && !(joined && linked));
    return true;
}

Meant UnknownNames::reportUnknown(Code code, TokenIndex token, NameId name, Wanted wanted,
                                  std::string_view otherHint) {
    if (!mayReportUnknown(name) || reportTorn(token)) return Meant::Unknown;
    Suggestion best = suggestions_.suggestion(name, wanted);
    std::string hint(otherHint);
    if (!best.name.empty()) hint = didYouMean(best.name);
    if (wanted == Wanted::Data && (!best.symbol || best.symbol->predefined)) {
        if (std::string others = suggestions_.inSeries(state_.names.folded(name)); !others.empty()) {
            hint = std::move(others);
            best = {};
        }
    }
    const Meant meant = best.isKeyword ? Meant::Keyword : Meant::Unknown;
    if (const std::string_view where =
            addInOf(state_.names.folded(name), wanted == Wanted::Type, !best.name.empty());
        !where.empty()) {
        if (state_.task.reportedNames.insert(name).second)
            report(Code::MayBeDeclared, range(token), {text(token), std::string(where), ""});
        return Meant::Elsewhere;
    }
    if (state_.task.incomplete) {
        if (state_.task.reportedNames.insert(name).second) reportMayBeDeclared(token, hint);
        return Meant::Elsewhere;
    }
    // A routine that is missing is one mistake; a name that looks misspelt is one each time.
    const bool routine = wanted != Wanted::Data && wanted != Wanted::Type;
    if (routine && state_.context.routine && best.name.empty() &&
        !state_.routine.unknownRoutines.insert(name).second)
        return meant;
    for (const Module* module : state_.task.task ? state_.task.task->modules : std::vector<Module*>()) {
        const Symbol* local =
            module == state_.context.module ? nullptr : state_.scopes[module->id]->names.find(name);
        if (!local || !suggestions_.isWanted(*local, wanted)) continue;
        noteDeclared(report(Code::LocalElsewhere, range(token), {text(token), module->name}), *local);
        return Meant::Unknown;
    }
    diag::Diagnostic& d = report(code, range(token), {text(token), hint});
    if (!best.name.empty()) d.fix(range(token), best.name, false);
    constexpr size_t kMany = 2000; // nobody reads so many messages
    if (state_.reports.isUnsaid(d) || state_.task.unknownNames.size() >= kMany) return meant;
    const bool declared = best.symbol && !best.symbol->predefined;
    state_.task.unknownNames.push_back({state_.context.module, name, code, range(token), !best.name.empty(),
                                        declared ? best.symbol : nullptr, false});
    return meant;
}

void UnknownNames::reportMayBeDeclared(TokenIndex token, const std::string& hint) {
    const std::string where = state_.task.missingModules.empty()
                                  ? "a module that is not here, such as a system module"
                                  : listed(state_.task.missingModules);
    report(Code::MayBeDeclared, range(token), {text(token), where, hint});
}

// An unknown name as data: a signal where one is expected or where it is used as one elsewhere, otherwise an error.
Symbol* UnknownNames::reportUnknownData(TokenIndex token, NameId name, const Type* handle) {
    facts().open = true;
    const bool camera = handle && handle->base()->name == "cameradev";
    const bool object = camera || (handle && handle->base()->name == "mecunit");
    const Type* type = handle && handle->kind == TypeKind::SemiValue ? handle : nullptr;
    if (!type && !object && state_.context.routine) type = signals_.signalTypeByUse(name);
    const bool open = !type && !object && state_.context.routine;
    if (open && (!state_.task.incomplete || state_.options.assumeSignals))
        type = signals_.signalTypeByName(text(token));
    const bool perhaps = open && !type && comparisonsTell();
    if (perhaps) type = signals_.signalTypeByComparison(text(token), name);
    // A signal that cannot come: the name is left to the modules that are missing, which may declare it.
    if (state_.task.incomplete && state_.options.configurationKnown && !state_.options.assumeSignals)
        type = nullptr;
    if (!type && !object) {
        if (state_.task.moduleNames.find(name)) {
            report(Code::NotData, range(token), {text(token), "a module"});
        } else if (!state_.context.routine ||
                   !state_.context.routine->incomplete) { // else it may be a parameter
            const char* hint = "";
            if (state_.context.routine && countedAbove(token, name))
                hint = "; a loop variable is known only between FOR and ENDFOR";
            else if (looksLikeSignal(state_.names.folded(name)))
                hint = state_.options.configurationKnown
                           ? "; if it is a signal, define it in EIO.cfg and pass that with --config"
                           : "; if it is a signal, pass the configuration with --config=EIO.cfg";
            reportUnknown(Code::UnknownName, token, name, Wanted::Data, hint);
        }
        if (state_.context.routine) scopes_.declareUnknown(name);
        return nullptr;
    }
    if (state_.task.reportedNames.insert(name).second && mayReportUnknown(name)) {
        if (state_.task.incomplete && !perhaps && !state_.options.assumeSignals)
            reportMayBeDeclared(token, {});
        else if (object)
            report(camera ? Code::CameraUnknown : Code::MechanicalUnitUnknown, range(token), {text(token)});
        else
            reportSignal(token, name, *type, perhaps);
    }
    return scopes_.configuredObject(name, text(token), object ? handle : type, true);
}

// Whether a comparison with a number is enough to take a name for a signal: without a configuration, and where no module
// that is known to be missing may declare it.
bool UnknownNames::comparisonsTell() const {
    if (state_.options.assumeSignals) return true;
    return !state_.options.configurationKnown && state_.task.missingModules.empty();
}

// A signal that no configuration defines. `perhaps`: nothing but a comparison says that it is one.
void UnknownNames::reportSignal(TokenIndex token, NameId name, const Type& type, bool perhaps) {
    if (state_.options.assumeSignals) return; // the command says which ones it assumes
    const std::string written = text(token);
    if (!state_.options.configurationKnown) {
        report(Code::SignalUnknown, range(token),
               {perhaps ? "'" + written + "'" : "signal '" + written + "'",
                perhaps ? "may be a signal" : "is taken as configured"});
        return;
    }
    const Suggestion near = suggestions_.suggestion(name, Wanted::Signal);
    const bool fits = near.symbol && static_cast<const DataSymbol*>(near.symbol)->type.type == &type;
    diag::Diagnostic& d =
        report(Code::SignalUndefined, range(token), {written, fits ? didYouMean(near.name) : std::string()});
    if (fits) d.fix(range(token), near.name, false);
}

} // namespace rapid::sema
