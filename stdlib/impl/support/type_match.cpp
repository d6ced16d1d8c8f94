#include "stdlib/impl/support/type_match.h"

#include "runtime/base/text_util.h"

namespace rt::lib {

const TypeDesc& elementOf(const TypeDesc& type) {
    return type.kind == DescKind::Array ? *type.fields[0] : type;
}

int rankOf(const TypeDesc& type) {
    if (type.kind != DescKind::Array) return 0;
    int rank = 0;
    while (rank < 3 && type.dims[rank] > 0)
        ++rank;
    return rank;
}

bool sameType(const TypeDesc& a, const TypeDesc& b) {
    if (&a == &b) return true;
    if (a.kind != b.kind || a.size != b.size || !sameName(a.baseName, b.baseName)) return false;
    if (a.kind != DescKind::Record) return true;
    if (a.count != b.count) return false;
    for (uint32_t i = 0; i < a.count; ++i)
        if (!sameName(a.fieldNames[i], b.fieldNames[i]) || !sameType(*a.fields[i], *b.fields[i]))
            return false;
    return true;
}

Match matchArgument(const TypeDesc& have, const TypeDesc& want, int rank) {
    if (!sameType(elementOf(have), elementOf(want))) return Match::OtherType;
    return rankOf(have) == rank ? Match::Yes : Match::OtherDimensions;
}

Match matchValue(const TypeDesc& a, const TypeDesc& b) {
    if (!sameType(elementOf(a), elementOf(b))) return Match::OtherType;
    for (int k = 0; k < 3; ++k)
        if ((k < rankOf(a) ? a.dims[k] : 0) != (k < rankOf(b) ? b.dims[k] : 0)) return Match::OtherDimensions;
    return Match::Yes;
}

} // namespace rt::lib
