#include "frontend/edit/save_values.h"

#include "frontend/diag/diagnostic.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/parser.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace rapid::edit {

using namespace syntax;

namespace {

/// A literal: its kind and its value.
struct Leaf {
    enum class Kind : uint8_t { None, Number, String, Bool } kind = Kind::None;
    double number = 0; ///< Bool: 0 or 1
    std::string text;

    bool operator==(const Leaf& other) const {
        return kind == other.kind && number == other.number && text == other.text &&
               std::signbit(number) == std::signbit(other.number);
    }
};

Leaf leafOf(const SyntaxTree& tree, const Expr& expr) {
    switch (expr.kind) {
    case NodeKind::NumLiteral: return {Leaf::Kind::Number, as<NumLiteralExpr>(expr).value, {}};
    case NodeKind::StringLiteral: return {Leaf::Kind::String, 0, decodeStringLiteral(tree.text(expr.first))};
    case NodeKind::BoolLiteral: return {Leaf::Kind::Bool, as<BoolLiteralExpr>(expr).value ? 1.0 : 0.0, {}};
    case NodeKind::Unary: {
        const auto& unary = as<UnaryExpr>(expr);
        Leaf leaf = leafOf(tree, *unary.operand);
        if (leaf.kind != Leaf::Kind::Number || unary.op == UnaryOp::Not) return {};
        if (unary.op == UnaryOp::Minus) leaf.number = -leaf.number;
        return leaf;
    }
    default: return {};
    }
}

/// Every byte that is not ASCII as a character code.
std::string withCodes(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        out += byte < 0x80 ? std::string(1, c) : fmt::format("\\{:02X}", byte);
    }
    return out;
}

/// Replaces literals of the old value with those of the new one.
class LeafWriter {
  public:
    LeafWriter(const SyntaxTree& oldTree, const SyntaxTree& newTree, bool codes, std::vector<TextEdit>& edits)
        : oldTree_(oldTree), newTree_(newTree), codes_(codes), edits_(edits) {}

    /// False when the shapes differ.
    bool write(const Expr& before, const Expr& after) {
        if (before.kind == NodeKind::Aggregate || after.kind == NodeKind::Aggregate) {
            if (before.kind != after.kind) return false;
            const std::span<Expr*> from = as<AggregateExpr>(before).elements();
            const std::span<Expr*> to = as<AggregateExpr>(after).elements();
            if (from.size() != to.size()) return false;
            for (size_t i = 0; i < from.size(); ++i)
                if (!write(*from[i], *to[i])) return false;
            return true;
        }
        const Leaf was = leafOf(oldTree_, before), is = leafOf(newTree_, after);
        if (was.kind != is.kind || was.kind == Leaf::Kind::None) return false;
        if (was == is) return true;
        const SourceRange range = newTree_.range(after);
        const std::string_view text = newTree_.source->text().substr(range.begin, range.end - range.begin);
        edits_.push_back({oldTree_.range(before), codes_ ? withCodes(text) : std::string(text)});
        return true;
    }

  private:
    const SyntaxTree& oldTree_;
    const SyntaxTree& newTree_;
    bool codes_;
    std::vector<TextEdit>& edits_;
};

using Declarations = std::map<std::pair<std::string, std::string>, const DataDecl*>;

Declarations persistentsOf(const SyntaxTree& tree) {
    Declarations found;
    for (const ModuleDecl* module : tree.modules)
        for (const Decl* decl : module->decls) {
            if (decl->kind != NodeKind::Data || as<DataDecl>(*decl).dataKind != DataKind::Pers) continue;
            const auto& data = as<DataDecl>(*decl);
            found.try_emplace({sema::foldName(tree.text(module->name)), sema::foldName(tree.text(data.name))},
                              &data);
        }
    return found;
}

/// One value; "" or why it found no place.
std::string addEdits(const SyntaxTree& tree, const Declarations& declared, const DataValue& value, bool codes,
                     std::vector<TextEdit>& edits) {
    const auto found = declared.find({sema::foldName(value.module), sema::foldName(value.name)});
    if (found == declared.end()) return "the file declares no such persistent any more";
    if (!found->second->init) return {};
    diag::Sink sink;
    const auto source = std::make_shared<const SourceFile>("value.modx", value.value);
    const ParsedExpr parsed = parseExpression(source, sink);
    if (!sink.all().empty()) return fmt::format("'{}' is not a value", value.value);
    std::vector<TextEdit> own;
    LeafWriter writer(tree, *parsed.tree, codes, own);
    if (!writer.write(*found->second->init, *parsed.expr))
        return fmt::format("the initial value in the file has a different form than {}", value.value);
    edits.insert(edits.end(), own.begin(), own.end());
    return {};
}

} // namespace

SavedModule saveValues(const SyntaxTree& tree, std::span<const DataValue> values) {
    const Declarations declared = persistentsOf(tree);
    SavedModule result;
    // ISO 8859-1 has no place for every character of a string: then all of them become codes.
    for (const bool codes : {false, true}) {
        result = {};
        std::vector<TextEdit> edits;
        for (const DataValue& value : values) {
            const std::string why = addEdits(tree, declared, value, codes, edits);
            if (!why.empty())
                result.notes.push_back(
                    fmt::format("the value of {}.{} is not written: {}", value.module, value.name, why));
        }
        EditResult applied = applyEdits(*tree.source, edits);
        result.bytes = std::move(applied.bytes);
        result.problem = std::move(applied.problem);
        if (result.ok()) break;
    }
    return result;
}

} // namespace rapid::edit
