// Values as text.

#include "frontend/query/describe.h"

#include <charconv>
#include <cmath>

namespace rapid::query {

using namespace sema;

std::string numberText(double value, bool single) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-Inf" : "Inf";
    char buffer[64];
    const auto end = single ? std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value)).ptr
                            : std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    std::string text(buffer, end);
    // RAPID writes whole numbers without exponent as long as that is short.
    if (text.find('e') != std::string::npos && value == std::floor(value) && std::fabs(value) < 1e9) {
        const auto whole = std::to_chars(buffer, buffer + sizeof buffer, static_cast<int64_t>(value)).ptr;
        return {buffer, whole};
    }
    for (char& c : text)
        if (c == 'e') c = 'E';
    return text;
}

namespace {

void write(const ConstValue& value, const Type* type, size_t limit, std::string& out) {
    if (out.size() > limit) return;
    switch (value.kind) {
    case ConstValue::Kind::None: out += "0"; return;
    case ConstValue::Kind::Number:
        out += numberText(value.number, !type || type->base()->kind != TypeKind::Dnum);
        return;
    case ConstValue::Kind::Bool: out += value.boolean ? "TRUE" : "FALSE"; return;
    case ConstValue::Kind::String: {
        out += '"';
        for (const char c : value.text()) {
            if (c == '"' || c == '\\') out += c;
            out += c;
        }
        out += '"';
        return;
    }
    case ConstValue::Kind::Aggregate: break;
    }
    out += '[';
    const auto members = value.members();
    const auto* components =
        type && type->base()->kind == TypeKind::Record ? &type->base()->components : nullptr;
    for (size_t i = 0; i < members.size(); ++i) {
        if (i) out += ',';
        if (out.size() > limit) {
            out += "...";
            break;
        }
        const Type* member = components && i < components->size() ? (*components)[i].type : type;
        write(members[i], member, limit, out);
    }
    out += ']';
}

/// Arrays: the elements, of the same type, are within the first levels.
void writeArray(const ConstValue& value, const DataType& type, int level, size_t limit, std::string& out) {
    if (level >= type.rank || value.kind != ConstValue::Kind::Aggregate)
        return write(value, type.type, limit, out);
    out += '[';
    bool first = true;
    for (const ConstValue& member : value.members()) {
        if (!std::exchange(first, false)) out += ',';
        if (out.size() > limit) {
            out += "...";
            break;
        }
        writeArray(member, type, level + 1, limit, out);
    }
    out += ']';
}

} // namespace

std::string valueText(const ConstValue& value, const DataType& type, size_t limit) {
    std::string out;
    writeArray(value, type, 0, limit, out);
    return out;
}

const ConstValue* constantOf(const Symbol& symbol) {
    const DataSymbol* data = dataOf(&symbol);
    if (!data || data->dataKind != syntax::DataKind::Const || data->storage == Storage::Parameter)
        return nullptr;
    if (data->valueProgress != Progress::Done && !data->isLiteralConstant()) return nullptr;
    const ConstValue& value = data->value();
    return value.kind == ConstValue::Kind::None ? nullptr : &value;
}

} // namespace rapid::query
