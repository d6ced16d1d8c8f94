#include "frontend/query/argument_scan.h"

#include "frontend/query/meaning.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

constexpr TokenSet kLogical = {TokenKind::KwAnd, TokenKind::KwOr, TokenKind::KwXor, TokenKind::KwNot};
constexpr TokenSet kRelation = {TokenKind::Equal,   TokenKind::NotEqual,     TokenKind::Less,
                                TokenKind::Greater, TokenKind::GreaterEqual, TokenKind::LessEqual};
constexpr TokenSet kArithmetic = {TokenKind::Plus,  TokenKind::Minus, TokenKind::Star,
                                  TokenKind::Slash, TokenKind::KwDiv, TokenKind::KwMod};
constexpr TokenSet kOpening = {TokenKind::LeftParen, TokenKind::LeftBrace, TokenKind::LeftBracket};
constexpr TokenSet kClosing = {TokenKind::RightParen, TokenKind::RightBrace, TokenKind::RightBracket};

} // namespace

bool endsValue(TokenKind kind) {
    return kind == TokenKind::Identifier || kind == TokenKind::NumLiteral ||
           kind == TokenKind::StringLiteral || kind == TokenKind::KwTrue || kind == TokenKind::KwFalse ||
           kClosing.has(kind);
}

ArgumentScan::ArgumentScan(const Scope& scope, TokenIndex from, TokenIndex at)
    : scope_(scope), tree_(*scope.file().tree), from_(from), at_(at) {}

TokenKind ArgumentScan::kind(TokenIndex t) const {
    if (t >= tree_.tokens.size()) return TokenKind::EndOfFile;
    return t + 1 == at_ ? kindWritten(tree_, t) : tree_.tokens[t].kind;
}

void ArgumentScan::run(const DataType& type) {
    Frame frame;
    frame.type = type;
    frame.valueStart = from_;
    frames_.push_back(std::move(frame));
    scan();
}

void ArgumentScan::runCall(TokenIndex callee) {
    Frame frame;
    frame.kind = Kind::Call;
    frame.valueStart = from_;
    frame.call.name = callee;
    if (callee != kNoToken) frame.call.routine = routineOf(scope_.find(tree_.text(callee)));
    choosePositional(frame);
    frames_.push_back(std::move(frame));
    scan();
}

void ArgumentScan::scan() {
    for (TokenIndex t = from_; t < at_; ++t)
        token(t);
}

void ArgumentScan::token(TokenIndex t) {
    if (kOpening.has(kind(t))) return open(t);
    if (kClosing.has(kind(t))) return close(t);
    Frame& frame = frames_.back();
    switch (kind(t)) {
    case TokenKind::Comma: return separator(frame, t);
    case TokenKind::Backslash:
        if (frame.kind != Kind::Call) return;
        if (frame.valueStart < t || frame.optional) endArgument(frame);
        frame.optional = true;
        frame.conditional = false;
        frame.call.parameter = -1;
        frame.call.atName = true;
        frame.valueStart = t + 1;
        return;
    case TokenKind::Assign:
    case TokenKind::Question:
        if (frame.kind == Kind::Call) argumentName(frame, t);
        frame.conditional = kind(t) == TokenKind::Question;
        return;
    case TokenKind::Identifier:
        if (frame.kind == Kind::Call && frame.call.atName) {
            argumentName(frame, t + 1); // a switch, perhaps
            frame.valueStart = t;
        }
        return;
    default: return;
    }
}

void ArgumentScan::open(TokenIndex t) {
    Frame& outer = frames_.back();
    Frame frame;
    frame.open = t;
    frame.valueStart = t + 1;
    bool comparison = false;
    if (kind(t) == TokenKind::LeftBrace) {
        frame.kind = Kind::Index;
        frame.type.type = scope_.snapshot().program().num;
    } else if (kind(t) == TokenKind::LeftBracket) {
        frame.kind = Kind::Aggregate;
        frame.type = operandType(outer, t, comparison);
    } else if (t > 0 && kind(t - 1) == TokenKind::Identifier && t - 1 >= outer.valueStart) {
        frame.kind = Kind::Call;
        frame.call.name = t - 1;
        frame.call.isFunction = true;
        frame.call.routine = routineOf(scope_.find(tree_.text(t - 1)));
        choosePositional(frame);
    } else {
        frame.kind = Kind::Paren;
        frame.type = operandType(outer, t, comparison);
    }
    frames_.push_back(std::move(frame));
}

void ArgumentScan::close(TokenIndex t) {
    const TokenKind opening = kind(t) == TokenKind::RightParen   ? TokenKind::LeftParen
                              : kind(t) == TokenKind::RightBrace ? TokenKind::LeftBrace
                                                                 : TokenKind::LeftBracket;
    for (size_t i = frames_.size(); i-- > 1;)
        if (kind(frames_[i].open) == opening) {
            frames_.resize(i);
            return;
        }
}

void ArgumentScan::separator(Frame& frame, TokenIndex t) {
    if (frame.kind == Kind::Aggregate) ++frame.member;
    if (frame.kind == Kind::Call) {
        endArgument(frame);
        frame.optional = frame.call.atName = frame.conditional = false;
        choosePositional(frame);
    }
    frame.valueStart = t + 1;
}

void ArgumentScan::endArgument(Frame& frame) {
    if (frame.call.parameter >= 0) frame.call.given.push_back(frame.call.parameter);
    if (!frame.optional) ++frame.required;
}

/// The name of an argument ends before `t`.
void ArgumentScan::argumentName(Frame& frame, TokenIndex t) {
    if (t == 0 || !frame.call.routine) {
        frame.call.atName = false;
        frame.valueStart = t + 1;
        return;
    }
    const std::string name = foldName(tree_.text(t - 1));
    const auto& params = frame.call.routine->params;
    frame.call.parameter = -1;
    for (size_t i = 0; i < params.size(); ++i)
        if (foldName(params[i]->name) == name && params[i]->optional == frame.optional)
            frame.call.parameter = static_cast<int>(i);
    frame.call.atName = false;
    frame.valueStart = t + 1;
}

/// Required parameters joined by '|' are one place.
void ArgumentScan::choosePositional(Frame& frame) const {
    frame.call.parameter = -1;
    if (!frame.call.routine) return;
    const auto& params = frame.call.routine->params;
    uint32_t place = 0;
    const DataSymbol* before = nullptr;
    for (size_t i = 0; i < params.size(); ++i) {
        if (params[i]->optional) continue;
        const bool same = before && params[i]->requiredAlternative && before->group == params[i]->group;
        if (before && !same) ++place;
        before = params[i];
        if (same || place != frame.required) continue;
        frame.call.parameter = static_cast<int>(i);
        return;
    }
}

bool ArgumentScan::beginsLine(TokenIndex t) const {
    const uint32_t from = tree_.range(t - 1).end, to = tree_.tokens[t].offset;
    return from <= to &&
           tree_.source->text().substr(from, to - from).find_first_of("\r\n") != std::string_view::npos;
}

/// Arguments that are given by name after the offset, in the same list.
void ArgumentScan::findLater(CallContext& call) const {
    if (!call.routine) return;
    int depth = 0;
    const uint32_t count = tokenCountOf(scope_.file());
    for (TokenIndex t = at_; t < count; ++t) {
        const TokenKind k = kind(t);
        if (k == TokenKind::Semicolon || k == TokenKind::EndOfFile || (depth == 0 && kClosing.has(k))) return;
        if (depth == 0 && isWord(k) && t > 0 && kind(t - 1) != TokenKind::Comma && beginsLine(t)) return;
        if (kOpening.has(k)) ++depth;
        if (kClosing.has(k)) --depth;
        // The word at the offset is what is being written, not an argument.
        if (depth != 0 || k != TokenKind::Backslash || t + 1 == at_) continue;
        const std::string name = foldName(tree_.text(t + 1));
        for (size_t i = 0; i < call.routine->params.size(); ++i)
            if (call.routine->params[i]->optional && foldName(call.routine->params[i]->name) == name)
                call.later.push_back(static_cast<int>(i));
    }
}

DataType ArgumentScan::memberType(const Frame& frame) const {
    if (!frame.type.type) return {};
    if (frame.type.rank > 0) {
        DataType element = frame.type;
        --element.rank;
        std::rotate(std::begin(element.dims), std::begin(element.dims) + 1, std::end(element.dims));
        return element;
    }
    const auto& components = frame.type.type->base()->components;
    return frame.member < components.size() ? DataType{components[frame.member].type, 0, {}} : DataType{};
}

DataType ArgumentScan::valueType(const Frame& frame) const {
    if (frame.kind == Kind::Aggregate) return memberType(frame);
    if (frame.kind != Kind::Call) return frame.type;
    const auto& call = frame.call;
    if (!call.routine || call.parameter < 0) return {};
    return call.routine->params[static_cast<size_t>(call.parameter)]->type;
}

/// The type of the operand before `end`: that of the frame, or the one that the operator before it asks for.
DataType ArgumentScan::operandType(const Frame& frame, TokenIndex end, bool& comparison) const {
    const CheckedProgram& program = scope_.snapshot().program();
    const DataType whole = valueType(frame);
    int depth = 0;
    for (TokenIndex t = end; t-- > frame.valueStart;) {
        const TokenKind k = kind(t);
        if (kClosing.has(k)) ++depth;
        if (kOpening.has(k)) --depth;
        if (depth != 0) continue;
        if (kLogical.has(k)) return {program.boolean, 0, {}};
        const bool hasLeft = t > frame.valueStart && endsValue(kind(t - 1));
        if (kRelation.has(k) && hasLeft) {
            comparison = true;
            const DataType left = typeOfChain(scope_, t - 1);
            return left.type ? left : DataType{program.num, 0, {}};
        }
        if (!kArithmetic.has(k)) continue;
        if (!hasLeft) continue; // a sign
        if (k == TokenKind::KwDiv || k == TokenKind::KwMod || k == TokenKind::Slash)
            return {program.num, 0, {}};
        const DataType left = typeOfChain(scope_, t - 1);
        return left.type && left.type->kind != TypeKind::SemiValue ? left : whole;
    }
    return whole;
}

void ArgumentScan::fill(Cursor& cursor) const {
    const Frame& frame = frames_.back();
    for (size_t i = frames_.size(); i-- > 0;)
        if (frames_[i].kind == Kind::Call) {
            cursor.call = frames_[i].call;
            findLater(*cursor.call);
            break;
        }
    const TokenKind before = at_ > 0 ? kind(at_ - 1) : TokenKind::EndOfFile;
    if (at_ > from_ && before == TokenKind::Dot) {
        cursor.expect = Expect::Component;
        const DataType base = at_ >= 2 ? typeOfChain(scope_, at_ - 2) : DataType{};
        if (base.type && !base.isArray()) cursor.record = base.type;
        return;
    }
    if (frame.kind == Kind::Call && frame.call.atName && before == TokenKind::Backslash) {
        cursor.expect = Expect::OptionalName;
        return;
    }
    const bool atStart = frame.valueStart == at_;
    const bool complete = !atStart && endsValue(before);
    if (cursor.call && cursor.call->name == frame.call.name) {
        cursor.call->atStart = atStart;
        cursor.call->afterValue = complete;
    }
    if (complete) {
        cursor.expect = Expect::Keyword;
        cursor.keywords = {TokenKind::KwAnd, TokenKind::KwOr, TokenKind::KwXor, TokenKind::KwDiv,
                           TokenKind::KwMod};
        return;
    }
    expectedOf(frame, cursor);
}

void ArgumentScan::expectedOf(const Frame& frame, Cursor& cursor) const {
    cursor.expect = Expect::Expression;
    bool comparison = false;
    cursor.type = operandType(frame, at_, comparison);
    if (comparison && cursor.type.type && cursor.type.type->name == "errnum") cursor.errorNumber = true;
    if (frame.kind != Kind::Call) return;
    const auto& call = frame.call;
    if (call.routine && call.parameter < 0 && !frame.optional)
        cursor.expect = Expect::Nothing; // every required argument is given
    if (!call.routine || call.parameter < 0) return;
    const DataSymbol& param = *call.routine->params[static_cast<size_t>(call.parameter)];
    const bool atValue = frame.valueStart == at_;
    if (atValue) cursor.mode = param.mode;
    cursor.accepts = param.accepts;
    if (!param.optional && atValue)
        for (const DataSymbol* other : call.routine->params)
            if (!other->optional && other->group == param.group && other->requiredAlternative)
                cursor.alternatives.push_back(other);
    if (cursor.alternatives.size() < 2) cursor.alternatives.clear();
    cursor.optionalParameter = frame.conditional || call.routine->role == Role::Present;
    if (!param.type.type || param.type.type->kind != TypeKind::AnyType) return;
    cursor.anyType = true;
    cursor.type = {};
}

namespace {

/// Before the bracket that a closing one at `t` ends; kNoToken: none.
TokenIndex beforeBracket(const SyntaxTree& tree, TokenIndex t) {
    int depth = 0;
    for (int steps = 0; steps < 5000; ++steps, --t) {
        if (kClosing.has(tree.tokens[t].kind)) ++depth;
        if (kOpening.has(tree.tokens[t].kind) && --depth == 0) return t > 0 ? t - 1 : kNoToken;
        if (t == 0) break;
    }
    return kNoToken;
}

} // namespace

DataType typeOfChain(const Scope& scope, TokenIndex last) {
    const SyntaxTree& tree = *scope.file().tree;
    const CheckedProgram& program = scope.snapshot().program();
    if (last == kNoToken || last >= tree.tokens.size()) return {};
    switch (tree.tokens[last].kind) {
    case TokenKind::NumLiteral: return {program.num, 0, {}};
    case TokenKind::StringLiteral: return {program.string, 0, {}};
    case TokenKind::KwTrue:
    case TokenKind::KwFalse: return {program.boolean, 0, {}};
    case TokenKind::RightBrace: {
        DataType base = typeOfChain(scope, beforeBracket(tree, last));
        base.rank = 0;
        return base;
    }
    case TokenKind::RightParen: {
        const TokenIndex name = beforeBracket(tree, last);
        if (name == kNoToken || tree.tokens[name].kind != TokenKind::Identifier) return {};
        const RoutineSymbol* routine = routineOf(scope.find(tree.text(name)));
        return routine ? routine->returnType : DataType{};
    }
    case TokenKind::Identifier: break;
    default: return {};
    }
    const std::string_view name = tree.text(last);
    if (last >= 2 && tree.tokens[last - 1].kind == TokenKind::Dot) {
        const DataType base = typeOfChain(scope, last - 2);
        const int index = base.type ? base.type->findComponent(name) : -1;
        if (index < 0) return {};
        return {base.type->base()->components[static_cast<size_t>(index)].type, 0, {}};
    }
    const DataSymbol* data = dataOf(scope.find(name));
    return data ? data->type : DataType{};
}

} // namespace rapid::query
