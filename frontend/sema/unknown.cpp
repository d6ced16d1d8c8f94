// Names that nothing declares: what may be said about them, and what was probably meant.

#include "frontend/sema/add_ins.h"
#include "frontend/sema/analysis.h"
#include "frontend/syntax/token_set.h"

#include <filesystem>

namespace rapid::sema {

using namespace syntax;

namespace {

struct Word {
    std::string_view folded;
    std::string_view spelling;
};
constexpr Word kInstructionWords[] = {{"goto", "GOTO"},   {"return", "RETURN"},     {"raise", "RAISE"},
                                      {"retry", "RETRY"}, {"trynext", "TRYNEXT"},   {"exit", "EXIT"},
                                      {"break", "BREAK"}, {"continue", "CONTINUE"}, {"connect", "CONNECT"},
                                      {"endif", "ENDIF"}, {"endwhile", "ENDWHILE"}, {"endfor", "ENDFOR"}};
constexpr TokenSet kDeclaring = {TokenKind::KwVar,  TokenKind::KwPers, TokenKind::KwConst, TokenKind::KwProc,
                                 TokenKind::KwFunc, TokenKind::KwTrap, TokenKind::KwRecord};
constexpr Word kValueWords[] = {{"true", "TRUE"}, {"false", "FALSE"}};

/// What programmers of other languages write for a predefined name.
struct ForeignName {
    std::string_view folded, meant;
};
constexpr ForeignName kForeignNames[] = {
    {"int", "num"},           {"integer", "num"},       {"float", "num"},         {"real", "num"},
    {"double", "dnum"},       {"number", "num"},        {"boolean", "bool"},      {"char", "string"},
    {"str", "string"},        {"text", "string"},       {"wait", "WaitTime"},     {"sleep", "WaitTime"},
    {"delay", "WaitTime"},    {"pause", "WaitTime"},    {"print", "TPWrite"},     {"println", "TPWrite"},
    {"echo", "TPWrite"},      {"msgbox", "UIMsgBox"},   {"strtonum", "StrToVal"}, {"stringtonum", "StrToVal"},
    {"valtonum", "StrToVal"}, {"len", "StrLen"},        {"length", "StrLen"},     {"substr", "StrPart"},
    {"strsub", "StrPart"},    {"tostring", "ValToStr"}, {"sqr", "Sqrt"},          {"power", "Pow"},
    {"movep", "MoveJ"},       {"linear", "MoveL"},      {"on", "high"},           {"off", "low"}};

/// A name of one or two letters is near to everything of that length.
bool near(std::string_view written, unsigned distance) {
    return written.size() > 2 && distance < written.size();
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

/// The number of "v100" or "z50"; -1 of other names.
long numberInSeries(std::string_view folded) {
    constexpr size_t kLongest = 6;
    const bool member = folded.size() > 1 && folded.size() <= kLongest &&
                        (folded[0] == 'v' || folded[0] == 'z') &&
                        folded.find_first_not_of("0123456789", 1) == std::string_view::npos;
    return member ? std::stol(std::string(folded.substr(1))) : -1;
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

void Analyzer::setMissingModules(const TaskInput& input) {
    missingModules_ = input.missingModules;
    for (const auto& file : input.files) // what a file declares that cannot be read is not known
        if (file->isBinary())
            missingModules_.push_back(std::filesystem::path(file->path()).filename().string());
    incomplete_ = input.incomplete || missingModules_.size() > input.missingModules.size();
}

// "CONST num n Rows:=4;", "PROC my-name()": all words of the line up to the value or the list of parameters, and the names
// they give together.
void Analyzer::mayDeclareTorn(const SyntaxTree& tree, TokenIndex word) {
    constexpr TokenSet kEnd = {TokenKind::Semicolon, TokenKind::Assign, TokenKind::Equal,
                               TokenKind::LeftBracket, TokenKind::EndOfFile};
    constexpr TokenIndex kMost = 8;
    const auto kindAt = [&](TokenIndex i) { return tree.tokens[i].kind; };
    const bool data = kindAt(word) == TokenKind::KwVar || kindAt(word) == TokenKind::KwPers ||
                      kindAt(word) == TokenKind::KwConst;
    const std::string_view text = tree.source->text();
    std::vector<std::string> names; // that end at the word before
    const size_t own = tokenText(kindAt(word)).size();
    if (tree.text(word).size() > own) maybeDeclared_.insert(interner_.intern(tree.text(word).substr(own)));
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
            maybeDeclared_.insert(interner_.intern(name));
        names = std::move(longer);
    }
}

// After a syntax error a name may be missing because its declaration could not be read: whoever uses it is not to
// blame. Such a declaration still shows two words in a row, the second of which is the name.
bool Analyzer::mayReportUnknown(NameId name) {
    if (context_.module) facts().open = true;
    for (const SyntaxTree* tree : std::exchange(brokenTrees_, {})) {
        for (size_t i = 0; tree && i + 1 < tree->tokens.size(); ++i) {
            const TokenKind before = tree->tokens[i].kind;
            const bool declares = before == TokenKind::Identifier || before == TokenKind::KwProc ||
                                  before == TokenKind::KwTrap || before == TokenKind::KwRecord;
            if (declares && tree->tokens[i + 1].kind == TokenKind::Identifier)
                maybeDeclared_.insert(interner_.intern(tree->text(static_cast<TokenIndex>(i + 1))));
            if (kDeclaring.has(before) && !isWhole(*tree, i))
                mayDeclareTorn(*tree, static_cast<TokenIndex>(i));
        }
    }
    return !maybeDeclared_.contains(name);
}

// Whether a FOR of this routine, ahead of `token`, counts a variable of that name.
bool Analyzer::countedAbove(TokenIndex token, NameId name) {
    const TokenIndex first = context_.routine->decl->first;
    if (first >= token || comparisonsLeft_ < token - first) return false;
    comparisonsLeft_ -= token - first;
    for (TokenIndex i = first; i + 1 < token; ++i)
        if (context_.tree->tokens[i].kind == TokenKind::KwFor &&
            context_.tree->tokens[i + 1].kind == TokenKind::Identifier && idOf(i + 1) == name)
            return true;
    return false;
}

// "G ripOpen;", "p-Pick": the word and the one behind it are a name that is known. True also at the second word.
bool Analyzer::reportTorn(TokenIndex token) {
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
    const Symbol* joined = lookup(interner_.intern(head + tail));
    const Symbol* linked = hyphen ? lookup(interner_.intern(head + "_" + tail)) : nullptr;
    const Symbol* meant = joined ? joined : linked;
    if (!meant) return false;
    tornUntil_ = last;
    tornTree_ = context_.tree;
    report(Code::UnexpectedToken, whole,
           {"'" + std::string(shown) + "'", "'" + meant->name + "': a name is one word"})
        .fix(whole, meant->name, !lookup(idOf(last)) && !(joined && linked));
    return true;
}

Analyzer::Meant Analyzer::reportUnknown(Code code, TokenIndex token, NameId name, Wanted wanted,
                                        std::string_view otherHint) {
    if (!mayReportUnknown(name) || reportTorn(token)) return Meant::Unknown;
    Suggestion best = suggestion(name, wanted);
    std::string hint(otherHint);
    if (!best.name.empty()) hint = didYouMean(best.name);
    if (wanted == Wanted::Data && (!best.symbol || best.symbol->predefined)) {
        if (std::string others = inSeries(interner_.folded(name)); !others.empty()) {
            hint = std::move(others);
            best = {};
        }
    }
    const Meant meant = best.isKeyword ? Meant::Keyword : Meant::Unknown;
    if (const std::string_view where =
            addInOf(interner_.folded(name), wanted == Wanted::Type, !best.name.empty());
        !where.empty()) {
        if (reportedNames_.insert(name).second)
            report(Code::MayBeDeclared, range(token), {text(token), std::string(where), ""});
        return Meant::Elsewhere;
    }
    if (incomplete_) {
        if (reportedNames_.insert(name).second) reportMayBeDeclared(token, hint);
        return Meant::Elsewhere;
    }
    // A routine that is missing is one mistake; a name that looks misspelt is one each time.
    const bool routine = wanted != Wanted::Data && wanted != Wanted::Type;
    if (routine && context_.routine && best.name.empty() && !unknownRoutines_.insert(name).second)
        return meant;
    for (const Module* module : task_ ? task_->modules : std::vector<Module*>()) {
        const Symbol* local = module == context_.module ? nullptr : scopes_[module->id]->names.find(name);
        if (!local || !isWanted(*local, wanted)) continue;
        noteDeclared(report(Code::LocalElsewhere, range(token), {text(token), module->name}), *local);
        return Meant::Unknown;
    }
    diag::Diagnostic& d = report(code, range(token), {text(token), hint});
    if (!best.name.empty()) d.fix(range(token), best.name, false);
    constexpr size_t kMany = 2000; // nobody reads so many messages
    if (&d == &unsaid_ || unknownNames_.size() >= kMany) return meant;
    const bool declared = best.symbol && !best.symbol->predefined;
    unknownNames_.push_back({context_.module, name, code, range(token), !best.name.empty(),
                             declared ? best.symbol : nullptr, false});
    return meant;
}

void Analyzer::reportMayBeDeclared(TokenIndex token, const std::string& hint) {
    const std::string where = missingModules_.empty() ? "a module that is not here, such as a system module"
                                                      : listed(missingModules_);
    report(Code::MayBeDeclared, range(token), {text(token), where, hint});
}

// "v110" and "z25": of speeds and zones, the next ones that are predefined.
std::string Analyzer::inSeries(std::string_view written) {
    const long wanted = numberInSeries(written);
    if (wanted < 0 || comparisonsLeft_ < predefined_.size()) return {};
    comparisonsLeft_ -= predefined_.size();
    std::string_view below, above;
    for (const Symbol* symbol : predefined_) {
        const std::string_view other = symbol ? interner_.folded(symbol->nameId) : std::string_view();
        const long number = other.starts_with(written[0]) ? numberInSeries(other) : -1;
        if (number < 0) continue;
        if (number < wanted && (below.empty() || number > numberInSeries(below))) below = other;
        if (number > wanted && (above.empty() || number < numberInSeries(above))) above = other;
    }
    if (below.empty() && above.empty()) return {};
    if (below.empty() || above.empty())
        return "; predefined is '" + std::string(below.empty() ? above : below) + "'";
    return "; predefined are '" + std::string(below) + "' and '" + std::string(above) + "'";
}

std::string Analyzer::didYouMean(std::string_view name) {
    return "; did you mean '" + std::string(name) + "'?";
}

Analyzer::Suggestion Analyzer::suggestion(NameId name, Wanted wanted) {
    facts().open = true;
    const size_t names = globals_.size() + predefined_.size() + scopes_[context_.module->id]->names.size();
    if (comparisonsLeft_ < names) return {};
    comparisonsLeft_ -= names;
    const std::string_view written = interner_.folded(name);
    for (const ForeignName& foreign : kForeignNames) {
        if (foreign.folded != written) continue;
        const Symbol* meant = at(predefined_, interner_.intern(foreign.meant));
        if (meant && isWanted(*meant, wanted) && lookup(meant->nameId) == meant) return {meant->name, false};
    }
    unsigned limit = suggestionLimit(written.size());
    // The nearest scope first: on equal distance it wins, and within a scope the first in the alphabet.
    Suggestion best;
    std::string_view bestFolded;
    unsigned scope = 0, bestScope = 0;
    const auto consider = [&](std::string_view folded, std::string_view spelling, bool keyword,
                              const Symbol* symbol = nullptr) {
        const unsigned distance = editDistance(written, folded, limit);
        if (distance > std::min(limit, suggestionLimit(folded.size()))) return; // Search_1D is not SearchC
        const bool equal = !best.name.empty() && distance == limit;
        if (equal && (scope != bestScope || bestFolded <= folded)) return;
        if (symbol && lookup(symbol->nameId) != symbol) return; // hidden by another of its name
        best = {std::string(spelling), keyword, symbol};
        bestFolded = folded;
        bestScope = scope;
        limit = distance;
    };
    const auto considerSymbol = [&](const Symbol* symbol) {
        if (symbol && symbol->nameId != name && !symbol->name.empty() && isWanted(*symbol, wanted))
            consider(interner_.folded(symbol->nameId), symbol->name, false, symbol);
    };
    if (context_.routine)
        for (const NameId id : declaredInRoutine_)
            considerSymbol(at(routineNames_, id));
    scope = 1;
    scopes_[context_.module->id]->names.forEach(
        [&](NameId, const Symbol* symbol) { considerSymbol(symbol); });
    scope = 2;
    for (const Symbol* symbol : globals_)
        considerSymbol(symbol);
    scope = 3;
    for (const DataSymbol* symbol : configured_)
        considerSymbol(symbol);
    // A name of one to three letters is near to everything of that length.
    scope = 4;
    constexpr size_t kShort = 4;
    if (written.size() >= kShort) {
        if (wanted == Wanted::Procedure)
            for (const Word& word : kInstructionWords)
                consider(word.folded, word.spelling, true);
        if (wanted == Wanted::Data)
            for (const Word& word : kValueWords)
                consider(word.folded, word.spelling, true);
        for (const Symbol* symbol : predefined_)
            considerSymbol(symbol);
    }
    return near(written, limit) ? best : Suggestion();
}

std::string Analyzer::deeperComponent(const Type& record, std::string_view name) {
    std::string found;
    for (const Type::Component& part : record.base()->components) {
        if (part.type->base()->kind != TypeKind::Record) continue;
        const int inner = findComponent(*part.type, name);
        if (inner < 0) continue;
        if (!found.empty()) return {};
        found = part.name + "." + part.type->base()->components[static_cast<size_t>(inner)].name;
    }
    return found;
}

const Type::Component* Analyzer::nearComponent(const Type& record, std::string_view name) {
    const std::vector<Type::Component>& components = record.base()->components;
    if (partComparisonsLeft_ < components.size()) return nullptr;
    partComparisonsLeft_ -= components.size();
    unsigned limit = suggestionLimit(name.size());
    const Type::Component* best = nullptr;
    for (const Type::Component& c : components) {
        const unsigned distance = editDistance(name, c.name, limit);
        if (distance > limit || (best && distance == limit)) continue;
        best = &c;
        limit = distance;
    }
    return best && near(name, limit) ? best : nullptr;
}

const DataSymbol* Analyzer::nearOptional(const RoutineSymbol& routine, NameId name) {
    if (partComparisonsLeft_ < routine.params.size()) return nullptr;
    partComparisonsLeft_ -= routine.params.size();
    const std::string_view written = interner_.folded(name);
    unsigned limit = suggestionLimit(written.size());
    const DataSymbol* best = nullptr;
    for (const DataSymbol* param : routine.params) {
        if (!param->optional) continue;
        const unsigned distance = editDistance(written, interner_.folded(param->nameId), limit);
        if (distance > limit || (best && distance == limit)) continue;
        best = param;
        limit = distance;
    }
    return best && near(written, limit) ? best : nullptr;
}

} // namespace rapid::sema
