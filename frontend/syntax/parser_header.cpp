// First lines of routines: kind, data type, name, parameters (manual 1.1.5).

#include "frontend/syntax/parser_impl.h"

namespace rapid::syntax {

using diag::Code;

/// "PROC Pick Part()": the two words are no data type and a name.
bool Parser::isTornRoutineName() {
    constexpr std::string_view kData = "data";
    const std::string_view word = textOf(pos_);
    if (isBasicType(word) || peek(2) != K::LeftParen) return false;
    const bool isData =
        word.size() > kData.size() && equalsNoCase(word.substr(word.size() - kData.size()), kData);
    return !isData || !tornName(pos_ + 1).empty();
}

void Parser::parseRoutineHeader(RoutineDecl* routine) {
    const bool typeMissed = parseReturnType(routine);
    if (!panic_ && routine->name == kNoToken)
        routine->name = runTogether_ != kNoToken && runTogether_ + 1 == pos_ ? runTogether_ : expectName();
    checkNameLength(routine->name);
    const bool isTrap = routine->routineKind == RoutineKind::Trap;
    routine->broken |= takeTornName(routine->name, isTrap ? TokenSet() : TokenSet{K::LeftParen}, isTrap);
    if (isTrap) {
        if (kind() == K::LeftParen && !panic_) {
            const TokenIndex opening = pos_;
            diag::Diagnostic* diagnostic =
                report(Code::TrapParameters, pos_, {std::string(textOf(routine->name))});
            if (peek() == K::RightParen)
                fix(diagnostic, {tree_.range(opening).begin, tree_.range(opening + 1).end}, "");
            parseParameters(routine);
            routine->params = {};
        }
    } else if (panic_ || kind() == K::LeftParen) {
        parseParameters(routine);
        if (typeMissed && isName(kind()) && !startsLine(pos_) && startsLine(pos_ + 1))
            routine->returnType = take(); // FUNC name(...) num
    } else {
        parseParametersWithoutParen(routine);
    }
}

/// The data type of a function, or one that stands where there is none. True: that of a function is missing.
bool Parser::parseReturnType(RoutineDecl* routine) {
    if (routine->routineKind == RoutineKind::Func) {
        const bool typed = runTogether_ != kNoToken && runTogether_ + 1 == pos_; // "FUNCnum name("
        routine->returnType = typed ? runTogether_ : expectName();
        if (!panic_ && kind() == K::LeftParen && !startsLine(pos_)) { // FUNC name(...)
            routine->name = routine->returnType;
            routine->returnType = kNoToken;
            report(Code::MissingReturnType, routine->name, {std::string(textOf(routine->name))});
            return true;
        }
        if (!panic_ && kind() == K::LeftBrace) { // FUNC num{3} name()
            report(Code::ArrayReturn, pos_);
            routine->returnType = kNoToken;
            while (kind() != K::RightBrace && kind() != K::EndOfFile && !startsLine(pos_))
                take();
            accept(K::RightBrace);
        }
    } else if (isName(kind()) && isName(peek()) && !startsLine(pos_ + 1) && !isTornRoutineName() &&
               !lacksParenthesis(pos_) &&
               (routine->routineKind == RoutineKind::Proc ? !isName(peek(2)) || startsLine(pos_ + 2)
                                                          : isBasicType(textOf(pos_)))) { // PROC num name()
        fix(report(Code::ReturnTypeUnexpected, pos_,
                   {std::string(textOf(pos_)), std::string(wordsOf(routine->routineKind).name)}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
        take();
    }
    return false;
}

/// What stands where '(' should.
void Parser::parseParametersWithoutParen(RoutineDecl* routine) {
    if (startsLine(pos_) || kind() == K::Semicolon) {
        diag::Diagnostic* diagnostic =
            reportAt(Code::MissingParameterList, endOf(pos_ - 1), {std::string(textOf(routine->name))});
        fix(diagnostic, kind() == K::Semicolon ? tree_.range(pos_) : endOf(pos_ - 1), "()");
        accept(K::Semicolon);
    } else if (kind() == K::RightParen && peek() == K::LeftParen && startsLine(pos_ + 2)) {
        fix(report(Code::UnexpectedToken, pos_, {"')('", "'()'"}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).end}, "()");
        take();
        take();
    } else if (lacksParenthesis(pos_ - 1)) {
        report(Code::UnexpectedToken, pos_ - 1,
               {describe(pos_ - 1), "'(' between the name and the data type of the first parameter"});
        routine->broken = true;
        typeInName_ = true;
        parseParameters(routine);
    } else {
        unexpected("'('");
        TokenIndex open = pos_;
        while (kindAt(open) != K::LeftParen && open < pos_ + kLongLine && !startsLine(open + 1))
            ++open;
        if (kindAt(open) == K::LeftParen && !startsLine(pos_)) { // PROC my-name()
            pos_ = open;
            panic_ = false;
        }
        parseParameters(routine);
    }
}

/// "PROC worknum n)": the name and a data type, from which only '(' is missing.
bool Parser::lacksParenthesis(TokenIndex name) const {
    constexpr TokenSet kAfterFirst = {K::RightParen, K::Comma, K::Backslash, K::Bar, K::LeftBrace};
    if (!isName(kindAt(name)) || !isName(kindAt(name + 1)) || startsLine(name + 1) ||
        !kAfterFirst.has(kindAt(name + 2)))
        return false;
    const std::string_view word = textOf(name);
    for (size_t i = 1; i < word.size(); ++i)
        if (isBasicType(word.substr(i))) return true;
    return false;
}

void Parser::parseParameters(RoutineDecl* routine) {
    const size_t mark = params_.size();
    if (!panic_) {
        const TokenIndex opening = typeInName_ ? pos_ - 1 : take();
        typeMissed_ = false;
        uint32_t group = 0;
        const bool missed = startsLine(pos_) && bodyBeginsHere();
        while (!missed && !panic_ && (kind() != K::RightParen || group > 0)) {
            if (kind() == K::Slash) takeSlashAsBackslash();
            if (group > 0 && !accept(K::Comma) && kind() != K::Backslash && !missesComma()) break;
            parseParameterGroup(group++);
        }
        expectClosing(K::RightParen, opening, !missed);
    }
    routine->params = drain(params_, mark);
    if (!panic_) return;
    routine->broken = true; // calls are not judged
    panic_ = false;         // the header ends with its line
    while (kind() != K::EndOfFile && !(startsLine(pos_) && (startsDecl(pos_) || looksLikeStatement(pos_)))) {
        if (kind() == K::RightParen && startsLine(pos_ + 1)) {
            take();
            return;
        }
        if (kRoutineEnds.has(kind()) || (startsLine(pos_) && isKeyword(kind()))) return;
        take();
    }
}

/// One required parameter or the alternatives of an optional one.
void Parser::parseParameterGroup(uint32_t group) {
    const bool marked = switchMarked_ == pos_; // its '\\' has been missed
    bool optional = accept(K::Backslash) || marked;
    params_.push_back(parseParameter(optional, group));
    while (!panic_ && kind() == K::Bar) {
        if (!optional && !options_.declarations) report(Code::RequiredAlternative, pos_);
        take();
        if (kind() == K::Backslash) {
            if (!options_.declarations)
                fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "a parameter after '|'"}),
                    tree_.range(pos_), "");
            optional = true;
            take();
        }
        params_.push_back(parseParameter(optional, group));
    }
}

/// `switch name`
bool Parser::parseSwitch(ParamDecl* param) {
    const bool named = isName(peek()) || peek() == K::KwContinue || peek() == K::KwBreak;
    if (!isContextual(pos_, "SWITCH") || !named) return false;
    take();
    param->isSwitch = true;
    param->name = expectName(true);
    checkNameLength(param->name);
    return true;
}

/// VAR, PERS or INOUT, and what is wrong there. False: the parameter ends with it.
bool Parser::parseAccessMode(ParamDecl* node) {
    if (accept(K::KwVar)) {
        node->mode = ParamMode::Var;
    } else if (accept(K::KwPers)) {
        node->mode = ParamMode::Pers;
    } else if (accept(K::KwInout)) {
        node->mode = ParamMode::Inout;
    } else if (options_.declarations && isContextual(pos_, "REF") && isName(peek()) && isName(peek(2))) {
        take();
        node->mode = ParamMode::Ref;
    }
    if (node->mode == ParamMode::In && !isName(kind())) {
        missing("a parameter");
        return false;
    }
    if (node->mode != ParamMode::In && isContextual(pos_, "SWITCH") && isName(peek())) {
        fix(report(Code::UnexpectedToken, pos_ - 1,
                   {describe(pos_ - 1), "'switch', which takes no access mode"}),
            {tree_.range(pos_ - 1).begin, tree_.range(pos_).begin}, "");
        node->mode = ParamMode::In;
        return !parseSwitch(node);
    }
    if (node->mode != ParamMode::In && kAccessModes.has(kind()) && isName(peek()) &&
        isName(peek(2))) { // "VAR PERS num x"
        report(Code::UnexpectedToken, pos_, {describe(pos_), "a data type"});
        take();
    }
    return true;
}

ParamDecl* Parser::parseParameter(bool optional, uint32_t group) {
    auto* node = make<ParamDecl>(NodeKind::Param);
    node->optional = optional;
    node->group = group;
    if (kind() == K::PlacePar || kind() == K::PlaceAlt) {
        if ((kind() == K::PlaceAlt) != optional)
            report(Code::PlaceholderMisplaced, pos_, {describe(pos_), optional ? "<ALT>" : "<PAR>"});
        node->placeholder = true;
        take();
        return finish(node);
    }
    if (std::exchange(typeInName_, false)) {
        node->name = take();
        if (kind() == K::LeftBrace) parseDimensions(node);
        return finish(node);
    }
    if (parseSwitch(node)) return finish(node);
    if (startsLine(pos_) && bodyBeginsHere()) {
        missing("a parameter");
        return finish(node);
    }
    if (kind() == K::Identifier) dropForeignMode(node);
    if (!parseAccessMode(node)) return finish(node);
    if (!parseForeignParameter(node)) {
        node->type = expectName();
        dropMisplacedMode(node);
        if (!panic_ && startsLine(pos_) && isName(kind()) && peek() == K::Assign)
            missing("the name of the parameter");
        if (!panic_) node->name = expectName(true);
    }
    if (node->name != kNoToken && isKeyword(kindAt(node->name))) declareReserved(node->name);
    checkNameLength(node->name);
    if (!panic_ && (kind() == K::LeftBrace || kind() == K::LeftBracket)) parseDimensions(node);
    if (!panic_ && (kind() == K::Assign || kind() == K::Equal)) {
        report(Code::ParameterValue, pos_, {std::string(textOf(node->name))});
        take();
        parseExpr();
    }
    return finish(node);
}

/// `num VAR x`
void Parser::dropMisplacedMode(ParamDecl* param) {
    if (panic_ || !kAccessModes.has(kind()) || !isName(peek())) return;
    if (diag::Diagnostic* diagnostic = report(Code::ModeAfterType, pos_, {describe(pos_)})) {
        const uint32_t begin = tree_.range(param->first).begin;
        const SourceRange word{tree_.range(pos_).begin, tree_.range(pos_ + 1).begin};
        diagnostic->fixes.push_back({"write it before the data type",
                                     {{{begin, begin}, std::string(tokenText(kind())) + " "}, {word, ""}}});
    }
    param->mode = kind() == K::KwVar    ? ParamMode::Var
                  : kind() == K::KwPers ? ParamMode::Pers
                                        : ParamMode::Inout;
    take();
}

/// `{*}`, `{*,*}`, `{*,*,*}` or `{<DIM>}`
void Parser::parseDimensions(ParamDecl* param) {
    const bool foreign = kind() == K::LeftBracket;
    const K closing = foreign ? K::RightBracket : K::RightBrace;
    if (foreign) report(Code::ForeignSpelling, pos_, {"[", "'{*}' behind the name of an array"});
    const TokenIndex opening = take();
    if (foreign && accept(closing)) {
        param->rank = 1;
        return;
    }
    constexpr uint8_t kPlaceholderRank = 255;
    constexpr uint8_t kMostStars = 254;
    if (accept(K::PlaceDim)) {
        param->rank = kPlaceholderRank;
    } else if (kind() == K::RightBrace) {
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "'*'"}), endOf(opening), "*");
        param->rank = 1;
    } else {
        do {
            const bool isSize = kind() == K::NumLiteral || isName(kind());
            if (isSize && foreign) {
                take();
            } else if (isSize && (peek() == K::Comma || peek() == K::RightBrace)) {
                fix(report(Code::DimensionWithoutStar, pos_), tree_.range(pos_), "*");
                take();
            } else if (!accept(K::Star)) {
                unexpected("'*'");
                return;
            }
            if (param->rank < kMostStars) ++param->rank;
        } while (accept(K::Comma));
    }
    expectClosing(closing, opening, true);
}

} // namespace rapid::syntax
