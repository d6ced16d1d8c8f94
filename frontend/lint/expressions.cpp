// Expressions: what is read, comparisons that cannot be meant, texts that become too long.

#include "config/letter_case.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/lint/walker.h"
#include "frontend/sema/type_rules.h"
#include "frontend/syntax/lexer.h"
#include "frontend/syntax/limits.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace rapid::lint {

using namespace syntax;
using sema::ConstValue;
using sema::DataSymbol;
using sema::TypeKind;

namespace {

bool isIdentifier(TokenKind kind) {
    return kind == TokenKind::Identifier;
}

} // namespace

bool isByte(const sema::DataType& type) {
    for (const sema::Type* t = type.type; t; t = t->aliasOf)
        if (t->known == sema::KnownType::Byte) return true;
    return false;
}

const double* firstBeyondByte(const ConstValue& value) {
    if (value.kind == ConstValue::Kind::Number) {
        const double number = value.number;
        return number >= 0 && number <= 255 && number == std::floor(number) ? nullptr : &value.number;
    }
    for (const ConstValue& member : value.members())
        if (const double* found = firstBeyondByte(member)) return found;
    return nullptr;
}

/// A constant that a byte gets. Data may hold any number, as byte is a num; bit functions raise ERR_ARGVALERR for it.
void Walker::byteValue(const sema::DataType& wanted, const Expr& value) {
    const ConstValue* known = isByte(wanted) ? constant(value) : nullptr;
    const double* wrong = known ? firstBeyondByte(*known) : nullptr;
    if (wrong) report(say::ByteOutOfRange, range(value), {fmt::format("{}", *wrong)});
}

const ConstValue* Walker::constant(const Expr& e) const {
    const sema::ExprInfo& known = info(e);
    if (known.constant || e.kind != NodeKind::Name) return known.constant;
    // Perhaps a point that was only passed on, so that its value was not needed.
    if (!known.symbol || known.symbol->kind != sema::SymbolKind::Data) return nullptr;
    const auto& data = static_cast<const DataSymbol&>(*known.symbol);
    return data.isLiteralConstant() ? &data.value() : nullptr;
}

const double* Walker::number(const Expr& e) const {
    const ConstValue* value = constant(e);
    return value && value->kind == ConstValue::Kind::Number ? &value->number : nullptr;
}

void Walker::expr(const Expr& e, bool partOfText) {
    switch (e.kind) {
    case NodeKind::Name: read(e); return;
    case NodeKind::Index:
    case NodeKind::Component:
        subscripts(e);
        read(e);
        return;
    case NodeKind::NumLiteral: inexact(as<NumLiteralExpr>(e)); return;
    case NodeKind::Call: call(e, as<CallExpr>(e).args); return;
    case NodeKind::Aggregate:
        if (as<AggregateExpr>(e).isPlain()) return;
        for (const Expr* element : as<AggregateExpr>(e).elements())
            expr(*element);
        return;
    case NodeKind::Paren: expr(*as<ParenExpr>(e).inner, partOfText); return;
    case NodeKind::Unary: expr(*as<UnaryExpr>(e).operand); return;
    case NodeKind::Binary: binary(as<BinaryExpr>(e), partOfText); return;
    default: return;
    }
}

void Walker::inexact(const NumLiteralExpr& e) {
    const double stored = static_cast<double>(static_cast<float>(e.value));
    if (info(e).type().type != program_.num || stored == e.value || !isWholeLiteral(tree_->text(e.first)))
        return;
    report(say::InexactInteger, range(e), {std::string(tree_->text(e.first)), fmt::format("{:.0f}", stored)});
}

void Walker::binary(const BinaryExpr& e, bool partOfText) {
    bool text = false;
    switch (e.op) {
    case BinaryOp::Add:
        text = info(e).type().type == program_.string;
        if (text && !partOfText) textLength(e);
        break;
    case BinaryOp::Sub:
    case BinaryOp::Div:
    case BinaryOp::IntDiv:
    case BinaryOp::Mod:
        if (!number(*e.left)) identical(e);
        break;
    case BinaryOp::Eq:
    case BinaryOp::Ne:
    case BinaryOp::Lt:
    case BinaryOp::Le:
    case BinaryOp::Gt:
    case BinaryOp::Ge: comparison(e); break;
    case BinaryOp::And:
    case BinaryOp::Or:
    case BinaryOp::Xor: identical(e); break;
    default: break;
    }
    expr(*e.left, text);
    expr(*e.right, text);
}

void Walker::identical(const BinaryExpr& e) {
    if (e.left->kind == e.right->kind && sameText(*e.left, *e.right))
        report(say::IdenticalOperands, range(e), {std::string(tree_->text(e.opToken))});
}

void Walker::comparison(const BinaryExpr& e) {
    const bool equality = e.op == BinaryOp::Eq || e.op == BinaryOp::Ne;
    const double* left = number(*e.left);
    const double* right = number(*e.right);
    if (left && right) return;
    if (!left && !right) {
        identical(e);
        return;
    }
    if (!equality) return;
    const Expr& value = left ? *e.left : *e.right;
    const Expr& other = left ? *e.right : *e.left;
    const double fraction = left ? *left : *right;
    // "IF place.trans.x = shelf.trans.x": which of the taught points the caller has passed on.
    const DataSymbol* root = value.kind == NodeKind::Component ? rootOf(other) : nullptr;
    if (root && root->storage == sema::Storage::Parameter) return;
    if (fraction != std::floor(fraction))
        judgeFraction(other, value, range(e), "operator " + std::string(tree_->text(e.opToken)));
    else
        judgeSignal(other, value);
}

/// Data is judged when all is known that it is set from.
void Walker::judgeFraction(const Expr& other, const Expr& value, SourceRange where, std::string operation) {
    const DataSymbol* data = rootOf(bare(other));
    if (!data || data->type.type->kind == TypeKind::SemiValue) {
        report(say::FractionEquality, where, {std::move(operation), text(value)});
        return;
    }
    const bool inside = isOwn(*data) && data->storage != sema::Storage::Parameter;
    (inside ? fractions_ : facts_.fractions)
        .push_back({data, *number(value), tree_, where, std::move(operation), text(value)});
}

/// Remembers the fractions in a constant that data gets. Of parts of data the part is not recorded.
void Walker::setFrom(const DataSymbol& data, const Expr& value) {
    const bool inside = isOwn(data) && data.storage != sema::Storage::Parameter;
    const ConstValue* known = constant(value);
    if (known)
        forEachFraction(*known,
                        [&](double number) { (inside ? numbers_ : facts_.numbers).insert({&data, number}); });
}

void Walker::judgeFractions() {
    for (const DataSymbol* data : routine_->data)
        if (data->init && data->dataKind == DataKind::Var) setFrom(*data, *data->init);
    for (const FractionUse& use : fractions_)
        if (!numbers_.contains({use.data, use.value}))
            report(say::FractionEquality, use.where, {use.operation, use.text});
}

void Walker::judgeCase(const Expr& subject, const Expr& value) {
    const double* found = number(value);
    if (found && *found != std::floor(*found) && !number(subject))
        judgeFraction(subject, value, range(value), "CASE");
    else
        judgeSignal(subject, value);
}

/// A digital signal against a constant (including a CASE).
void Walker::judgeSignal(const Expr& signal, const Expr& value) {
    const Expr& place = bare(signal);
    const DataSymbol* root = place.kind == NodeKind::Name ? rootOf(place) : nullptr;
    if (!root || !isDigital(*root->type.type)) return;
    const double* constantValue = number(value);
    if (constantValue && *constantValue != 0 && *constantValue != 1)
        report(say::ImpossibleSignalValue, range(value), {root->name, text(value)});
}

/// Whether two parts of the tree are written alike and mean the same each time: calls may not.
bool Walker::sameText(const Node& a, const Node& b) const {
    if (a.kind != b.kind || a.last - a.first != b.last - b.first) return false;
    for (TokenIndex i = 0; a.first + i <= a.last; ++i) {
        const Token& x = tree_->tokens[a.first + i];
        const Token& y = tree_->tokens[b.first + i];
        if (x.kind != y.kind) return false;
        if (x.kind == TokenKind::LeftParen && i > 0 && isIdentifier(tree_->tokens[a.first + i - 1].kind))
            return false; // a call
        const std::string_view textX = tree_->text(a.first + i), textY = tree_->text(b.first + i);
        const bool exact = x.kind == TokenKind::StringLiteral || x.kind == TokenKind::PlainAggregate;
        if (exact ? textX != textY : !config::sameName(textX, textY)) return false;
    }
    return true;
}

// The parts whose length is known; what is not known counts as empty.
void Walker::textLength(const BinaryExpr& e) {
    if (info(e).constant) return; // judged with the constant
    unsigned length = 0;
    const Expr* rest = &e;
    while (rest->kind == NodeKind::Binary && as<BinaryExpr>(*rest).op == BinaryOp::Add) {
        length += leastLength(*as<BinaryExpr>(*rest).right);
        rest = as<BinaryExpr>(*rest).left;
    }
    length += leastLength(*rest);
    if (length > kStringCapacity)
        report(say::StringMayOverflow, range(e), {fmt::format("{} or more", length)});
}

unsigned Walker::leastLength(const Expr& e) const {
    const Expr& part = bare(e);
    if (const ConstValue* value = constant(part))
        return value->kind == ConstValue::Kind::String ? static_cast<unsigned>(value->text().size()) : 0;
    if (part.kind == NodeKind::Binary && as<BinaryExpr>(part).op == BinaryOp::Add)
        return leastLength(*as<BinaryExpr>(part).left) + leastLength(*as<BinaryExpr>(part).right);
    const sema::BoundCall* called = part.kind == NodeKind::Call ? find(part) : nullptr;
    if (!called || !called->routine) return 0;
    if (const DataSymbol* param = called->routine->textLengthParam) {
        for (const sema::BoundArg& arg : called->args) {
            const double* length = arg.param == param && arg.value ? number(*arg.value) : nullptr;
            if (length && *length > 0 && *length <= kStringCapacity) return static_cast<unsigned>(*length);
        }
    }
    return called->routine->textLength;
}

} // namespace rapid::lint
