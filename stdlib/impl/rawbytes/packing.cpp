// Manual 1.10: PackRawBytes and UnpackRawBytes.

#include "stdlib/impl/rawbytes/checks.h"
#include "stdlib/impl/rawbytes/raw_bytes.h"
#include "stdlib/impl/support/fail.h"

#include "natives/rawbytes.h"
#include "stdlib_constants.h"

#include <bit>
#include <cmath>

using namespace rt;

namespace {

static_assert(std::endian::native == std::endian::little);

/// Width in bytes of inttypes, and whether there is a sign. Width 0: it is none.
struct IntegerForm {
    uint32_t width = 0;
    bool isSigned = false;

    explicit IntegerForm(float inttypes) {
        for (const float known : {k::USINT, k::UINT, k::UDINT, k::ULINT})
            if (std::fabs(inttypes) == known) width = static_cast<uint32_t>(known);
        isSigned = inttypes < 0;
    }
    /// The least number that can be packed: negative ones as two's complement, even without a sign (decision 113).
    double least() const { return -std::ldexp(1.0, static_cast<int>(width * 8 - 1)); }
    /// The first number that is too large.
    double end() const { return std::ldexp(1.0, static_cast<int>(width * 8 - (isSigned ? 1 : 0))); }
};

Status badForm(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     "one of \\Hex1, \\IntX, \\Float4 and \\ASCII must be given, and it must fit the data: "
                     "\\IntX for num and "
                     "dnum, \\Float4 for num, \\Hex1 for byte, \\ASCII for byte and string");
}

Status badInteger(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     "\\IntX must be USINT, UINT, UDINT, ULINT, SINT, INT, DINT or LINT");
}

/// Writes the lowest `width` bytes of `bits` at an offset.
Status store(TaskCore* task, data::Rawbytes& container, uint32_t index, uint64_t bits, uint32_t width,
             bool network) {
    if (index - 1 + width > lib::kRawBytesCapacity) return lib::beyondCapacity(task, index, width);
    if (network) bits = __builtin_bswap64(bits) >> (64 - width * 8);
    lib::put(container, index - 1, &bits, width);
    return kOk;
}

Status load(TaskCore* task, const data::Rawbytes& container, uint32_t index, uint32_t width, bool network,
            uint64_t& bits) {
    if (index - 1 + width > container.length) return lib::beyondValid(task, index, width, container.length);
    bits = 0;
    std::memcpy(&bits, container.bytes + index - 1, width);
    if (network) bits = __builtin_bswap64(bits) >> (64 - width * 8);
    return kOk;
}

Status packInteger(TaskCore* task, data::Rawbytes& container, uint32_t index, double value, float inttypes,
                   bool network) {
    const IntegerForm form(inttypes);
    if (form.width == 0) return badInteger(task);
    if (!(value >= form.least() && value < form.end()) || std::trunc(value) != value)
        return lib::failWith(task, err::ERR_ARGVALERR,
                             "{} is not a whole number that fits into \\IntX (bytes: {})", value, form.width);
    const uint64_t bits =
        value < 0 ? static_cast<uint64_t>(static_cast<int64_t>(value)) : static_cast<uint64_t>(value);
    return store(task, container, index, bits, form.width, network);
}

Status packByte(TaskCore* task, data::Rawbytes& container, uint32_t index, float value) {
    if (!(value >= 0 && value <= 255) || std::trunc(value) != value)
        return lib::failWith(task, err::ERR_ARGVALERR, "{} is not a byte, a whole number from 0 to 255",
                             static_cast<double>(value));
    return store(task, container, index, static_cast<uint64_t>(value), 1, false);
}

Status unpackInteger(TaskCore* task, const data::Rawbytes& container, uint32_t index, float inttypes,
                     bool network, double& value) {
    const IntegerForm form(inttypes);
    if (form.width == 0) return badInteger(task);
    uint64_t bits = 0;
    if (const Status status = load(task, container, index, form.width, network, bits)) return status;
    const uint32_t unused = 64 - form.width * 8;
    value = form.isSigned ? static_cast<double>(static_cast<int64_t>(bits << unused) >> unused)
                          : static_cast<double>(bits);
    return kOk;
}

Status unpackFloat(TaskCore* task, const data::Rawbytes& container, uint32_t index, bool network,
                   float& value) {
    uint64_t bits = 0;
    if (const Status status = load(task, container, index, sizeof value, network, bits)) return status;
    const auto number = std::bit_cast<float>(static_cast<uint32_t>(bits));
    if (!std::isfinite(number))
        return lib::fail(task, err::ERR_ARGVALERR, "the 4 bytes are infinite or not a number");
    value = number;
    return kOk;
}

Status unpackText(TaskCore* task, const data::Rawbytes& container, uint32_t index, float length,
                  String& text) {
    uint32_t count = 0;
    if (length != 0 && (!lib::toIndex(length, count) || count > kStringCapacity))
        return lib::fail(task, err::ERR_ARGVALERR, "\\ASCII must be a number of characters from 0 to 80");
    if (index - 1 + count > container.length) return lib::beyondValid(task, index, count, container.length);
    text.assign({reinterpret_cast<const char*>(container.bytes) + index - 1, count});
    return kOk;
}

} // namespace

extern "C" {

Status rt_PackRawBytes(TaskCore* task, const void* Value, const TypeDesc* ValueType, data::Rawbytes* RawData,
                       bool Network, float StartIndex, bool Hex1, const float* IntX, bool Float4,
                       bool ASCII) {
    uint32_t index = 0;
    if (!lib::toIndex(StartIndex, index)) return lib::notAnIndex(task, "StartIndex");
    switch (ValueType->kind) {
    case DescKind::Num: {
        const float value = *static_cast<const float*>(Value);
        if (IntX != nullptr)
            return packInteger(task, *RawData, index, static_cast<double>(value), *IntX, Network);
        if (Float4)
            return store(task, *RawData, index, std::bit_cast<uint32_t>(value), sizeof value, Network);
        if (Hex1 || ASCII) return packByte(task, *RawData, index, value);
        break;
    }
    case DescKind::Dnum:
        if (IntX != nullptr)
            return packInteger(task, *RawData, index, *static_cast<const double*>(Value), *IntX, Network);
        break;
    case DescKind::String:
        if (ASCII) {
            const std::string_view text = static_cast<const String*>(Value)->view();
            const auto count = static_cast<uint32_t>(text.size());
            if (index - 1 + count > lib::kRawBytesCapacity) return lib::beyondCapacity(task, index, count);
            lib::put(*RawData, index - 1, text.data(), count);
            return kOk;
        }
        break;
    default: break;
    }
    return badForm(task);
}

Status rt_UnPackRawBytes(TaskCore* task, data::Rawbytes* RawData, bool Network, float StartIndex, void* Value,
                         const TypeDesc* ValueType, bool Hex1, const float* IntX, bool Float4,
                         const float* ASCII) {
    uint32_t index = 0;
    if (!lib::toIndex(StartIndex, index)) return lib::notAnIndex(task, "StartIndex");
    double integer = 0;
    switch (ValueType->kind) {
    case DescKind::Num: {
        float& value = *static_cast<float*>(Value);
        if (Float4) return unpackFloat(task, *RawData, index, Network, value);
        if (IntX == nullptr && !Hex1 && (ASCII == nullptr || *ASCII != 1)) break;
        const float form = IntX != nullptr ? *IntX : k::USINT;
        const Status status = unpackInteger(task, *RawData, index, form, Network, integer);
        if (status == kOk) value = static_cast<float>(integer);
        return status;
    }
    case DescKind::Dnum: {
        if (IntX == nullptr) break;
        const Status status = unpackInteger(task, *RawData, index, *IntX, Network, integer);
        if (status == kOk) *static_cast<double*>(Value) = integer;
        return status;
    }
    case DescKind::String:
        if (ASCII != nullptr) return unpackText(task, *RawData, index, *ASCII, *static_cast<String*>(Value));
        break;
    default: break;
    }
    return badForm(task);
}
}
