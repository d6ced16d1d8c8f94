// Names that were torn ("p Pick", "my-name") or have run into the word before them ("VARnum", "PROCMove()"): one report, and
// what was meant as the fix when the whole name stands elsewhere.

#include "frontend/syntax/parser_impl.h"

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

namespace {

/// What stands in most programs without being declared there.
constexpr std::string_view kFrequent[] = {
    "AccSet",     "ClkRead",   "ClkReset",  "ClkStart", "ClkStop",   "ConfJ",    "ConfL",    "CRobT",
    "EulerZYX",   "IDelete",   "ISignalDI", "MoveAbsJ", "MoveC",     "MoveJ",    "MoveL",    "NumToStr",
    "OrientZYX",  "PulseDO",   "RelTool",   "SearchL",  "SetAO",     "SetDO",    "SetGO",    "SingArea",
    "SocketSend", "StartMove", "StopMove",  "StrFind",  "StrLen",    "StrPart",  "StrToVal", "TPErase",
    "TPReadFK",   "TPReadNum", "TPWrite",   "UIMsgBox", "ValToStr",  "VelSet",   "WaitDI",   "WaitDO",
    "WaitTime",   "WaitUntil", "robtarget", "tooldata", "speeddata", "zonedata", "wobjdata"};

bool isDigits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

/// The spelling of a name as it stands in the file, up to `except` of its places aside; empty when it does not. `wanted` is
/// compared without case.
std::string_view Parser::spellingInFile(std::string_view wanted, TokenIndex exceptFirst,
                                        TokenIndex exceptLast) {
    if (searched_ >= kMostWords) return {};
    searched_ += last_;
    const std::string upper = upperCase(wanted);
    for (TokenIndex i = 0; i < last_; ++i)
        if (tokens_[i].length == wanted.size() && kindAt(i) == K::Identifier &&
            (i < exceptFirst || i > exceptLast) && equalsNoCase(textOf(i), upper))
            return textOf(i);
    return {};
}

/// Two words in one line, with nothing but blanks between them: the one name they were meant as, if there is such a name.
std::string Parser::tornName(TokenIndex second) {
    if (second == 0 || second >= last_ || kindAt(second - 1) != K::Identifier || startsLine(second))
        return {};
    const K k = kindAt(second);
    const std::string_view head = textOf(second - 1), tail = textOf(second);
    if (k != K::Identifier && !isKeyword(k) && (k != K::NumLiteral || !isDigits(tail))) return {};
    const SourceRange gap{tree_.range(second - 1).end, tree_.range(second).begin};
    const std::string_view between = tree_.source->text().substr(gap.begin, gap.end - gap.begin);
    constexpr size_t kWide = 3;
    if (between.size() > kWide || between.find_first_not_of(" \t") != std::string_view::npos) return {};
    std::string whole = std::string(head).append(tail);
    const std::string upper = upperCase(whole);
    for (const std::string_view name : kFrequent)
        if (equalsNoCase(name, upper)) return std::string(name);
    const bool predefined = equalsNoCase(head, "V") || equalsNoCase(head, "Z");
    if (predefined && k == K::NumLiteral) return whole; // v100, z10
    if (whole.size() > kMaxNameLength) return {};
    return std::string(spellingInFile(whole, second - 1, second));
}

/// At a word that cannot stand here: it and the word before it, or the two before it, are one name.
diag::Diagnostic* Parser::reportTornName() {
    if (errors_ >= kMaxErrorsPerFile) return nullptr;
    for (const TokenIndex second : {pos_, pos_ - 1}) {
        const bool begins = second < 2 || startsLine(second - 1) || kindAt(second - 2) == K::Semicolon;
        if (second == 0 || (second != pos_ && !begins)) return nullptr;
        const std::string whole = tornName(second);
        if (whole.empty()) continue;
        const auto underscored = std::string(textOf(second - 1)).append("_").append(textOf(second));
        const bool only = spellingInFile(underscored, second - 1, second).empty();
        return reportWord(second - 1, second, whole,
                          only && (isKeyword(kindAt(second)) || isOnlyHere(second)));
    }
    return nullptr;
}

/// Whether one of two words is the name of nothing else in the file.
bool Parser::isOnlyHere(TokenIndex second) {
    return spellingInFile(textOf(second), second, second).empty() ||
           spellingInFile(textOf(second - 1), second - 1, second - 1).empty();
}

/// "found 'p Pick', expected 'pPick'"; the checker then says nothing of that line.
diag::Diagnostic* Parser::reportWord(TokenIndex first, TokenIndex last, const std::string& whole,
                                     bool certain) {
    const SourceRange range{tree_.range(first).begin, tree_.range(last).end};
    if (++errors_ > kMaxErrorsPerFile) return nullptr;
    const auto shown = std::string(tree_.source->text().substr(range.begin, range.end - range.begin));
    diag::Diagnostic& d = sink_.report(Code::UnexpectedToken, tree_.source, range,
                                       {"'" + shown + "'", "'" + whole + "': a name is one word"});
    d.fix(range, whole, certain);
    lastUnread_ = range.begin;
    noteUnclear(range.begin);
    return &d;
}

/// Nothing follows from what names and types in the line of this place seem to be.
void Parser::noteUnclear(uint32_t place) {
    const std::string_view text = tree_.source->text();
    uint32_t begin = place;
    while (begin > 0 && place - begin < SyntaxTree::kUnclearReach && text[begin - 1] != '\n' &&
           text[begin - 1] != '\r')
        --begin;
    tree_.unclearLines.push_back(begin);
}

/// Behind the first word of a name that is being declared: takes the others, "n Rows", "my-name". `after`: what follows a
/// name there. Where nothing does, the line ends with it, and the name must stand elsewhere, too.
bool Parser::takeTornName(TokenIndex name, const TokenSet& after, bool endsLine) {
    constexpr TokenSet kPieces = {K::Identifier, K::NumLiteral, K::KwTo,  K::KwOr,   K::KwAnd,
                                  K::KwDo,       K::KwIf,       K::KwNot, K::KwStep, K::KwMod};
    if ((!kPieces.has(kind()) && kind() != K::Minus) || panic_ || name == kNoToken || name + 1 != pos_ ||
        kindAt(name) != K::Identifier || startsLine(pos_))
        return false;
    TokenIndex last = name;
    std::string joined(textOf(name)), underscored = joined;
    constexpr TokenIndex kMostPieces = 8;
    while (last < name + kMostPieces) {
        const TokenIndex piece = kindAt(last + 1) == K::Minus ? last + 2 : last + 1;
        if (!kPieces.has(kindAt(piece)) || startsLine(piece)) break;
        joined += textOf(piece);
        underscored.append("_").append(textOf(piece));
        last = piece;
    }
    if (last == name || startsLine(last + 1) != endsLine || (!endsLine && !after.has(kindAt(last + 1))))
        return false;
    std::string_view known = spellingInFile(joined, name, last);
    if (known.empty()) known = spellingInFile(underscored, name, last);
    const bool value = kindAt(name + 1) == K::NumLiteral; // perhaps
    const bool two = kindAt(name + 1) == K::Identifier && !isOnlyHere(name + 1);
    if (known.empty() && (value || two || endsLine)) return false;
    reportWord(name, last, known.empty() ? underscored : std::string(known), !known.empty());
    pos_ = last + 1;
    return true;
}

/// At the first word of a condition that THEN follows: "reg1 = 1 THEN" and "IFreg1 = 1 THEN".
void Parser::reportMissingIf() {
    const std::string_view text = textOf(pos_);
    const SourceRange range = tree_.range(pos_);
    constexpr std::string_view kIf = "IF";
    const bool glued = text.size() > kIf.size() && equalsNoCase(text.substr(0, kIf.size()), kIf) &&
                       spellingInFile(text, pos_, pos_).empty();
    if (!glued) {
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "IF before a condition"}),
            {range.begin, range.begin}, "IF ");
        return;
    }
    const std::string whole = "IF " + std::string(text.substr(kIf.size()));
    fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "'" + whole + "': two words"}), range, whole);
    noteUnclear(range.begin);
}

/// The word of a declaration and what follows it, without a space: "PROCMove(", "VARnum x". The parser then stands at the
/// token, read as that word.
bool Parser::takesRunTogether() {
    static constexpr K kWords[] = {K::KwProc, K::KwFunc, K::KwTrap, K::KwVar, K::KwPers, K::KwConst};
    const std::string_view text = textOf(pos_);
    for (const K word : kWords) {
        const std::string spelling(tokenText(word));
        if (text.size() <= spelling.size() || !equalsNoCase(text.substr(0, spelling.size()), spelling))
            continue;
        const auto rest = std::string(text.substr(spelling.size()));
        const bool data = kStorageWords.has(word);
        const bool fits = data                ? isBasicType(rest) && isName(peek()) && !startsLine(pos_ + 1)
                          : word == K::KwFunc ? isBasicType(rest) && isName(peek()) && peek(2) == K::LeftParen
                          : word == K::KwTrap ? startsLine(pos_ + 1)
                                              : peek() == K::LeftParen;
        if (!fits) continue;
        const SourceRange range = tree_.range(pos_);
        diag::Diagnostic* d = report(Code::UnexpectedToken, pos_,
                                     {describe(pos_), "'" + spelling + " " + rest + "': two words"});
        if (d) d->fix(range, spelling + " " + rest);
        noteUnclear(range.begin);
        readAs(pos_, word);
        runTogether_ = pos_;
        return true;
    }
    return false;
}

} // namespace rapid::syntax
