// Parameters of routines (manual 1.1.5).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <utility>

namespace rapid::syntax {

void ParameterParser::parseParameters(RoutineDecl* routine) {
    const size_t bottom = params_.size();
    if (!panic()) {
        const TokenIndex opening = typeInName_ ? pos() - 1 : take();
        typeMissed = false;
        uint32_t group = 0;
        const bool missed = startsLine(pos()) && ahead().bodyBeginsHere();
        while (!missed && !panic() && (kind() != K::RightParen || group > 0)) {
            if (kind() == K::Slash) recovery().repair(Place::Parameter);
            if (group > 0 && !accept(K::Comma) && kind() != K::Backslash && !foreign().missesComma()) break;
            parseParameterGroup(group++);
        }
        sync().expectClosing(K::RightParen, opening, !missed);
    }
    routine->params = drain(params_, bottom);
    if (!panic()) return;
    routine->broken = true; // calls are not judged
    endPanic();             // the header ends with its line
    while (kind() != K::EndOfFile && !(startsLine(pos()) && (ahead().startsDeclaration(pos()) ||
                                                             ahead().looksLikeInstruction(pos())))) {
        if (kind() == K::RightParen && startsLine(pos() + 1)) {
            take();
            return;
        }
        if (kRoutineEnds.has(kind()) || (startsLine(pos()) && isKeyword(kind()))) return;
        take();
    }
}

void ParameterParser::parseParametersWithoutParen(RoutineDecl* routine) {
    if (startsLine(pos()) || kind() == K::Semicolon) {
        diag::Diagnostic* diagnostic =
            reportAt(say::MissingParameterList, endOf(pos() - 1), {std::string(textOf(routine->name))});
        fix(diagnostic, kind() == K::Semicolon ? range(pos()) : endOf(pos() - 1), "()");
        accept(K::Semicolon);
    } else if (kind() == K::RightParen && peek() == K::LeftParen && startsLine(pos() + 2)) {
        fix(report(say::UnexpectedToken, pos(), {"')('", "'()'"}), {range(pos()).begin, range(pos() + 1).end},
            "()");
        take();
        take();
    } else if (ahead().lacksParenthesis(pos() - 1)) {
        report(say::UnexpectedToken, pos() - 1,
               {describe(pos() - 1), "'(' between the name and the data type of the first parameter"});
        routine->broken = true;
        typeInName_ = true;
        parseParameters(routine);
    } else {
        unexpected("'('");
        TokenIndex open = pos();
        while (kindAt(open) != K::LeftParen && open < pos() + kLongLine && !startsLine(open + 1))
            ++open;
        if (kindAt(open) == K::LeftParen && !startsLine(pos())) { // PROC my-name()
            moveTo(open);
            endPanic();
        }
        parseParameters(routine);
    }
}

/// One required parameter or the alternatives of an optional one.
void ParameterParser::parseParameterGroup(uint32_t group) {
    const bool marked = isMarked(Mark::SwitchWithoutBackslash); // its '\\' has been missed
    bool optional = accept(K::Backslash) || marked;
    params_.push_back(parseParameter(optional, group));
    while (!panic() && kind() == K::Bar) {
        if (!optional && !parser().options.declarations) report(say::RequiredAlternative, pos());
        take();
        if (kind() == K::Backslash) {
            if (!parser().options.declarations)
                fix(report(say::UnexpectedToken, pos(), {describe(pos()), "a parameter after '|'"}),
                    range(pos()), "");
            optional = true;
            take();
        }
        params_.push_back(parseParameter(optional, group));
    }
}

/// `switch name`
bool ParameterParser::parseSwitch(ParamDecl* param) {
    const bool named = isName(peek()) || peek() == K::KwContinue || peek() == K::KwBreak;
    if (!isContextual(pos(), "SWITCH") || !named) return false;
    take();
    param->isSwitch = true;
    param->name = names().expectName(true);
    names().checkNameLength(param->name);
    return true;
}

/// VAR, PERS or INOUT, and what is wrong there. False: the parameter ends with it.
bool ParameterParser::parseAccessMode(ParamDecl* node) {
    if (accept(K::KwVar)) {
        node->mode = ParamMode::Var;
    } else if (accept(K::KwPers)) {
        node->mode = ParamMode::Pers;
    } else if (accept(K::KwInout)) {
        node->mode = ParamMode::Inout;
    } else if (parser().options.declarations && isContextual(pos(), "REF") && isName(peek()) &&
               isName(peek(2))) {
        take();
        node->mode = ParamMode::Ref;
    }
    if (node->mode == ParamMode::In && !isName(kind())) {
        missing("a parameter");
        return false;
    }
    if (node->mode != ParamMode::In && isContextual(pos(), "SWITCH") && isName(peek())) {
        fix(report(say::UnexpectedToken, pos() - 1,
                   {describe(pos() - 1), "'switch', which takes no access mode"}),
            {range(pos() - 1).begin, range(pos()).begin}, "");
        node->mode = ParamMode::In;
        return !parseSwitch(node);
    }
    if (node->mode != ParamMode::In && kAccessModes.has(kind()) && isName(peek()) &&
        isName(peek(2))) { // "VAR PERS num x"
        report(say::UnexpectedToken, pos(), {describe(pos()), "a data type"});
        take();
    }
    return true;
}

ParamDecl* ParameterParser::parseParameter(bool optional, uint32_t group) {
    auto* node = make<ParamDecl>(NodeKind::Param);
    node->optional = optional;
    node->group = group;
    if (kind() == K::PlacePar || kind() == K::PlaceAlt) {
        if ((kind() == K::PlaceAlt) != optional)
            report(say::PlaceholderMisplaced, pos(), {describe(pos()), optional ? "<ALT>" : "<PAR>"});
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
    if (startsLine(pos()) && ahead().bodyBeginsHere()) {
        missing("a parameter");
        return finish(node);
    }
    if (kind() == K::Identifier) foreign().dropForeignMode(node);
    if (!parseAccessMode(node)) return finish(node);
    if (!foreign().parseForeignParameter(node)) {
        node->type = names().expectName();
        dropMisplacedMode(node);
        if (!panic() && startsLine(pos()) && isName(kind()) && peek() == K::Assign)
            missing("the name of the parameter");
        if (!panic()) node->name = names().expectName(true);
    }
    if (node->name != kNoToken && isKeyword(kindAt(node->name))) names().declareReserved(node->name);
    names().checkNameLength(node->name);
    if (!panic() && (kind() == K::LeftBrace || kind() == K::LeftBracket)) parseDimensions(node);
    if (!panic() && (kind() == K::Assign || kind() == K::Equal)) {
        report(say::ParameterValue, pos(), {std::string(textOf(node->name))});
        take();
        expressions().parseExpression();
    }
    return finish(node);
}

/// `num VAR x`
void ParameterParser::dropMisplacedMode(ParamDecl* param) {
    if (panic() || !kAccessModes.has(kind()) || !isName(peek())) return;
    if (diag::Diagnostic* diagnostic = report(say::ModeAfterType, pos(), {describe(pos())})) {
        const uint32_t begin = range(param->first).begin;
        const SourceRange word{range(pos()).begin, range(pos() + 1).begin};
        diagnostic->fixes.push_back({"write it before the data type",
                                     {{{begin, begin}, std::string(tokenText(kind())) + " "}, {word, ""}}});
    }
    param->mode = kind() == K::KwVar    ? ParamMode::Var
                  : kind() == K::KwPers ? ParamMode::Pers
                                        : ParamMode::Inout;
    take();
}

/// `{*}`, `{*,*}`, `{*,*,*}` or `{<DIM>}`
void ParameterParser::parseDimensions(ParamDecl* param) {
    const bool otherForm = kind() == K::LeftBracket;
    const K closing = otherForm ? K::RightBracket : K::RightBrace;
    if (otherForm) report(say::ForeignSpelling, pos(), {"[", "'{*}' after the name of an array"});
    const TokenIndex opening = take();
    if (otherForm && accept(closing)) {
        param->rank = 1;
        return;
    }
    constexpr uint8_t kMostStars = 254;
    if (accept(K::PlaceDim)) {
        param->rank = ParamDecl::kPlaceholderRank;
    } else if (kind() == K::RightBrace) {
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "'*'"}), endOf(opening), "*");
        param->rank = 1;
    } else {
        do {
            const bool isSize = kind() == K::NumLiteral || isName(kind());
            if (isSize && otherForm) {
                take();
            } else if (isSize && (peek() == K::Comma || peek() == K::RightBrace)) {
                fix(report(say::DimensionWithoutStar, pos()), range(pos()), "*");
                take();
            } else if (!accept(K::Star)) {
                unexpected("'*'");
                return;
            }
            if (param->rank < kMostStars) ++param->rank;
        } while (accept(K::Comma));
    }
    sync().expectClosing(closing, opening, true);
}

} // namespace rapid::syntax
