#include "frontend/sema/literal_value.h"

#include "frontend/sema/checked.h"
#include "frontend/syntax/lexer.h"
#include "frontend/syntax/plain_pieces.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

/// Walks along the pieces of a plain aggregate and the type it shall have.
template <class Pieces> class LiteralReader {
  public:
    /// Without an arena it only looks whether the types are right.
    LiteralReader(Pieces pieces, Arena* arena) : pieces_(pieces), arena_(arena) {}

    bool read(const DataType& want, ConstValue* value) {
        if (!value && want.rank == 0 && !want.type->base()->literalShape.empty()) {
            const std::vector<PlainPiece>& shape = want.type->base()->literalShape;
            return std::all_of(shape.begin(), shape.end(),
                               [this](PlainPiece p) { return pieces_.next() == p; });
        }
        const PlainPiece piece = pieces_.next();
        if (piece == PlainPiece::Open) return readAggregate(want, value);
        return want.rank == 0 && readAtom(piece, want.type->kind, value);
    }

  private:
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
            if (!array) member = {components[i].type, 0, {}};
            if (!read(member, value ? &members[i] : nullptr)) return false;
            if (pieces_.next() != (i + 1 < count ? PlainPiece::Comma : PlainPiece::Close)) return false;
        }
        return true;
    }

    bool readAtom(PlainPiece found, TypeKind want, ConstValue* value) {
        const std::string_view text = pieces_.text();
        if (found == PlainPiece::String) {
            if (value) value->setText(decodeStringLiteral(text), *arena_);
            return want == TypeKind::String;
        }
        if (found == PlainPiece::Bool) {
            if (value) value->kind = ConstValue::Kind::Bool;
            if (value) value->boolean = text.size() == 4; // TRUE
            return want == TypeKind::Bool;
        }
        if (value) {
            const double number = numberValue(text).value;
            const double rounded =
                want == TypeKind::Num ? static_cast<double>(static_cast<float>(number)) : number;
            value->kind = ConstValue::Kind::Number;
            value->number = pieces_.isNegative() ? -rounded : rounded;
        }
        return want == TypeKind::Num || want == TypeKind::Dnum;
    }

    Pieces pieces_;
    Arena* arena_;
};

bool readLiteral(const DataType& want, const SyntaxTree& tree, const AggregateExpr& plain, Arena* arena,
                 ConstValue* value) {
    if (tree.tokens[plain.first].kind == TokenKind::PlainAggregate) {
        const std::vector<PlainPiece>& wanted = want.type->base()->literalShape;
        if (!value && want.rank == 0 && plain.shape() != AggregateExpr::kNoShape && !wanted.empty())
            return tree.shapes[plain.shape()] == wanted;
        const PlainText<true> pieces(tree.text(plain.first).data());
        return LiteralReader(pieces, arena).read(want, value);
    }
    return LiteralReader(PlainTokens<true>(tree, plain.first), arena).read(want, value);
}

PlainPiece pieceOf(const Type& type) {
    switch (type.kind) {
    case TypeKind::Num:
    case TypeKind::Dnum: return PlainPiece::Number;
    case TypeKind::Bool: return PlainPiece::Bool;
    case TypeKind::String: return PlainPiece::String;
    default: return PlainPiece::Other;
    }
}

} // namespace

std::vector<PlainPiece> literalShape(const Type& record) {
    constexpr uint32_t kMaxParts = 64;
    std::vector<PlainPiece> shape;
    if (record.leaves > kMaxParts) return shape;
    for (const Type::Component& component : record.components) {
        const Type& type = *component.type->base();
        shape.push_back(shape.empty() ? PlainPiece::Open : PlainPiece::Comma);
        if (type.kind == TypeKind::Record) {
            if (type.literalShape.empty()) return {};
            shape.insert(shape.end(), type.literalShape.begin(), type.literalShape.end());
        } else {
            shape.push_back(pieceOf(type));
            if (shape.back() == PlainPiece::Other) return {};
        }
    }
    if (!shape.empty()) shape.push_back(PlainPiece::Close);
    return shape;
}

bool isLiteralOf(const DataType& want, const SyntaxTree& tree, const AggregateExpr& plain) {
    return readLiteral(want, tree, plain, nullptr, nullptr);
}

ConstValue literalValue(const DataType& want, const SyntaxTree& tree, const AggregateExpr& plain,
                        Arena& arena) {
    ConstValue value;
    readLiteral(want, tree, plain, &arena, &value);
    return value;
}

void DataSymbol::readLiteral() const {
    literal_ = false;
    value_ = literalValue(type, *module->tree, as<AggregateExpr>(*init), module->facts->values);
}

} // namespace rapid::sema
