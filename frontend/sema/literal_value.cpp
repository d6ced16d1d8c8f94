#include "frontend/sema/literal_value.h"

#include "frontend/sema/checked.h"
#include "frontend/syntax/lexer.h"

namespace rapid::sema {

using namespace syntax;

namespace {

/// Walks along the tokens of a plain aggregate and the type it shall have.
class LiteralReader {
  public:
    /// Without an arena it only looks whether the types are right.
    LiteralReader(const SyntaxTree& tree, TokenIndex first, Arena* arena)
        : tree_(tree), at_(first), arena_(arena) {}

    bool read(const DataType& want, ConstValue* value) {
        if (kind() == TokenKind::LeftBracket) return readAggregate(want, value);
        return want.rank == 0 && readAtom(want.type->kind, value);
    }

  private:
    TokenKind kind() const { return tree_.tokens[at_].kind; }

    bool readAggregate(const DataType& want, ConstValue* value) {
        const bool array = want.rank > 0;
        if (!array && want.type->kind != TypeKind::Record) return false;
        const std::vector<Type::Component>& components = want.type->base()->components;
        const size_t count = array ? static_cast<size_t>(want.dims[0]) : components.size();
        if (count == 0) return false;
        std::span<ConstValue> members;
        if (value) {
            members = arena_->makeArray<ConstValue>(count);
            value->setMembers(members);
        }
        DataType member = want;
        if (array) member = {want.type, static_cast<uint8_t>(want.rank - 1), {want.dims[1], want.dims[2], 0}};
        for (size_t i = 0; i < count; ++i) {
            ++at_; // '[' or ','
            if (!array) member = {components[i].type, 0, {}};
            if (!read(member, value ? &members[i] : nullptr)) return false;
            if (kind() != (i + 1 < count ? TokenKind::Comma : TokenKind::RightBracket)) return false;
        }
        ++at_;
        return true;
    }

    bool readAtom(TypeKind want, ConstValue* value) {
        const TokenKind found = kind();
        if (found == TokenKind::StringLiteral) {
            if (value) value->setText(decodeStringLiteral(tree_.text(at_)), *arena_);
            ++at_;
            return want == TypeKind::String;
        }
        if (found == TokenKind::KwTrue || found == TokenKind::KwFalse) {
            if (value) value->kind = ConstValue::Kind::Bool;
            if (value) value->boolean = found == TokenKind::KwTrue;
            ++at_;
            return want == TypeKind::Bool;
        }
        const bool negative = found == TokenKind::Minus;
        if (negative) ++at_;
        if (value) {
            const double number = numberValue(tree_.text(at_)).value;
            const double rounded =
                want == TypeKind::Num ? static_cast<double>(static_cast<float>(number)) : number;
            value->kind = ConstValue::Kind::Number;
            value->number = negative ? -rounded : rounded;
        }
        ++at_;
        return want == TypeKind::Num || want == TypeKind::Dnum;
    }

    const SyntaxTree& tree_;
    TokenIndex at_;
    Arena* arena_;
};

} // namespace

bool isLiteralOf(const DataType& want, const SyntaxTree& tree, const AggregateExpr& plain) {
    return LiteralReader(tree, plain.first, nullptr).read(want, nullptr);
}

ConstValue literalValue(const DataType& want, const SyntaxTree& tree, const AggregateExpr& plain,
                        Arena& arena) {
    ConstValue value;
    LiteralReader(tree, plain.first, &arena).read(want, &value);
    return value;
}

void DataSymbol::readLiteral() const {
    literal_ = false;
    value_ = literalValue(type, *module->tree, as<AggregateExpr>(*init), module->facts->values);
}

} // namespace rapid::sema
